"""The keyframes of a clip on a rig, as one action for each datablock that is keyed; found again, and taken away.

Actions bear the clip's name and point to the head that they belong to. Keys, bones and properties stay the user's; all
that is ours is these actions and the strips that play them.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import bpy
import numpy as np

from ...arrays import Bools, Floats
from ...errors import SceneError
from ..blender_types import Action, Datablock, Object
from ..fcurves import SMALL, add_keyframes, curves_for, played_curves
from ..shape_mix import RIG_TAG
from . import layers
from .channels import Channel, Place
from .layers import CLIP_TAG, INTO, noted
from .turns import keyed_values


@dataclass(frozen=True, eq=False)
class Keyframes:
    """Keyframes of channels: `frames` (N,), `values` channel -> (N,) from rest; `linear` between them, else eased."""

    frames: Floats
    values: Mapping[Channel, Floats]
    linear: bool = False

    @property
    def span(self) -> tuple[float, float]:
        """First and last frame."""
        return float(self.frames[0]), float(self.frames[-1])


@dataclass(frozen=True)
class WrittenClip:
    """The actions of a clip, and what the user should know."""

    actions: tuple[Action, ...]
    remarks: tuple[str, ...]


def refuse_unkeyable(owners: Iterable[Datablock]) -> None:
    """Refuse datablocks that cannot be keyed.

    Raises
    ------
    SceneError : a linked one, or one in the NLA's tweak mode; names it and the remedy.
    """
    for owner in owners:
        if owner.library is not None:
            remedy = "make a library override, or make it local (Object > Relations > Make Local > All)"
            raise SceneError(owner.name, f"is linked from another file and cannot be keyed: {remedy}")
        animation = owner.animation_data
        if animation is not None and animation.use_tweak_mode:
            raise SceneError(owner.name, "is in NLA tweak mode: leave it first (Tab in the NLA editor)")


def write_rig_clip(
    head: Object, clip: str, keyframes: Keyframes, *, above: bool = True, adding: bool = False
) -> WrittenClip:
    """Key a clip, in place of the one of this name; nothing can fail from here on.

    Parameters
    ----------
    above : on top of what plays already (`layers`); else as keyframes in the actions that play now.
    adding : what it shares frames with of our own is added to, not hidden.
    """
    keyframes = replace(keyframes, values=keyed_values(keyframes.values))
    by_owner = _by_owner(keyframes.values)
    remove_rig_clips(head, [clip])
    written, said = [], []
    for owner, places in by_owner:
        if not above and layers.user_action(owner) is not None:
            said += _write_into_action(owner, keyframes, places)
            continue
        action = bpy.data.actions.new(f"{head.name} {clip}" if len(by_owner) == 1 else f"{owner.name} {clip}")
        action[RIG_TAG], action[CLIP_TAG] = head, clip
        action.use_fake_user = True
        layers.note_rest(action, places)
        layer = layers.layer_for(owner, places, adding=adding)
        for place, channel in places:
            write_place(action, owner, place, layer.written(place, channel, keyframes.values[channel]), keyframes)
        first, last = keyframes.span
        action.use_frame_range = True
        action.frame_start, action.frame_end = first, max(last, first + 1.0)
        said += layers.play(owner, action, layer)
        written.append(action)
    return WrittenClip(tuple(written), tuple(dict.fromkeys(said)))


def _write_into_action(owner: Datablock, keyframes: Keyframes, places: Sequence[tuple[Place, Channel]]) -> list[str]:
    """Put keyframes of what moves into the action that plays, in place of those it has between the first and last."""
    animation = owner.animation_data
    curves = None if animation is None else played_curves(animation)
    assert animation is not None
    assert curves is not None
    first, last = keyframes.span
    ours = _written_before(animation.action, keyframes.span)
    for place, channel in places:
        if not np.abs(keyframes.values[channel]).max(initial=0.0) > SMALL and (place.path, place.index) not in ours:
            continue
        index = max(place.index, 0)
        curve = curves.find(place.path, index=index) or curves.new(place.path, index=index)
        for number in reversed(range(len(curve.keyframe_points))):
            if first <= curve.keyframe_points[number].co[0] <= last:
                curve.keyframe_points.remove(curve.keyframe_points[number], fast=True)
        values = channel.resting + keyframes.values[channel]
        kept = needed(keyframes.frames, values)
        for frame, value in zip(keyframes.frames[kept], values[kept], strict=True):
            point = curve.keyframe_points.insert(float(frame), float(value), options={"FAST"})
            point.interpolation = "LINEAR" if keyframes.linear else "BEZIER"
        curve.update()
        _note_written(animation.action, place, keyframes.span)
    return [f"{owner.name}: keyframes were written into its action"]


def _written_before(action: Action | None, span: tuple[float, float]) -> set[tuple[str, int]]:
    """(path, index) of what clips have been written into an action where a span meets theirs."""
    entries = [] if action is None else noted(action, INTO)
    return {(path, index) for path, index, theirs in entries if overlap(span, (theirs[0], theirs[1]))}


def _note_written(action: Action | None, place: Place, span: tuple[float, float]) -> None:
    """Note on an action what has been written into it, and where."""
    if action is not None:
        entries, entry = noted(action, INTO), (place.path, place.index, span)
        if entry not in entries:
            action[INTO] = json.dumps([(path, index, *frames) for path, index, frames in (*entries, entry)])


def overlap(one: tuple[float, float], other: tuple[float, float]) -> bool:
    """Whether two spans share frames."""
    return one[0] < other[1] and other[0] < one[1]


def _by_owner(values: Mapping[Channel, Floats]) -> list[tuple[Datablock, list[tuple[Place, Channel]]]]:
    """The places of channels, by the datablock that is keyed."""
    found: list[tuple[Datablock, list[tuple[Place, Channel]]]] = []
    for channel in values:
        for place in channel.places:
            entry = next((places for owner, places in found if owner == place.owner), None)
            if entry is None:
                found.append((place.owner, entry := []))
            entry.append((place, channel))
    return found


def write_place(action: Action, owner: Datablock, place: Place, values: Floats, keyframes: Keyframes) -> None:
    """Keyframes of one number in an action."""
    curves = curves_for(action, owner.id_type)
    curve = curves.new(place.path, index=max(place.index, 0))
    kept = needed(keyframes.frames, values) if keyframes.linear else np.ones(len(values), dtype=bool)
    add_keyframes(curve, keyframes.frames[kept], values[kept])
    for point in curve.keyframe_points:
        point.interpolation = "LINEAR" if keyframes.linear else "BEZIER"
        point.handle_left_type = point.handle_right_type = "AUTO_CLAMPED"
    curve.update()


def needed(frames: Floats, values: Floats) -> Bools:
    """(N,) which keyframes a straight line through their neighbours does not make of itself."""
    kept = np.ones(len(values), dtype=bool)
    if len(values) > 2:
        slopes = np.diff(values) / np.maximum(np.diff(frames), 1e-9)
        kept[1:-1] = np.abs(np.diff(slopes)) > 1e-9
    return kept


def rig_clips(head: Object) -> dict[str, list[Action]]:
    """Clip -> its actions, of all clips on the rig of a head."""
    found: dict[str, list[Action]] = {}
    for action in bpy.data.actions:
        if action.library is None and action.get(RIG_TAG) == head:
            found.setdefault(str(action.get(CLIP_TAG)), []).append(action)
    return found


def remove_rig_clips(head: Object, clips: Sequence[str] | None = None) -> tuple[str, ...]:
    """Take clips off the rig of a head: all, or those named. What played before plays again.

    Returns
    -------
    Names of the clips that were removed.
    """
    removed = []
    for clip, actions in rig_clips(head).items():
        if clips is not None and clip not in clips:
            continue
        for action in actions:
            layers.take_off(action)
            bpy.data.actions.remove(action)
        removed.append(clip)
    return tuple(removed)
