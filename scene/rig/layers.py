"""How a clip on a rig plays: on top of what animates the same datablock already, to be taken off again.

Where nothing animates a datablock, the clip is its action, to be edited by hand. Else it lies on an NLA track above
all others and is combined with them: the clip's keyframes are what is added. An action that is playing and keys the
same numbers would hide it, so that action becomes a strip below; taking the clip off puts it back.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass

import bpy
import numpy as np

from ...arrays import Floats
from ...errors import SceneError
from ...tables import parsed_json
from ..blender_types import Action, AnimData, Datablock, NlaTrack
from ..fcurves import curves_of, is_empty, slot_for
from ..shape_mix import RIG_TAG
from .channels import Channel, Place

#: The name of a clip, on its actions.
CLIP_TAG = "risorius_rig_clip"
#: Our tracks are known by this name; Blender numbers tracks of one name.
TRACK_NAME = "Risorius Layer"
#: A property of an action: where what it keys is at rest.
REST = "risorius_rig_rest"
#: A property of a user's action: what has been written into it, and between which frames, as JSON.
INTO = "risorius_rig_into"
#: Numbers of each place in a note: the rest, or the first and the last frame.
NUMBERS = {REST: 1, INTO: 2}
#: A property of a datablock: the action that became a strip below a clip.
PUSHED = "risorius_pushed_down"


@dataclass(frozen=True, eq=False)
class Layer:
    """How the keyframes of one datablock are meant: added to what is below (`combined`), or as they are.

    `animated` : (path, index) that something below keys. `hidden` : the action that plays now would hide the clip.
    """

    combined: bool
    animated: frozenset[tuple[str, int]] = frozenset()
    hidden: bool = False

    def written(self, place: Place, channel: Channel, moved: Floats) -> Floats:
        """(N,) values of keyframes, from values that count from rest."""
        below = self.combined and (place.path, max(place.index, 0)) in self.animated
        return (channel.neutral if below else channel.resting) + moved


def layer_for(owner: Datablock, places: Sequence[tuple[Place, Channel]], *, adding: bool = False) -> Layer:
    """How a clip is to be laid over what a datablock plays; `adding` : it adds to another clip of ours, too."""
    numbers = [(place.path, max(place.index, 0)) for place, _ in places]
    keyed = _keyed(_user_actions(owner), numbers)
    current = user_action(owner)
    hidden = current is not None and bool(_keyed([current], numbers))
    return Layer(adding or bool(keyed), frozenset(numbers) if adding else keyed, hidden)


def _keyed(actions: Sequence[Action], numbers: Sequence[tuple[str, int]]) -> frozenset[tuple[str, int]]:
    """Those of some (path, index) that actions key."""
    full = [action for action in actions if not is_empty(action)]
    return frozenset(
        (path, index)
        for path, index in numbers
        if any(curves_of(action, path, part) for action in full for part in _together(path, index))
    )


def _together(path: str, index: int) -> Sequence[int]:
    """The numbers that Blender combines with one of a path: turns that are kept as four go together."""
    return range(4) if path.endswith(("rotation_quaternion", "rotation_axis_angle")) else (index,)


def _user_actions(owner: Datablock) -> list[Action]:
    """The actions that play on a datablock, alone or as strips, without ours."""
    animation = owner.animation_data
    if animation is None:
        return []
    strips = [s.action for track in animation.nla_tracks if not is_own(track) for s in track.strips]
    return [action for action in (animation.action, *strips) if action is not None and not _is_ours(action)]


def _own_actions(owner: Datablock) -> list[Action]:
    """Our clips that play on a datablock."""
    animation = owner.animation_data
    if animation is None:
        return []
    strips = [strip.action for track in animation.nla_tracks if is_own(track) for strip in track.strips]
    return [action for action in (animation.action, *strips) if action is not None and _is_ours(action)]


def user_action(owner: Datablock) -> Action | None:
    """The user's action that a datablock plays now."""
    animation = owner.animation_data
    action = None if animation is None else animation.action
    return None if action is None or _is_ours(action) else action


def _is_ours(action: Action) -> bool:
    """Whether an action is a clip on a rig."""
    return RIG_TAG in action


def is_own(track: NlaTrack) -> bool:
    """Whether an NLA track is one of ours."""
    return str(track.name).partition(".")[0] == TRACK_NAME


def play(owner: Datablock, action: Action, layer: Layer) -> list[str]:
    """Let a datablock play a clip, on top of all that it plays already.

    Returns
    -------
    Remarks for the user.
    """
    animation = owner.animation_data or owner.animation_data_create()
    said: list[str] = []
    current = animation.action
    if current is None and not animation.nla_tracks:
        animation.action = action
        if hasattr(animation, "action_slot"):
            animation.action_slot = slot_for(action, owner.id_type)
        return said
    if current is not None and (layer.hidden or _is_ours(current)):
        _push_down(owner, animation, current)
        if not _is_ours(current):
            said.append(f"{owner.name}: the action {current.name} plays as an NLA strip, with the clip on top of it")
    track = _free_track(animation, action)
    strip = track.strips.new(action.name, int(action.frame_start), action)
    if hasattr(strip, "action_slot"):
        strip.action_slot = slot_for(action, owner.id_type)
    strip.frame_start = action.frame_start
    strip.blend_type = "COMBINE" if layer.combined else "REPLACE"
    _hold_ends(animation)
    if not animation.use_nla:
        said.append(f"the NLA tracks of {owner.name} are turned off, so the clip does not play: turn them on")
    solo = next((track.name for track in animation.nla_tracks if track.is_solo and not is_own(track)), None)
    if solo is not None:
        said.append(f"the NLA track {solo} is solo, so the clip does not play: turn its star off in the NLA editor")
    return said


def _hold_ends(animation: AnimData) -> None:
    """Let the lowest of our tracks hold the ends of its clips, which are at rest; those above it would hide it there.

    A strip that said nothing outside its frames would leave the face as the last frame shown had it.
    """
    for number, track in enumerate(track for track in animation.nla_tracks if is_own(track)):
        strips = sorted(track.strips, key=lambda strip: strip.frame_start)
        for place, strip in enumerate(strips):
            strip.extrapolation = "NOTHING" if number else "HOLD_FORWARD" if place else "HOLD"


def _free_track(animation: AnimData, action: Action) -> NlaTrack:
    """The first of our tracks that is free at a clip's frames, or a new one on top of all."""
    first, last = float(action.frame_start), float(action.frame_end)
    for track in animation.nla_tracks:
        if is_own(track) and not any(s.frame_start < last and first < s.frame_end for s in track.strips):
            return track
    return _new_track(animation, TRACK_NAME)


def _new_track(animation: AnimData, name: str) -> NlaTrack:
    """A new track on top of all; the one that is active stays so."""
    active = animation.nla_tracks.active
    track = animation.nla_tracks.new()
    track.name = name
    if active is not None:
        animation.nla_tracks.active = active
    return track


def _push_down(owner: Datablock, animation: AnimData, action: Action) -> None:
    """Make the action that plays a strip on a track of its own, as Blender's Push Down does."""
    slot = animation.action_slot if hasattr(animation, "action_slot") else None
    ours = _is_ours(action)
    track = _new_track(animation, TRACK_NAME if ours else str(action.name))
    animation.action = None
    strip = track.strips.new(action.name, int(action.frame_range[0]), action)
    if slot is not None:
        strip.action_slot = slot
    strip.frame_start = action.frame_range[0]
    if not ours:
        owner[PUSHED] = action.name


def take_off(action: Action) -> None:
    """Stop a clip from playing, everywhere; what was pushed down for it plays as before once no clip is left.

    What nothing animates any more goes back to rest.
    """
    for owner in players(action):
        animation = owner.animation_data
        if animation is None:
            continue
        if animation.action == action:
            animation.action = None
        for track in [track for track in animation.nla_tracks if is_own(track)]:
            for strip in [strip for strip in track.strips if strip.action == action]:
                track.strips.remove(strip)
            if not track.strips:
                animation.nla_tracks.remove(track)
        _hold_ends(animation)
        if not any(is_own(track) for track in animation.nla_tracks):
            _pull_up(owner, animation)
        _settle(owner, action)


def note_rest(action: Action, places: Sequence[tuple[Place, Channel]]) -> None:
    """Note on an action where what it keys is at rest."""
    action[REST] = json.dumps([(place.path, place.index, channel.resting) for place, channel in places])


def noted(action: Action, name: str) -> list[tuple[str, int, tuple[float, ...]]]:
    """What is noted on an action under a name: path, index and numbers, of each place.

    Raises
    ------
    SceneError : somebody else has written there what is none of this.
    """
    try:
        entries = parsed_json(str(action.get(name, "[]")))
        found = [(str(path), int(index), tuple(map(float, numbers))) for path, index, *numbers in entries]
        if not all(len(numbers) == NUMBERS[name] and np.isfinite(numbers).all() for _, _, numbers in found):
            raise ValueError("numbers are missing")
    except (ValueError, TypeError, OverflowError) as error:
        problem = f"has a damaged note: delete its custom property {name}, and bake the clip again"
        raise SceneError(action.name, problem) from error
    return found


def put_at_rest(copy: Datablock, action: Action) -> None:
    """Put what a clip keys on a datablock to rest on a copy of that."""
    for path, index, (resting,) in noted(action, REST):
        Place(copy, path, index).set(resting)


def _settle(owner: Datablock, action: Action) -> None:
    """Put back to rest what a clip has keyed and nothing animates any more."""
    others = [*_user_actions(owner), *_own_actions(owner)]
    for path, index, (resting,) in noted(action, REST):
        if not _keyed(others, [(path, max(index, 0))]):
            Place(owner, path, index).set(resting)


def players(action: Action) -> list[Datablock]:
    """The datablocks that play an action."""
    users = bpy.data.user_map(subset=[action])[action]
    return [user for user in users if getattr(user, "animation_data", None) is not None]


def _pull_up(owner: Datablock, animation: AnimData) -> None:
    """Make the action that was pushed down the one that plays again."""
    name = owner.get(PUSHED)
    if name is None:
        return
    del owner[PUSHED]
    for track in list(animation.nla_tracks):
        strips = list(track.strips)
        if len(strips) == 1 and strips[0].action is not None and strips[0].action.name == name:
            if animation.action is None:
                slot = strips[0].action_slot if hasattr(strips[0], "action_slot") else None
                action = strips[0].action
                animation.nla_tracks.remove(track)
                animation.action = action
                if slot is not None:
                    animation.action_slot = slot
            return
