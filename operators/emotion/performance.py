"""What the user has laid out in time for a face, whether it is baked or not."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace

import numpy as np

from ...arrays import Floats
from ...mpeg4 import Cue, Drawn, Liveliness, Ramp, drawn_within
from ...scene.bake.timing import scene_fps
from ..blender_types import Object, Scene
from ..timeline.bars import Timed
from ..timeline.props import RISORIUS_PG_variation, playing_clips
from ..timeline.titles import clip_title
from .profile import Wanted, title_of, wanted_of, ways_between
from .props import RISORIUS_PG_emotion

#: Between the seeds of one clip and the next, so that clips of one emotion differ.
_NEXT_SEED = 7919


@dataclass(frozen=True)
class Performance:
    """Expressions in time.

    Attributes
    ----------
    first_frame : the frame at which the cues' time is 0. fps : frames per second.
    cues : when and how strongly each expression shows. wanted : what each shows at its apex.
    titles : what each is called, no two alike. liveliness : what the face does besides.
    """

    first_frame: float
    fps: float
    cues: tuple[Cue, ...] = ()
    wanted: tuple[Wanted, ...] = field(default=())
    titles: tuple[str, ...] = ()
    liveliness: Liveliness = field(default_factory=Liveliness)

    def shares(self, frame: float) -> Floats:
        """(C,) how much of each expression shows at a frame of the scene; together at most 1."""
        return np.asarray(self.shares_at(np.array([frame]))[0])

    def shares_at(self, frames: Floats) -> Floats:
        """(T, C) the same at frames (T,) of the scene."""
        times = (frames - self.first_frame) / self.fps
        strengths = np.array([cue.strength(times) for cue in self.cues]).reshape(len(self.cues), len(times)).T
        return np.asarray(strengths / np.maximum(1.0, strengths.sum(axis=1, keepdims=True)))

    def span(self, number: int) -> tuple[float, float]:
        """First and last frame of an expression."""
        cue = self.cues[number]
        start = self.first_frame + cue.start * self.fps
        return start, start + cue.duration * self.fps

    def apex(self, number: int = 0) -> float:
        """The frame at which an expression is full."""
        return self.span(number)[0] + self.cues[number].onset * self.fps


@dataclass(frozen=True, eq=False)
class _Choice:
    """An emotion with its times, and how much of it shows at its apex and how it comes and goes."""

    emotion: RISORIUS_PG_emotion
    times: Timed
    peak: float = Cue.peak
    ramp: Ramp = Cue.ramp

    def cue(self, wanted: Wanted, first: int, fps: float) -> Cue:
        """When it shows, in seconds from the first frame of all; it takes a frame at least to go."""
        # Blender keeps single precision: 1.2 s would come out a little longer, and the motion a frame.
        onset, apex, offset = (round(seconds, 6) for seconds in (self.times.onset, self.times.apex, self.times.offset))
        return Cue(
            wanted.profile,
            start=(self.times.start - first) / fps,
            onset=onset,
            apex=apex,
            offset=max(offset, 1.0 / fps),
            peak=self.peak,
            seed=self.emotion.seed or None,
            ramp=self.ramp,
        )


def performance_of(obj: Object, scene: Scene) -> Performance:
    """What is laid out for `obj`: the clips of its timeline, or without any the chosen emotion with its timing."""
    timeline, fps = obj.risorius.timeline, scene_fps(scene)
    if timeline.clips:
        clips = playing_clips(timeline)
        choices = [_Choice(clip.emotion, clip, clip.peak, Ramp(clip.ramp)) for clip in clips]
        titles = [clip_title(clip) for clip in clips]
    else:
        choices = [_Choice(obj.risorius.emotion, obj.risorius.bake)]
        titles = [title_of(obj.risorius.emotion)]
    first = min((choice.times.start for choice in choices), default=0)
    wanted = tuple(_drawn(obj, choice.emotion, number) for number, choice in enumerate(choices))
    cues = tuple(choice.cue(shown, first, fps) for choice, shown in zip(choices, wanted, strict=True))
    return Performance(float(first), fps, cues, wanted, _told_apart(titles), liveliness_of(timeline.variation))


def liveliness_of(variation: RISORIUS_PG_variation) -> Liveliness:
    """What the face does besides its expressions."""
    return Liveliness(
        blinks=Drawn(variation.blinks, variation.blinks_seed),
        head=Drawn(variation.head, variation.head_seed),
        eyes=Drawn(variation.eyes, variation.eyes_seed),
    )


def _drawn(obj: Object, emotion: RISORIUS_PG_emotion, number: int) -> Wanted:
    """What an emotion shows, drawn within its ranges where that is asked for and it has no seed of its own."""
    wanted, variation = wanted_of(obj, emotion), obj.risorius.timeline.variation
    if variation.draws == 0.0 or emotion.seed:
        return wanted
    profile = drawn_within(wanted.profile, Drawn(variation.draws, variation.draws_seed + _NEXT_SEED * number))
    return replace(wanted, profile=profile, faps=profile.frame(), drawn=ways_between(wanted.profile, profile))


def drawn_ways(shown: Iterable[tuple[str, Wanted]]) -> tuple[str, ...]:
    """What seeds drew of the ways in which titled expressions show their emotions, in words."""
    return tuple(
        f"{title}: {emotion} is shown {way}, drawn by its seed"
        for title, wanted in shown
        if wanted.drive == "natural"
        for emotion, way in wanted.drawn.items()
    )


def _told_apart(titles: list[str]) -> tuple[str, ...]:
    """Titles, those that repeat with a number: joy, joy 2."""
    told: list[str] = []
    for title in titles:
        number, name = 1, title
        while name in told:
            number += 1
            name = f"{title} {number}"
        told.append(name)
    return tuple(told)
