"""What an animator should know about a bake that is nevertheless fine."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import bpy

from ..blender_types import Key, Object
from ..points.bound import followed
from ..points.kept import has_points, read_kept
from .shape_keys import own_names_of

if TYPE_CHECKING:
    from ...api import Face


def _active_user_keys(keys: Key | None) -> list[str]:
    """Names of shape keys that are not ours and move the face now."""
    if keys is None:
        return []
    own = own_names_of(keys)
    return [k.name for k in keys.key_blocks[1:] if k.value != 0.0 and not k.mute and k.name not in own]


def sewn_remarks(name: str, sewn: frozenset[str]) -> list[str]:
    """What lips and lids without an opening mean for the face of an object."""
    found = []
    if "mouth" in sewn:
        found.append(f"{name}: its lips are sewn together and stay closed")
    if sewn - {"mouth"}:
        found.append(f"{name}: its lids are shut, in one surface with each other, and stay shut")
    return found


def remarks(obj: Object, face: Face | None = None) -> tuple[str, ...]:
    """What an animator should know about a bake on this object that is nevertheless fine."""
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
    keys = obj.data.shape_keys
    active = _active_user_keys(keys)
    if active:
        found.append(f"{obj.name}: the resting face is the Basis; {len(active)} active shape keys add to the bake")
    if obj.show_only_shape_key:
        found.append(f"{obj.name}: Shape Key Lock shows one key only; turn it off to see the animation")
    return tuple(found)


def unmet_remarks(missed: Mapping[int, str], clip: str = "") -> tuple[str, ...]:
    """What is requested, by a clip, and does not show, from FAP number -> why."""
    from ... import api

    return tuple(f"{clip}: {line}" if clip else line for line in api.unmet_lines(missed))
