"""What an animator should know about a bake that is nevertheless fine."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import TYPE_CHECKING

import bpy

from ..blender_types import Object
from ..points.bound import followed
from ..points.kept import has_points, read_kept
from ..posed import is_reshaped
from ..shape_mix import moving_keys, resting_values

if TYPE_CHECKING:
    from ...api import Face

#: Shape keys that a remark names.
NAMED = 3

#: How far poses on a share of a dense skin's vertices are from those on all of it (docs/performance.md).
THINNED_RMS, THINNED_WORST = "0.5 %", "7 %"


def shown_remarks(obj: Object) -> tuple[str, ...]:
    """What the resting face of an object is, where that is not simply its mesh."""
    values, moving = resting_values(obj.data), moving_keys(obj.data)
    found = []
    if values:
        found.append(f"{obj.name}: posed on the face as it shows, with {_counted(values)}")
    if moving:
        found.append(f"{obj.name}: animation of {_counted(moving)} adds to the bake")
    if is_reshaped(obj):
        found.append(f"{obj.name}: posed on the face as it shows, in the shape that its rig gives it")
    return tuple(found)


def _counted(names: Collection[str]) -> str:
    """How many shape keys, with the names of the first."""
    listed = ", ".join(list(names)[:NAMED]) + (" ..." if len(names) > NAMED else "")
    return f"{len(names)} shape key{'s' * (len(names) > 1)} ({listed})"


def sewn_remarks(name: str, sewn: frozenset[str]) -> list[str]:
    """What lips and lids without an opening mean for the face of an object."""
    found = []
    if "mouth" in sewn:
        found.append(f"{name}: its lips are sewn together and stay closed; use Cut Lips Open")
    if sewn - {"mouth"}:
        found.append(f"{name}: its lids are shut, in one surface with each other, and stay shut")
    return found


def thinned_remarks(name: str, face: Face) -> list[str]:
    """What it means where a skin is so dense that it is solved on a share of its vertices."""
    if not face.is_thinned:
        return []
    off = f"off by about {THINNED_RMS} of the largest displacement (mean square), {THINNED_WORST} at the worst vertex"
    return [f"{name}: its skin is dense and solved on a share of its vertices: {off}"]


def remarks(obj: Object, face: Face | None = None) -> tuple[str, ...]:
    """What an animator should know about a bake on this object that is nevertheless fine."""
    from ...face.products.mouth_room import mouth_border

    found = []
    evaluated = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    if evaluated.type == "MESH" and len(evaluated.data.vertices) != len(obj.data.vertices):
        found.append(f"{obj.name}: its modifiers change the vertex count; the bake applies to the unmodified mesh")
    if has_points(obj):
        now = followed(read_kept(obj), obj.data)
        lost = f"; {', '.join(now.lost)} were lost" if now.lost else ""
        if now.moved_on:
            found.append(f"{obj.name}: was edited; its feature points moved to the nearest surface{lost}: check them")
    if face is not None:
        found += sewn_remarks(obj.name, face.sewn)
        found += thinned_remarks(obj.name, face)
        if mouth_border(face) is not None:
            found.append(f"{obj.name}: its mouth has no inside, what is behind shows through it; use Add Mouth Lining")
    found += shown_remarks(obj)
    if obj.show_only_shape_key:
        found.append(f"{obj.name}: Shape Key Lock shows one key only; turn it off to see the animation")
    return tuple(found)


def unmet_remarks(missed: Mapping[int, str], clip: str = "") -> tuple[str, ...]:
    """What is requested, by a clip, and does not show, from FAP number -> why."""
    from ... import api

    return tuple(f"{clip}: {line}" if clip else line for line in api.unmet_lines(missed))
