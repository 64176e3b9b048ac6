"""Reading a preset of presets/capture/: TOML with one table of rows."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

from ....errors import FormatError
from ....resources import PRESETS

CAPTURE_PRESETS = PRESETS / "capture"
"""The mapping tables that come with Risorius."""


def read_document(path: Path) -> dict[str, Any]:
    """A whole TOML file.

    Raises
    ------
    FormatError : the file cannot be read, or is no TOML.
    """
    try:
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise FormatError(path, f"cannot be read ({error.strerror}): give a .toml file that exists") from error
    except (UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise FormatError(path, f"is not valid TOML: {error}") from error


def read_preset(path: Path, table: str) -> dict[str, dict[str, Any]]:
    """The rows of one table of a TOML file: name -> row.

    Raises
    ------
    FormatError : the file cannot be read, or has no such table of tables.
    """
    rows = read_document(path).get(table)
    if not isinstance(rows, dict) or not rows:
        raise FormatError(path, f"must have rows [{table}.NAME]", key=table)
    for name, row in rows.items():
        if not isinstance(row, dict):
            raise FormatError(path, f"must be a table: begin it with [{table}.{name}]", key=f"{table}.{name}")
    return rows
