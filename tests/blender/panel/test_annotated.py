"""What mypy is told of a property is what Blender holds in it."""

from __future__ import annotations

import ast
import inspect
from collections.abc import Callable
from typing import Any

import bpy
import pytest
from bpy.props import FloatProperty, StringProperty
from risorius.operators.annotated import Annotated
from risorius.operators.classes import CLASSES

pytestmark = pytest.mark.smoke

#: What a pointer may hold nothing of.
MAY_LACK = (bpy.types.Object.bl_rna, bpy.types.Sound.bl_rna)
HELD = {"STRING": "str", "ENUM": "str", "INT": "int", "FLOAT": "float", "BOOLEAN": "bool"}


def held_by(prop: bpy.types.Property) -> str:
    """The type of what a property holds, as it should be annotated."""
    if prop.type == "COLLECTION":
        return f"Entries[{prop.fixed_type.identifier}]"
    if prop.type == "POINTER":
        return prop.fixed_type.identifier + (" | None" if prop.fixed_type in MAY_LACK else "")
    return HELD[prop.type]


def annotated(cls: type) -> dict[str, str]:
    """Property -> type, as it stands in the source."""
    found = {}
    for line in ast.parse(inspect.getsource(cls)).body[0].body:  # type: ignore[attr-defined]
        if isinstance(line, ast.AnnAssign) and ast.unparse(line.annotation).startswith("Annotated["):
            found[ast.unparse(line.target)] = ast.unparse(line.annotation.slice.elts[0])  # type: ignore[attr-defined]
    return found


def test_every_property_is_annotated_as_what_it_holds(properties_of: Callable[[type], Any]) -> None:
    checked = 0
    for cls in CLASSES:
        for name, told in annotated(cls).items():
            assert told == held_by(properties_of(cls)[name]), f"{cls.__name__}.{name}"
            checked += 1
    assert checked > 100


class _MixIn:
    """A property that several operators have."""

    shared: Annotated[str, StringProperty(default="both")]


class RISORIUS_OT_annotated(_MixIn, bpy.types.Operator):
    """One more"""

    bl_idname = "risorius.annotated"
    bl_label = "Annotated"

    plain: int = 3
    own: Annotated[float, FloatProperty(default=2.5)]


def test_properties_of_mix_ins_are_found_and_twice_is_fine(properties_of: Callable[[type], Any]) -> None:
    for _ in range(2):
        bpy.utils.register_class(RISORIUS_OT_annotated)
        try:
            properties = properties_of(RISORIUS_OT_annotated)
            assert (properties["own"].default, properties["shared"].default) == (2.5, "both")
            assert "plain" not in properties
        finally:
            bpy.utils.unregister_class(RISORIUS_OT_annotated)
    assert RISORIUS_OT_annotated.plain == 3
