"""What the user has laid out in time for a face, whether it is baked or not."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from ...arrays import Floats
from ...mpeg4 import Cue, Drawn, Liveliness, Ramp, drawn_within, load_timings
from ...scene.bake.timing import scene_fps
from ..blender_types import Object, Scene
from ..speech.strip_props import RISORIUS_PG_speech_strip
from ..speech.strips import Speech, length_of, playing_strips, speech_of
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
    speech : what is said beside them, or None.
    """

    first_frame: float
    fps: float
    cues: tuple[Cue, ...] = ()
    wanted: tuple[Wanted, ...] = field(default=())
    titles: tuple[str, ...] = ()
    liveliness: Liveliness = field(default_factory=Liveliness)
    speech: Speech | None = None

    @property
    def moves(self) -> bool:
        """Whether anything happens in it."""
        return bool(self.cues) or self.speech is not None

    @property
    def markers(self) -> list[tuple[str, float]]:
        """Where expressions and speech begin, by their titles."""
        felt = [(title, self.span(number)[0]) for number, title in enumerate(self.titles)]
        return felt + ([] if self.speech is None else list(zip(self.speech.titles, self.speech.starts, strict=True)))

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
        """The frame at which an expression is full; the first of all where there is none."""
        if not self.cues:
            return self.first_frame
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


@dataclass(frozen=True)
class _Throughout:
    """The times of an emotion that is there as long as something is said, and goes then."""

    start: int
    onset: float
    apex: float
    offset: float

    @classmethod
    def of(cls, strips: Sequence[RISORIUS_PG_speech_strip], fps: float) -> _Throughout:
        """From the first frame of strips to their last one."""
        start = min(strip.start for strip in strips)
        end = max(strip.start / fps + length_of(strip) for strip in strips)
        return cls(start, 0.0, end - start / fps, load_timings()["natural"].offset)


def performance_of(obj: Object, scene: Scene) -> Performance:
    """What is laid out for `obj`: the clips of its timeline and its speech; without clips, the chosen emotion.

    That has its own timing, or lasts as long as something is said.
    """
    timeline, fps, strips = obj.risorius.timeline, scene_fps(scene), playing_strips(obj)
    if timeline.clips:
        clips = playing_clips(timeline)
        choices = [_Choice(clip.emotion, clip, clip.peak, Ramp(clip.ramp)) for clip in clips]
        titles = [clip_title(clip) for clip in clips]
    else:
        times = _Throughout.of(strips, fps) if strips else obj.risorius.bake
        choices = [_Choice(obj.risorius.emotion, times)] if not strips or obj.risorius.speech.with_feeling else []
        titles = [title_of(obj.risorius.emotion)] * len(choices)
    starts = [choice.times.start for choice in choices] + [strip.start for strip in strips]
    first = min(starts, default=0)
    wanted = tuple(_drawn(obj, choice.emotion, number) for number, choice in enumerate(choices))
    cues = tuple(choice.cue(shown, first, fps) for choice, shown in zip(choices, wanted, strict=True))
    lively, speech = liveliness_of(timeline.variation), speech_of(obj, float(first), fps)
    return Performance(float(first), fps, cues, wanted, _told_apart(titles), lively, speech)


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
