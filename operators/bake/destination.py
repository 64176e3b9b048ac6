"""Where the bakes of a face go: new shape keys, or the keys or bones that the character already has, and how."""

from __future__ import annotations

from dataclasses import dataclass, field

import bpy

from ...scene import refusals
from ...scene.bake import shape_keys
from ...scene.blender_types import Object as SceneObject
from ...scene.rig.baking import Onto
from ...scene.rig.destinations import BakeTo
from ..active import face_reason, target_of
from ..blender_types import Object

#: So many shape keys on a face are worth asking whether they are to be baked to.
MANY = 8


@dataclass(frozen=True)
class Destination:
    """Where a bake goes, and onto a rig, how."""

    to: BakeTo = BakeTo.NEW
    onto: Onto = field(default_factory=Onto)

    @property
    def noted(self) -> str:
        """As a bake notes it."""
        return "" if self.to is BakeTo.NEW else self.to.value


def destination_of(obj: Object) -> Destination:
    """What is chosen for a face."""
    chosen = obj.risorius.bake
    return Destination(BakeTo[chosen.onto], Onto(chosen.symmetric, chosen.smooth, chosen.above))


def destination_again(obj: Object, noted: str) -> Destination:
    """Where a clip goes that is baked again: to what it was baked to, as a clip of its own."""
    chosen = obj.risorius.bake
    return Destination(BakeTo(noted or BakeTo.NEW), Onto(chosen.symmetric, chosen.smooth, above=True))


def bake_reason(obj: Object | None) -> str | None:
    """Why nothing can be baked on the active object to where it is to go, or None."""
    if obj is None or obj.type != "MESH" or (to := destination_of(obj).to) is BakeTo.NEW:
        return face_reason(obj)
    reason = refusals.reason(obj, writing=False)
    if reason is not None:
        return reason
    if to is BakeTo.KEYS:
        return _keys_reason(obj)
    if not bpy.data.armatures:
        return f"{obj.name}: has no armature: bake to New Keys or My Keys"
    return None


def _keys_reason(obj: Object) -> str | None:
    """Why nothing can be baked to the shape keys of a face, or None."""
    members = target_of(obj).objects()
    if not any(user_keys(member) for member in members):
        return f"{obj.name}: has no shape keys of its own: bake to New Keys"
    keys = obj.data.shape_keys
    if keys is not None and not keys.use_relative:
        return f"{obj.name}: has absolute shape keys: turn on Relative in the Shape Keys panel"
    return None


def user_keys(obj: SceneObject) -> int:
    """How many shape keys of the user's own an object has, beside the Basis."""
    keys = obj.data.shape_keys if obj.type == "MESH" else None
    return 0 if keys is None else max(0, len(keys.key_blocks) - 1 - len(shape_keys.own_names_of(keys)))


def may_have_controls(obj: Object) -> bool:
    """Whether a face has so many shape keys that the user, who has not chosen yet, may want to bake to them."""
    return not obj.risorius.bake.is_property_set("onto") and user_keys(obj) >= MANY
