"""Beliefs over time as F-curves: a custom property per emotion on the face's object, for drivers, graphs and rigs."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy
import numpy as np

from ...errors import SceneError
from ..blender_types import Action, AnimData, FCurve, Object, Slot
from ..fcurves import add_keyframes, is_empty, played_curves

if TYPE_CHECKING:
    from ...api import BeliefTrack

#: Custom properties are called risorius_joy and so on; the F-curves lie in a group of this name.
PREFIX, GROUP = "risorius_", "Risorius Beliefs"
STRENGTH, NEUTRAL = "strength", "neutral"


def property_names() -> tuple[str, ...]:
    """The custom properties: one per emotion, the strength of the best one, and the neutral face (robust rule)."""
    from ... import api

    return tuple(f"{PREFIX}{name}" for name in (*api.ARCHETYPES, STRENGTH, NEUTRAL))


def write_curves(obj: Object, track: BeliefTrack) -> Action:
    """Write beliefs as keyframes of custom properties, in place of those that were there; returns the action.

    They go into the action that the object plays, or a new one. Its other F-curves stay.

    Raises
    ------
    SceneError : an object or action that cannot be written to; nothing has been changed then.
    """
    refuse_unwritable_curves(obj)
    remove_curves(obj)
    columns = [*track.beliefs.T, track.strengths]
    if track.neutral is not None:
        columns.append(np.nan_to_num(track.neutral))
    about = dict.fromkeys(property_names(), "Belief that the face shows this emotion")
    about[f"{PREFIX}{STRENGTH}"] = "Strength of the emotion that the face shows"
    about[f"{PREFIX}{NEUTRAL}"] = "Belief that the face is neutral"
    for name, values in zip(property_names(), columns, strict=False):
        obj[name] = float(values[0])
        obj.id_properties_ui(name).update(min=0.0, max=10.0, soft_max=1.0, description=about[name])
        obj.keyframe_insert(_path(name), frame=float(track.numbers[0]), group=GROUP)
        curve = _curve(obj, name)
        assert curve is not None
        add_keyframes(curve, track.numbers, values)
        for point in curve.keyframe_points:
            point.interpolation = "LINEAR"
        curve.update()
    action = obj.animation_data.action if obj.animation_data is not None else None
    assert action is not None
    action.update_tag()
    obj.update_tag()
    return action


def refuse_unwritable_curves(obj: Object) -> None:
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


def has_curves(obj: Object) -> bool:
    """Whether beliefs have been written on `obj`."""
    return any(name in obj for name in property_names())


def remove_curves(obj: Object) -> None:
    """Take beliefs and their F-curves away; an action that held nothing else goes, too."""
    animation = obj.animation_data
    curves = played_curves(animation) if animation is not None else None
    for name in property_names():
        if name not in obj:
            continue
        curve = curves.find(_path(name)) if curves is not None else None
        if curves is not None and curve is not None:
            curves.remove(curve)
        del obj[name]
    if animation is not None and animation.action is not None and not played_curves(animation):
        _stop(animation, animation.action)


def _stop(animation: AnimData, action: Action) -> None:
    """Play no action that has nothing for the object; one that has nothing at all goes."""
    slot: Slot | None = getattr(animation, "action_slot", None)
    animation.action = None
    if action.users == action.use_fake_user and is_empty(action):
        bpy.data.actions.remove(action)
    elif slot is not None and not slot.users():
        action.slots.remove(slot)


def _path(name: str) -> str:
    """RNA path of a custom property."""
    return f'["{name}"]'


def _curve(obj: Object, name: str) -> FCurve | None:
    """The F-curve of a custom property that the object plays; None where there is none."""
    curves = played_curves(obj.animation_data) if obj.animation_data is not None else None
    return None if curves is None else curves.find(_path(name))
