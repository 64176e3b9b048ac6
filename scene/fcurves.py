"""The F-curves of an action, whatever this Blender keeps them in. The only place that knows.

Blender 4.4 gave actions slots and layers, 5.0 took `Action.fcurves` away.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..arrays import Floats
from .attributes import read_floats, write_floats
from .blender_types import Action, AnimData, FCurve, FCurves, KeyframeStrip, Slot

#: Keyframes that differ less than this are no motion.
SMALL = 1e-6


def key_curves(action: Action) -> FCurves:
    """The F-curves of an action for shape keys; room for them is made where there is none."""
    return curves_for(action, "KEY")


def curves_for(action: Action, id_type: str) -> FCurves:
    """The F-curves of an action for datablocks of a type ("KEY", "OBJECT"); room is made where there is none."""
    if not hasattr(action, "slots"):
        action.id_root = id_type
        return action.fcurves
    slot = slot_for(action, id_type)
    layer = action.layers[0] if action.layers else action.layers.new("Layer")
    strip = layer.strips[0] if layer.strips else layer.strips.new(type="KEYFRAME")
    return strip.channelbag(slot, ensure=True).fcurves


def key_slot(action: Action) -> Slot | None:
    """The action's slot for shape keys, made where there is none; None where Blender has no slots."""
    return slot_for(action, "KEY")


def slot_for(action: Action, id_type: str) -> Slot | None:
    """The action's slot for datablocks of a type, made where there is none; None where Blender has no slots."""
    if not hasattr(action, "slots"):
        return None
    for slot in action.slots:
        if slot.target_id_type in {id_type, "UNSPECIFIED"}:
            return slot
    return action.slots.new(id_type=id_type, name="Face")


def played_curves(animation: AnimData) -> FCurves | None:
    """The F-curves that something plays; None where its action has none for it."""
    if animation.action is None:
        return None
    if not hasattr(animation.action, "slots"):
        return animation.action.fcurves
    if animation.action_slot is None:
        return None
    bags = (strip.channelbag(animation.action_slot) for strip in _strips(animation.action))
    return next((bag.fcurves for bag in bags if bag is not None), None)


def curves_of(action: Action, data_path: str, index: int = 0) -> list[FCurve]:
    """The F-curves of an action, in any slot of it, for one thing; the action stays as it is."""
    if not hasattr(action, "slots"):
        found = [action.fcurves.find(data_path, index=index)]
    else:
        found = [bag.fcurves.find(data_path, index=index) for strip in _strips(action) for bag in strip.channelbags]
    return [curve for curve in found if curve is not None]


def bone_curves(action: Action) -> list[FCurve]:
    """The F-curves of an action that move bones."""
    return [curve for curve in all_curves(action) if curve.data_path.startswith("pose.bones")]


def all_curves(action: Action) -> list[FCurve]:
    """All F-curves of an action, in any slot of it."""
    if not hasattr(action, "slots"):
        groups = [action.fcurves]
    else:
        groups = [bag.fcurves for strip in _strips(action) for bag in strip.channelbags]
    return [curve for group in groups for curve in group]


def changes(curve: FCurve) -> bool:
    """Whether a curve's keyframes differ."""
    values = read_floats(curve.keyframe_points, "co", 2)[:, 1]
    return len(values) > 1 and float(np.ptp(values)) > SMALL


def is_empty(action: Action) -> bool:
    """Whether an action has no F-curves at all."""
    if not hasattr(action, "slots"):
        return len(action.fcurves) == 0
    return not any(len(bag.fcurves) for strip in _strips(action) for bag in strip.channelbags)


def _strips(action: Action) -> Sequence[KeyframeStrip]:
    """The keyframe strips of an action with layers."""
    return [strip for layer in action.layers for strip in layer.strips]


def shift_keyframes(curve: FCurve, by: float) -> None:
    """Move all keyframes of an F-curve, handles included, by so many frames."""
    for what in ("co", "handle_left", "handle_right"):
        places = read_floats(curve.keyframe_points, what, 2)
        write_floats(curve.keyframe_points, what, places + np.array([by, 0.0]))


def add_keyframes(curve: FCurve, frames: Floats, values: Floats) -> None:
    """Put keyframes (N,) on an F-curve that has none but, perhaps, the first."""
    points = curve.keyframe_points
    points.add(len(frames) - len(points))
    write_floats(points, "co", np.column_stack([frames, values]))
