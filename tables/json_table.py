"""JSON documents as tables of checked cells."""

from __future__ import annotations

from pathlib import Path

from ..errors import FormatError
from ..files import read_bytes
from .json_text import parsed_json
from .keyed_table import KeyedTable


def read_json(path: str | Path, *, kind: str, version: int) -> KeyedTable:
    """A JSON object that says what it is: "format": `kind`, "version": `version`.

    Raises
    ------
    FormatError : unreadable, not JSON, or another kind or version of document.
    """
    try:
        document = parsed_json(read_bytes(path).decode("utf-8-sig"))
    except ValueError as error:  # UnicodeDecodeError is a ValueError
        raise FormatError(path, f"is not valid JSON: {error}") from error
    return checked_document(path, document, kind=kind, version=version)


def checked_document(path: str | Path, document: object, *, kind: str, version: int) -> KeyedTable:
    """A document that has been read; errors as `read_json`."""
    file = Path(path)
    if not isinstance(document, dict) or (document.get("format"), document.get("version")) != (kind, version):
        raise FormatError(file, f'must be an object with "format": "{kind}", "version": {version}', key="format")
    return KeyedTable(file, document)
