"""Beliefs over time as F-curves: a custom property per emotion on the face's object, for drivers, graphs and rigs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import bpy
import numpy as np

from ...errors import SceneError
from ..attributes import write_floats

if TYPE_CHECKING:
    from ...api import BeliefTrack

#: Custom properties are called risorius_joy and so on; the F-curves lie in a group of this name.
PREFIX, GROUP = "risorius_", "Risorius Beliefs"
STRENGTH = "strength"


def property_names() -> tuple[str, ...]:
    """The custom properties: one per emotion, and the strength of the most believed one."""
    from ... import api

    return tuple(f"{PREFIX}{name}" for name in (*api.ARCHETYPES, STRENGTH))


def write_curves(obj: Any, track: BeliefTrack) -> Any:
    """Write beliefs as keyframes of custom properties, in place of those that were there; returns the action.

    They go into the action that the object plays, or a new one. Its other F-curves stay.

    Raises
    ------
    SceneError : an object or action that cannot be written to; nothing has been changed then.
    """
    refuse_unwritable_curves(obj)
    remove_curves(obj)
    columns = [*track.beliefs.T, track.strengths]
    for name, values in zip(property_names(), columns, strict=True):
        obj[name] = float(values[0])
        about = (
            "Strength of the emotion that the face shows"
            if name.endswith(STRENGTH)
            else "Belief that the face shows this emotion"
        )
        obj.id_properties_ui(name).update(min=0.0, max=10.0, soft_max=1.0, description=about)
        obj.keyframe_insert(_path(name), frame=float(track.numbers[0]), group=GROUP)
        curve = _played(obj).find(_path(name))
        points = curve.keyframe_points
        points.add(len(values) - 1)
        write_floats(points, "co", np.column_stack([track.numbers, values]))
        for point in points:
            point.interpolation = "LINEAR"
        curve.update()
    obj.animation_data.action.update_tag()
    obj.update_tag()
    return obj.animation_data.action


def refuse_unwritable_curves(obj: Any) -> None:
    """Refuse an object whose custom properties cannot be animated. Cheap enough for a button's poll.

    Raises
    ------
    SceneError : names what is in the way, and the remedy.
    """
    if obj.library is not None or obj.override_library is not None:
        raise SceneError(obj.name, "is linked from another file: make it local (Object > Relations > Make Local) first")
    animation = obj.animation_data
    if animation is not None and animation.use_tweak_mode:
        raise SceneError(obj.name, "is in NLA tweak mode: leave it first (Tab in the NLA editor)")
    if animation is not None and animation.action is not None and animation.action.library is not None:
        raise SceneError(obj.name, f"plays the linked action {animation.action.name}: make it single user first")


def has_curves(obj: Any) -> bool:
    """Whether beliefs have been written on `obj`."""
    return any(name in obj for name in property_names())


def remove_curves(obj: Any) -> None:
    """Take beliefs and their F-curves away; an action that held nothing else goes, too."""
    action = obj.animation_data.action if obj.animation_data is not None else None
    for name in property_names():
        if name not in obj:
            continue
        curves = _played(obj) if action is not None else None
        if curves is not None and curves.find(_path(name)) is not None:
            curves.remove(curves.find(_path(name)))
        del obj[name]
    if action is not None and not _played(obj):
        _stop(obj, action)


def _stop(obj: Any, action: Any) -> None:
    """Play no action that has nothing for the object; one that has nothing at all goes."""
    slot = getattr(obj.animation_data, "action_slot", None)
    obj.animation_data.action = None
    if action.users == action.use_fake_user and not any(len(bag) for bag in _all_curves(action)):
        bpy.data.actions.remove(action)
    elif slot is not None and not slot.users():
        action.slots.remove(slot)


def _path(name: str) -> str:
    """RNA path of a custom property."""
    return f'["{name}"]'


def _played(obj: Any) -> Any:
    """The F-curves that the object plays, whatever this Blender keeps them in; None where its action has none."""
    animation = obj.animation_data
    if not hasattr(animation.action, "slots"):
        return animation.action.fcurves
    if animation.action_slot is None:
        return None
    bags = (strip.channelbag(animation.action_slot) for strip in _strips(animation.action))
    return next((bag.fcurves for bag in bags if bag is not None), None)


def _all_curves(action: Any) -> list[Any]:
    """All collections of F-curves in an action."""
    if not hasattr(action, "slots"):
        return [action.fcurves]
    return [bag.fcurves for strip in _strips(action) for bag in strip.channelbags]


def _strips(action: Any) -> list[Any]:
    """The keyframe strips of an action with layers."""
    return [strip for layer in action.layers for strip in layer.strips]
