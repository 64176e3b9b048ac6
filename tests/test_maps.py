"""Each room's `__init__` maps what is in the room: every module is named in it, and what it names is there."""

from __future__ import annotations

import ast
import re
from pathlib import Path

import pytest
from places import ROOT

ROOMS = sorted(
    path.parent
    for top in ROOT.iterdir()
    if not top.name.startswith(".") and top.name not in ("tests", "docs", "build", "dist", "out")
    for path in (top.rglob("__init__.py") if top.is_dir() else [top] if top.name == "__init__.py" else [])
)

#: Not for readers of a map: run or read by other programs.
UNMAPPED = {"__init__", "__main__", "setup"}


def inside(room: Path) -> set[str]:
    """The modules and rooms in a room."""
    modules = {path.stem for path in room.glob("*.py")}
    return (modules | {path.parent.name for path in room.glob("*/__init__.py")}) - UNMAPPED - {"tests", "tools"}


def map_of(room: Path) -> str:
    """The docstring of a room."""
    return ast.get_docstring(ast.parse((room / "__init__.py").read_text(encoding="utf-8"))) or ""


def named_first(text: str) -> set[str]:
    """What the lines of a map begin with: one name, or several with commas, before two spaces or more.

    A line of names alone, indented, goes on with the line above.
    """
    names = r"[a-z_0-9]+(?:, [a-z_0-9]+)*"
    lines = (re.fullmatch(rf"({names}),?  +\S.*|  +({names}),?", line) for line in text.splitlines())
    return {name for found in lines if found for name in (found[1] or found[2]).split(", ")}


@pytest.mark.parametrize("room", ROOMS, ids=lambda room: room.relative_to(ROOT).as_posix())
def test_a_room_maps_what_is_in_it(room: Path) -> None:
    text = map_of(room)
    named = named_first(text) | set(re.findall(r"`(\w+)`", text)) | set(re.findall(r"; (\w+):", text))
    assert sorted(inside(room) - named) == [], "name these in the docstring of __init__.py"
    assert sorted(named_first(text) - inside(room)) == [], "these are named, but not there"


def test_rooms_are_found() -> None:
    assert {"face/response", "tools/fit", "operators/wheel"} <= {room.relative_to(ROOT).as_posix() for room in ROOMS}
    assert named_first("linear, sheet    models\nand text with a word") == {"linear", "sheet"}
    assert named_first("parts,   which\n  pieces, sphere\nin a sentence") == {"parts", "pieces", "sphere"}
