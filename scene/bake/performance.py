"""Several expressions of one face, one after another: a shape key and a clip for each, on one track of the timeline."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import bpy
import numpy as np

from ...errors import ParameterError
from ...progress import Work, written_together
from . import tracks
from .baking import BakeResult, bake_expression
from .target import Target
from .timing import ClipTiming

if TYPE_CHECKING:
    from ...api import Cue, Timing

ARCHETYPES = ("joy", "surprise", "fear", "anger", "sadness", "disgust")
#: Seconds of rest before, between and after expressions.
PAUSE = 0.2
#: Frame at which it begins in a scene of its own.
FIRST_FRAME = 1


def cues_of(words: Sequence[str], *, activation: float | None = None, timing: Timing | None = None) -> list[Cue]:
    """One cue per word, one after another, with the natural timing or another.

    `activation` : how strongly each is felt; None for the word's own.
    """
    from ... import api

    if not words:
        raise ParameterError("words", "must name at least one emotion", tuple(words))
    timing = api.load_timings()["natural"] if timing is None else timing
    cues: list[Cue] = []
    start = PAUSE
    for word in words:
        cues.append(timing.cue(api.expression(word, activation=activation), start=start))
        start = cues[-1].start + cues[-1].duration + PAUSE
    return cues


def clip_names(cues: Sequence[Cue]) -> list[str]:
    """A name for the clip of each cue: its word, with a number where the word has been there before."""
    names: list[str] = []
    for cue in cues:
        word = str(cue.profile.word)
        name, number = word, 1
        while name in names:
            name, number = f"{word} {number + 1}", number + 1
        names.append(name)
    return names


def pose_all(
    target: Target, cues: Sequence[Cue], fps: float, creases: bool | None, *, first_frame: int = FIRST_FRAME
) -> Work[list[BakeResult]]:
    """One shape key per cue, each clip at its cue's time from `first_frame` on; all are written, or none."""
    works = []
    for clip, cue in zip(clip_names(cues), cues, strict=True):
        timing = ClipTiming(
            start=first_frame + cue.start * fps, onset=cue.onset, apex=cue.apex, offset=cue.offset, fps=fps
        )
        work = bake_expression(
            target,
            cue.profile.frame(),
            clip=clip,
            timing=timing,
            peak=cue.peak,
            emotion=cue.profile.weights,
            creases=creases,
        )
        works.append(work)
    return (yield from written_together(works))


def line_up(target: Target, results: Sequence[BakeResult]) -> int:
    """Put the clips one after another on an NLA track of every mesh of the face; returns the last frame.

    Other clips stay on our tracks; an action of the user's own stays as it is, on top.
    """
    clips = [bpy.data.actions[result.action] for result in results]
    for obj in target.objects():
        animation = obj.data.shape_keys.animation_data if obj.data.shape_keys is not None else None
        if animation is None:
            continue
        if animation.action is not None and tracks.FACE_TAG in animation.action:
            animation.action = None
        tracks.take_off(animation, clips)
        for clip in clips:
            tracks.place(animation, clip)
    return int(np.ceil(max(result.frame_range[1] for result in results)))
