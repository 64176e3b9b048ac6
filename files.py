"""Files written whole or not at all, and read with errors that name the file and the remedy."""

from __future__ import annotations

import contextlib
import os
from pathlib import Path

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
        with contextlib.suppress(OSError):  # what keeps the draft from being written may keep it from being removed
            draft.unlink()
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
