"""Speech in a timeline editor: its times as a bar's, and what of it is dragged."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from ..timeline.bars import Grip
from .strip_props import STRETCH, RISORIUS_PG_speech_strip
from .strips import length_of, title_of_word


@dataclass(frozen=True)
class SpokenTimes:
    """The times of a strip: it is there from its first frame to its last; see `timeline.bars.Timed`."""

    start: int
    apex: float
    onset: float = 0.0
    offset: float = 0.0

    @classmethod
    def of(cls, strip: RISORIUS_PG_speech_strip) -> SpokenTimes:
        """As it is stretched."""
        return cls(int(strip.start), length_of(strip))


def word_spans(
    strip: RISORIUS_PG_speech_strip, fps: float, to_x: Callable[[float], float]
) -> Iterator[tuple[float, float, str, float, bool]]:
    """From which pixel to which each word lasts, its title, its strength, and whether it is the selected one."""
    for number, word in enumerate(strip.words):
        begins, ends = (to_x(strip.start + time * strip.stretch * fps) for time in (word.begins, word.ends))
        yield begins, ends, title_of_word(word), float(word.strength), number == strip.active


def is_stretched(grip: Grip) -> bool:
    """Whether a drag stretches a strip: at its end, where a clip has three grips."""
    return grip in (Grip.OFFSET, Grip.APEX)


def stretched_by(strip: RISORIUS_PG_speech_strip, before: float, frames: float, fps: float) -> float:
    """The stretch after the end was dragged by so many frames: it ends on a whole one."""
    if not strip.duration > 0.0:
        return before
    length = round(strip.duration * before * fps + frames) / fps
    return min(max(length / strip.duration, STRETCH[0]), STRETCH[1])
