"""Names of buttons, panels and settings in the language of Blender's interface: presets/translations, a table each.

A table is a CSV file named after the language as Blender calls it (de, pt_BR): context, text as it stands in the
sources, translation. The context is "Operator" for buttons and "*" for all else. What a table does not have stays
English.
"""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import ExitStack
from pathlib import Path

import bpy

from ..resources import PRESETS
from ..tables import read_csv

FOLDER = PRESETS / "translations"
COLUMNS = ("context", "text", "translation")
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
    rows = [tuple(row.text(name) for name in COLUMNS) for row in read_csv(path, *COLUMNS)]
    return {(context, text): translation for context, text, translation in rows}


def attach(undo: ExitStack) -> None:
    """Tell Blender, until undone."""
    bpy.app.translations.register(OWNER, load())
    undo.callback(bpy.app.translations.unregister, OWNER)
