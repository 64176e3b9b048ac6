"""Files written whole or not at all, and read with errors that name the file and the remedy."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

from .errors import FormatError
from .resources import PACKAGE


def write_whole(path: str | Path, content: str | bytes) -> None:
    """Write a file, replacing an older one only once the new one is complete; text as UTF-8, lines end as they stand.

    Raises
    ------
    FormatError : the file cannot be written; an older one is as it was.
    """
    file = Path(path)
    data = content.encode("utf-8") if isinstance(content, str) else content
    # Not with_suffix: a name without an extension, or with two, must not collide with a neighbour.
    draft = file.with_name(f".{file.name}.{os.getpid()}.draft")
    try:
        draft.write_bytes(data)
        os.replace(draft, file)
    except OSError as error:
        draft.unlink(missing_ok=True)
        raise FormatError(file, f"cannot be written ({error.strerror}): choose a folder you may write to") from error


def read_bytes(path: str | Path) -> bytes:
    """The bytes of a file.

    Raises
    ------
    FormatError : it cannot be read.
    """
    file = Path(path)
    try:
        return file.read_bytes()
    except OSError as error:
        remedy = "install Risorius again" if file.resolve().is_relative_to(PACKAGE) else "give a file that you may read"
        raise FormatError(file, f"cannot be read ({error.strerror}): {remedy}") from error


def read_document(path: str | Path, *, kind: str, version: int) -> dict[str, Any]:
    """A JSON object that says what it is: "format": `kind`, "version": `version`.

    Raises
    ------
    FormatError : unreadable, no JSON, or another kind or version of document.
    """
    try:
        document = json.loads(read_bytes(path).decode("utf-8"))
    except (ValueError, RecursionError) as error:  # UnicodeDecodeError is a ValueError
        raise FormatError(path, f"is not valid JSON: {error}") from error
    if not isinstance(document, dict) or (document.get("format"), document.get("version")) != (kind, version):
        raise FormatError(path, f'must be an object with "format": "{kind}", "version": {version}', key="format")
    return document
