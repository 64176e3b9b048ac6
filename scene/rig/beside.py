"""Clips on the rig and clips of new shape keys that play at the same frames: their motions add up."""

from __future__ import annotations

from ..bake import shape_keys
from ..bake.action import frames_of, own_actions
from ..bake.tracks import CLIP_TAG, plays
from ..blender_types import Object
from .clips import overlap
from .kept import kept_clips


def adding_up(head: Object) -> tuple[str, ...]:
    """Remarks on clips of new shape keys that play at the same frames as clips on the rig."""
    said = []
    for clip, kept in kept_clips(head).items():
        twins = [
            str(action.get(CLIP_TAG))
            for action in own_actions(shape_keys.own_face(head.data))
            if plays(head.data.shape_keys, action) and overlap(frames_of(action), kept.frames)
        ]
        if twins:
            said.append(
                f"{clip} on the rig and {', '.join(twins)} of new shape keys play at the same frames and add up: "
                "clear one of them"
            )
    return tuple(said)
