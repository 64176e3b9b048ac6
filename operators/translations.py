"""Names of buttons, panels and settings in the language of Blender's interface: presets/translations, a table each.

A table is a CSV file named after the language as Blender calls it (de, pt_BR): context, text as it stands in the
sources, translation. The context is "Operator" for buttons and "*" for all else. What a table does not have stays
English.
"""

from __future__ import annotations

import csv
from collections.abc import Mapping
from contextlib import ExitStack
from pathlib import Path

import bpy

from ..errors import FormatError
from ..resources import PRESETS

FOLDER = PRESETS / "translations"
COLUMNS = ["context", "text", "translation"]
#: What Blender knows our translations by.
OWNER = __name__


def load(folder: Path = FOLDER) -> dict[str, Mapping[tuple[str, str], str]]:
    """Language -> (context, text) -> translation, of all tables in a folder.

    Raises
    ------
    FormatError : a table with other columns, or an empty field; names file and line.
    """
    return {path.stem: _table(path) for path in sorted(folder.glob("*.csv"))}


def _table(path: Path) -> dict[tuple[str, str], str]:
    """One table."""
    found: dict[tuple[str, str], str] = {}
    with path.open(encoding="utf-8", newline="") as file:
        rows = csv.DictReader(file)
        if rows.fieldnames != COLUMNS:
            raise FormatError(path, f"must have the columns {', '.join(COLUMNS)}", line=1)
        for row in rows:
            if not all(row[name] for name in COLUMNS):
                raise FormatError(path, "must have something in every column", line=rows.line_num)
            found[row["context"], row["text"]] = row["translation"]
    return found


def attach(undo: ExitStack) -> None:
    """Tell Blender, until undone."""
    bpy.app.translations.register(OWNER, load())
    undo.callback(bpy.app.translations.unregister, OWNER)
