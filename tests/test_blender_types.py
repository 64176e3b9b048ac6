"""What mypy is told of Blender's types is what is used of them."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[1]
TOLD = ("blender_types", "blender_classes")


def sources(*, told: bool) -> Iterator[ast.Module]:
    """The modules of scene and operators that name Blender's types, or all others."""
    for room in ("scene", "operators"):
        for path in (ROOT / room).rglob("*.py"):
            if bool({path.stem, path.parent.name} & set(TOLD)) == told:
                yield ast.parse(path.read_text(encoding="utf-8"))


def words(source: ast.Module) -> Iterator[str]:
    """Attributes, option names, names, and texts that may be the name of an attribute."""
    for node in ast.walk(source):
        match node:
            case ast.Attribute(attr=word) | ast.keyword(arg=str(word)) | ast.Name(id=word):
                yield word
            case ast.Constant(value=str(word)):
                yield word


def members(source: ast.Module) -> Iterator[tuple[str, str]]:
    """Class and member, but for what Python itself calls."""
    for told in ast.walk(source):
        for member in told.body if isinstance(told, ast.ClassDef) else ():
            name = member.name if isinstance(member, ast.FunctionDef) else ""
            if isinstance(member, ast.AnnAssign) and isinstance(member.target, ast.Name):
                name = member.target.id
            if name and not name.startswith("__"):
                yield told.name, name


def test_every_member_that_is_told_is_used() -> None:
    used = {word for source in sources(told=False) for word in words(source)}
    told = [member for source in sources(told=True) for member in members(source)]
    assert len(told) > 300
    assert [f"{kind}.{name}" for kind, name in told if name not in used] == []
