"""Nothing is used that Blender says it will take away: asked of the Blender that runs this."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from itertools import chain

import bpy
import pytest
from places import ROOT
from risorius.scene.sounds import EARLIER

pytestmark = pytest.mark.smoke
ROOMS = ("scene", "operators", "batch", "cli")
#: Protocols whose names are not those of Blender's types.
CALLED = {"SequencerStrip": "SoundStrip"}
#: Told a new material or world before Blender 5.0 alone: `scene.materials.node_tree_of`.
EARLIER_ALONE = {("Material", "use_nodes"), ("World", "use_nodes")}


def properties() -> Iterator[tuple[str, str, bool]]:
    """Type, property, whether it is deprecated: of all of Blender. Before 5.0 Blender did not tell."""
    for kind in dir(bpy.types):
        for each in getattr(getattr(bpy.types, kind), "bl_rna", bpy.types.Struct.bl_rna).properties:
            yield kind, each.identifier, bool(getattr(each, "is_deprecated", False))


def words(source: ast.Module) -> Iterator[str]:
    """Attributes, option names, and texts that may be the name of an attribute."""
    for node in ast.walk(source):
        match node:
            case ast.Attribute(attr=word) | ast.keyword(arg=str(word)) | ast.Constant(value=str(word)):
                yield word


def test_names_that_only_deprecated_properties_have_are_not_used() -> None:
    kept = {name for _, name, deprecated in properties() if not deprecated}
    going = {name for _, name, deprecated in properties() if deprecated} - kept - {name for _, name in EARLIER_ALONE}
    going = {name for name in going if "_" in name}  # a plain word, as flip, is a name of our own, too
    assert bpy.app.version < (5, 1) or len(going) > 5
    used = [
        f"{path.relative_to(ROOT)}: {word}"
        for path in chain.from_iterable((ROOT / room).rglob("*.py") for room in ROOMS)
        for word in words(ast.parse(path.read_text(encoding="utf-8")))
        if word in going and not (path.name == "sounds.py" and word in EARLIER.values())
    ]
    assert used == []


def test_no_member_that_the_types_name_is_deprecated() -> None:
    going = {(kind, name) for kind, name, deprecated in properties() if deprecated} - EARLIER_ALONE
    named = [
        (CALLED.get(told.name, told.name), member.target.id if isinstance(member, ast.AnnAssign) else member.name)
        for path in [*(ROOT / "scene" / "blender_types").glob("*.py"), ROOT / "operators" / "blender_types.py"]
        for told in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(told, ast.ClassDef)
        for member in told.body
        if isinstance(member, ast.FunctionDef)
        or (isinstance(member, ast.AnnAssign) and isinstance(member.target, ast.Name))
    ]
    assert len(named) > 300
    assert [f"{kind}.{name}" for kind, name in named if (kind, name) in going] == []
