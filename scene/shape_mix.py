"""The mix of a mesh's shape keys that shows at rest: the user's own keys at their present values.

Many characters are what their shape keys make of them: modelling targets, morphs, corrective keys. Their present mix is
the face at rest. Keys that Risorius has written are no part of it, and neither are keys whose keyframes change or that
a clip of ours keys: those are a motion.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import TypeAlias

import bpy
import numpy as np

from ..arrays import Floats
from ..tables import parsed_json
from .attributes import read_floats
from .blender_types import Action, Key, Mesh, Object, ShapeKey
from .fcurves import SMALL, changes, curves_of

#: Which shape keys of a mesh, at which values, make its rest.
Resting: TypeAlias = Callable[[Mesh], Mapping[str, float]]

RECORD = "risorius"
#: What an action is known by that is a clip on the user's own keys and bones: the head that it belongs to.
RIG_TAG = "risorius_rig_head"


@dataclass(frozen=True)
class OwnKeys:
    """What Risorius has put on one mesh.

    Attributes
    ----------
    face : a name for this face that its actions carry too.
    added_basis : the Basis is ours: there were no shape keys before.
    clips : clip name -> names of its shape keys.
    """

    face: str = ""
    added_basis: bool = False
    clips: Mapping[str, tuple[str, ...]] = field(default_factory=dict)

    @property
    def names(self) -> tuple[str, ...]:
        """All own shape keys, clip by clip."""
        return tuple(name for keys in self.clips.values() for name in keys)


def own_keys(keys: Key | None) -> OwnKeys:
    """The record of a shape key datablock, without keys that no longer exist. Empty where there is none."""
    if keys is None or RECORD not in keys:
        return OwnKeys()
    try:
        stored = parsed_json(str(keys[RECORD]))
        clips = {
            str(clip): tuple(str(name) for name in names if name in keys.key_blocks)
            for clip, names in stored["clips"].items()
        }
        return OwnKeys(str(stored["face"]), bool(stored["added_basis"]), clips)
    except (ValueError, KeyError, TypeError, AttributeError):
        return OwnKeys()


def data_path(key_name: str) -> str:
    """RNA path of a shape key's value."""
    return f'key_blocks["{bpy.utils.escape_identifier(key_name)}"].value'


def resting_values(mesh: Mesh) -> dict[str, float]:
    """Name -> value of the user's shape keys that make the resting face what it is; in the order of the keys."""
    keys = mesh.shape_keys
    still = (key for key in _showing(mesh) if not any(_moved_by(keys, key, ours=ours) for ours in (True, False)))
    return {key.name: key.value for key in still}


def resting_without(names: Iterable[str]) -> Resting:
    """The user's keys as they are now, without some that are to be written anew."""
    gone = set(names)
    return lambda mesh: {name: value for name, value in resting_values(mesh).items() if name not in gone}


def settle_drivers(objects: Iterable[Object]) -> None:
    """Let drivers give the shape keys of some objects the values that they have now."""
    keys = (obj.data.shape_keys for obj in objects if obj.type == "MESH")
    if any(each is not None and each.animation_data is not None and each.animation_data.drivers for each in keys):
        bpy.context.evaluated_depsgraph_get()


def moving_keys(mesh: Mesh) -> tuple[str, ...]:
    """Names of the user's shape keys that show now and that the user's keyframes move: that adds to what is baked."""
    return tuple(key.name for key in _showing(mesh) if _moved_by(mesh.shape_keys, key, ours=False))


def mixed_vertices(mesh: Mesh, values: Mapping[str, float]) -> Floats:
    """(V, 3) the Basis with some shape keys at some values, as Blender mixes them. Names that are gone are passed over.

    The mesh must have shape keys.
    """
    keys = mesh.shape_keys
    assert keys is not None
    mixed = read_floats(keys.reference_key.data, "co", 3)
    for name, value in values.items():
        key = keys.key_blocks.get(name)
        if key is None:
            continue
        mixed += value * key_change(mesh, key)
    return mixed


def key_change(mesh: Mesh, key: ShapeKey) -> Floats:
    """(V, 3) what a shape key adds at value 1, as Blender mixes it, in the mesh's own coordinates."""
    change = read_floats(key.data, "co", 3) - read_floats(key.relative_key.data, "co", 3)
    return change if not key.vertex_group else _weights(mesh, key.vertex_group)[:, None] * change


def _showing(mesh: Mesh) -> Iterator[ShapeKey]:
    """The user's shape keys that show now."""
    keys = mesh.shape_keys
    if keys is None or not keys.use_relative:
        return
    own = set(own_keys(keys).names)
    for key in keys.key_blocks:
        if key != keys.reference_key and abs(key.value) > SMALL and not key.mute and key.name not in own:
            yield key


def _weights(mesh: Mesh, group: str) -> Floats:
    """(V,) weights of a vertex group; the names of groups are known to objects alone. All 1 where there is none."""
    weights = np.zeros(len(mesh.vertices))
    obj = next((obj for obj in bpy.data.objects if obj.data == mesh), None)
    found = None if obj is None else obj.vertex_groups.get(group)
    if found is None:
        return np.ones(len(weights))
    for vertex in mesh.vertices:
        for member in vertex.groups:
            if member.group == found.index:
                weights[vertex.index] = member.weight
    return weights


def _moved_by(keys: Key | None, key: ShapeKey, *, ours: bool) -> bool:
    """Whether clips of ours key a shape key's value, or keyframes of the user's own change it."""
    if keys is None or keys.animation_data is None:
        return False
    path = data_path(key.name)
    curves = (curve for action in _actions(keys) if (RIG_TAG in action) == ours for curve in curves_of(action, path))
    return any(ours or changes(curve) for curve in curves)


def _actions(keys: Key) -> list[Action]:
    """The actions that a shape key datablock plays, alone or as strips."""
    animation = keys.animation_data
    assert animation is not None
    strips = [strip.action for track in animation.nla_tracks for strip in track.strips]
    return [action for action in (animation.action, *strips) if action is not None]
