"""Clips as actions: one action per clip with keyframes on the shape keys of one face.

A face may be several meshes (eyes, teeth and tongue apart), but its clips are one action each: the meshes' shape
keys bear the same names, and so share one action and its one slot. An own action keys *every* own shape of the
face, with a constant zero for those of other clips, so that no clip leaks into the next in the NLA editor or a game
engine. Own actions have a fake user, so that a clip that is not playing is saved too.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import bpy
import numpy as np

from ...arrays import Floats
from ...errors import ParameterError
from ..blender_types import Action, Key
from ..fcurves import add_keyframes, key_curves
from ..shape_mix import data_path as data_path
from . import tracks
from .shape_keys import own_names_of
from .tracks import CLIP_TAG, FACE_TAG


@dataclass(frozen=True, eq=False)
class Curve:
    """Keyframes of one shape key: `frames` (N,) and `values` (N,); `linear` between them, else eased."""

    frames: Floats
    values: Floats
    linear: bool = False

    def __post_init__(self) -> None:
        if self.frames.shape != self.values.shape or self.frames.ndim != 1 or len(self.frames) == 0:
            raise ParameterError("frames and values", "must be equally long and not empty", self.values.shape)


def write_curve(action: Action, key_name: str, curve: Curve) -> None:
    """Write one shape key's keyframes, in place of those it had."""
    fcurves = key_curves(action)
    path = data_path(key_name)
    old = fcurves.find(path)
    if old is not None:
        fcurves.remove(old)
    fcurve = fcurves.new(path)
    add_keyframes(fcurve, curve.frames, curve.values)
    for point in fcurve.keyframe_points:
        point.interpolation = "LINEAR" if curve.linear else "BEZIER"
        point.handle_left_type = point.handle_right_type = "AUTO_CLAMPED"
    fcurve.update()


def remove_curves(action: Action, key_names: Iterable[str]) -> None:
    """Remove the keyframes of the named shape keys."""
    fcurves = key_curves(action)
    for name in key_names:
        fcurve = fcurves.find(data_path(name))
        if fcurve is not None:
            fcurves.remove(fcurve)


def own_actions(face: str) -> list[Action]:
    """All clips of one face that this file holds: those of a linked file are that file's own."""
    local = (action for action in bpy.data.actions if action.library is None and action.override_library is None)
    return [action for action in local if face and action.get(FACE_TAG) == face]


def _used_elsewhere(action: Action, keys: Iterable[Key]) -> bool:
    """Whether anything besides these shape key datablocks plays the action."""
    users = bpy.data.user_map(subset=[action])[action]
    return bool(users - set(keys))


def write_clip(
    face: str,
    clip: str,
    name: str,
    curves: Mapping[str, Curve],
    *,
    keys: Iterable[Key],
    retired: Iterable[str] = (),
    silent: Iterable[str] = (),
) -> Action:
    """Write one clip as an action, in place of the one it had, and silence its keys in the face's other clips.

    Keyframes that a user has added to an own action for anything else stay.

    Parameters
    ----------
    face : the face's name (`shape_keys.OwnKeys.face`).
    clip : the clip's name within the face.
    name : what a new action is called.
    curves : shape key name -> its keyframes.
    keys : the shape key datablocks of the face's meshes.
    retired : names of the keys that the clip had before.
    silent : names of the keys of the face's other clips, which get a constant zero.

    Returns
    -------
    The action. Its frame range is the clip's.
    """
    keys, gone = list(keys), set(retired) - set(curves)
    others = [a for a in own_actions(face) if a.get(CLIP_TAG) != clip]
    mine = [a for a in own_actions(face) if a.get(CLIP_TAG) == clip and not _used_elsewhere(a, keys)]
    action = mine[0] if mine else bpy.data.actions.new(name)
    start = min(float(curve.frames[0]) for curve in curves.values())
    end = max(float(curve.frames[-1]) for curve in curves.values())
    remove_curves(action, gone)
    for key_name, curve in curves.items():
        write_curve(action, key_name, curve)
    for key_name in set(silent) - set(curves):
        write_curve(action, key_name, _silence(start))
    for other in others:
        remove_curves(other, gone)
        for key_name in curves:
            write_curve(other, key_name, _silence(other.frame_start))
    action[FACE_TAG], action[CLIP_TAG] = face, clip
    action.use_fake_user = True
    action.use_frame_range = True
    action.frame_start, action.frame_end = start, max(end, start + 1.0)
    return action


def _silence(frame: float) -> Curve:
    """A constant zero."""
    return Curve(np.array([frame]), np.zeros(1), linear=True)


def frames_of(action: Action) -> tuple[float, float]:
    """First and last frame of a clip."""
    start, end = action.frame_range
    return float(start), float(end)


def remove_clip(face: str, clip: str, *, keys: Iterable[Key], key_names: Iterable[str]) -> None:
    """Remove a clip's action, its strips, and its keys' silence in the face's other clips.

    An action that something else plays, or to which a user has added keyframes, loses only what is ours.
    """
    keys, key_names = list(keys), list(key_names)
    for action in own_actions(face):
        if action.get(CLIP_TAG) != clip:
            remove_curves(action, key_names)
            continue
        for datablock in keys:
            _detach(datablock, action)
        if _used_elsewhere(action, keys):
            continue
        remove_curves(action, [*key_names, *_own_names(keys)])
        if len(key_curves(action)) == 0:
            bpy.data.actions.remove(action)
        else:
            del action[FACE_TAG], action[CLIP_TAG]


def _own_names(keys: Iterable[Key]) -> set[str]:
    """Names of all own shape keys in the datablocks."""
    return {name for datablock in keys for name in own_names_of(datablock)}


def rename_face(old: str, new: str, keys: Iterable[Key]) -> None:
    """Give the clips that only these shape key datablocks play to the face `new`."""
    keys = list(keys)
    playing = bpy.data.user_map(subset=own_actions(old)) if own_actions(old) else {}
    for action, users in playing.items():
        if users and not users - set(keys):
            action[FACE_TAG] = new


def _detach(keys: Key, action: Action) -> None:
    """Stop a shape key datablock from playing the action."""
    animation = keys.animation_data
    if animation is None:
        return
    if animation.action == action:
        animation.action = None
    for track in list(animation.nla_tracks):
        for strip in list(track.strips):
            if strip.action == action:
                track.strips.remove(strip)
        if tracks.is_own(track) and not track.strips:
            animation.nla_tracks.remove(track)
