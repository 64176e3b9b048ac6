"""How clips play: one as the action of the shape keys, several as strips on NLA tracks of our own.

Clips at different times play one after another; of clips at the same time the newest shows. What a user has put there,
an action or tracks, stays as it is.
"""

from __future__ import annotations

from collections.abc import Iterable

from ..blender_types import Action, AnimData, Key, NlaStrip, NlaTrack
from ..fcurves import key_slot, slot_for

#: What an action of ours is known by, and its clip's name (`action.py`).
FACE_TAG, CLIP_TAG = "risorius_face", "risorius_clip"
TRACK_NAME = "Risorius"


def is_own(track: NlaTrack) -> bool:
    """Whether an NLA track is ours; Blender numbers tracks of one name."""
    return str(track.name).partition(".")[0] == TRACK_NAME


def play(keys: Key, action: Action) -> tuple[str, ...]:
    """Let a shape key datablock play a clip, beside all that it plays already.

    Returns
    -------
    Remarks for the user: what moved to the NLA, and what keeps the clip or another from showing.
    """
    animation = keys.animation_data or keys.animation_data_create()
    said: list[str] = []
    current = animation.action
    if current is not None and FACE_TAG not in current:
        said.append(f"the action {current.name} stays; the clip plays on the NLA track {TRACK_NAME}")
    elif not _own_tracks(animation) and (current is None or _is_one(current, action) or _overlap(current, action)):
        if current is not None and not _is_one(current, action):
            said.append(f"{current.get(CLIP_TAG)} lies on the same frames and no longer plays; its action is kept")
        _play_alone(animation, action)
        return tuple(said)
    elif current is not None and not _is_one(current, action):
        animation.action = None
        place(animation, current)
    else:
        animation.action = None
    place(animation, action)
    return (*said, *_silenced(keys, animation))


def _play_alone(animation: AnimData, action: Action) -> None:
    """Make a clip the action of the shape keys."""
    animation.action = action
    if hasattr(animation, "action_slot"):
        animation.action_slot = key_slot(action)


def _silenced(keys: Key, animation: AnimData) -> Iterable[str]:
    """What keeps our NLA tracks from playing."""
    if not animation.use_nla:
        yield f"the NLA tracks of {keys.name} are turned off, so the clip does not play: turn them on in the NLA editor"
    solo = next((track.name for track in animation.nla_tracks if track.is_solo and not is_own(track)), None)
    if solo is not None:
        yield f"the NLA track {solo} is solo, so the clip does not play: turn its star off in the NLA editor"
    if any(track.mute for track in _own_tracks(animation)):
        yield f"an NLA track {TRACK_NAME} is muted, so clips on it do not play: unmute it in the NLA editor"


def place(animation: AnimData, action: Action) -> None:
    """Put a clip on the first own track that is free at its frames, or on a new one on top."""
    take_off(animation, [action])
    own = _own_tracks(animation)
    track = next((track for track in own if not any(_overlap(strip, action) for strip in track.strips)), None)
    if track is None:
        track = animation.nla_tracks.new()
        track.name = TRACK_NAME
    strip = add_strip(track, action)
    if own and track != own[0]:
        strip.extrapolation = "NOTHING"  # below it the first track says what shows before and after
        return
    first = min(track.strips, key=lambda each: each.frame_start)
    for each in track.strips:
        each.extrapolation = "HOLD" if each == first else "HOLD_FORWARD"


def take_off(animation: AnimData, actions: Iterable[Action]) -> None:
    """Remove the strips of some clips from our tracks, and tracks that are empty then."""
    going = set(actions)
    for track in _own_tracks(animation):
        for strip in [strip for strip in track.strips if strip.action in going]:
            track.strips.remove(strip)
        if not track.strips:
            animation.nla_tracks.remove(track)


def plays(keys: Key | None, action: Action) -> bool:
    """Whether a shape key datablock plays a clip, alone or as a strip."""
    animation = keys.animation_data if keys is not None else None
    if animation is None:
        return False
    return animation.action == action or any(
        strip.action == action for track in animation.nla_tracks if not track.mute for strip in track.strips
    )


def played_frames(keys: Key | None) -> tuple[int, int] | None:
    """First and last frame of all clips that a shape key datablock plays; None where it plays none."""
    animation = keys.animation_data if keys is not None else None
    if animation is None:
        return None
    heard = [track for track in _own_tracks(animation) if animation.use_nla and not track.mute]
    played: list[Action | NlaStrip] = [strip for track in heard for strip in track.strips]
    if animation.action is not None and FACE_TAG in animation.action:
        played.append(animation.action)
    if not played:
        return None
    return int(min(each.frame_start for each in played)), int(max(each.frame_end for each in played))


def add_strip(track: NlaTrack, action: Action, id_type: str = "KEY") -> NlaStrip:
    """Put a clip on an NLA track of a kind of datablock, at its own frames; outside them it holds its ends, at rest.

    A strip that said nothing there would leave the face as the last frame shown had it.
    """
    strip = track.strips.new(action.name, int(action.frame_start), action)
    if hasattr(strip, "action_slot"):
        strip.action_slot = slot_for(action, id_type)
    strip.frame_start = action.frame_start
    strip.extrapolation = "HOLD_FORWARD" if len(track.strips) > 1 else "HOLD"
    return strip


def _own_tracks(animation: AnimData) -> list[NlaTrack]:
    """Our tracks that hold something, the lowest first."""
    return [track for track in animation.nla_tracks if is_own(track) and track.strips]


def _is_one(one: Action, other: Action) -> bool:
    """Whether two actions are one clip: a linked clip's successor in this file takes its place."""
    return one == other or all(one.get(tag) == other.get(tag) for tag in (FACE_TAG, CLIP_TAG))


def _overlap(one: Action | NlaStrip, other: Action) -> bool:
    """Whether two clips share frames; strips begin on whole frames, so parts of one count."""
    return int(one.frame_start) < other.frame_end and int(other.frame_start) < one.frame_end
