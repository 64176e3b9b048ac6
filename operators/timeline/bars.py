"""Where clips lie in a timeline editor: a bar each, in as many lanes as they overlap; and what of a bar is grabbed."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Protocol

#: Pixels at a scale of 1: the editor's ruler, a lane at most and at least, between lanes, and how near a grip is meant.
RULER, LANE, LEAST_LANE, GAP, TOUCH = 23.0, 20.0, 5.0, 2.0, 5.0


class Timed(Protocol):
    """A clip, or whatever else has its times: `start` in frames, the others in seconds."""

    @property
    def start(self) -> int: ...
    @property
    def onset(self) -> float: ...
    @property
    def apex(self) -> float: ...
    @property
    def offset(self) -> float: ...


class Grip(StrEnum):
    """What of a bar is dragged: all of it, or the end of one of its times."""

    START = "start"
    ONSET = "onset"
    APEX = "apex"
    OFFSET = "offset"


@dataclass(frozen=True)
class Bar:
    """A clip in pixels of a region: `corners` are the x at which it begins, is full, begins to fade and is over."""

    number: int
    corners: tuple[float, float, float, float]
    low: float
    high: float

    def grip(self, x: float, y: float, touch: float) -> Grip | None:
        """What is under a pixel, or None; the later of two ends that lie together, so that it can be drawn out."""
        if not (self.low <= y <= self.high and self.corners[0] - touch <= x <= self.corners[3] + touch):
            return None
        ends = zip((Grip.OFFSET, Grip.APEX, Grip.ONSET), reversed(self.corners[1:]), strict=True)
        return next((grip for grip, there in ends if abs(x - there) <= touch), Grip.START)


def lay_out(
    clips: Iterable[Timed], fps: float, to_x: Callable[[float], float], height: float, scale: float
) -> list[Bar]:
    """The bars of clips, from the ruler down.

    Parameters
    ----------
    fps : frames per second.
    to_x : pixel of a frame. height : of the region, pixels. scale : of the interface.
    """
    spans = []
    for clip in clips:
        frames = [float(clip.start)]
        for seconds in (clip.onset, clip.apex, clip.offset):
            frames.append(frames[-1] + seconds * fps)
        spans.append(frames)
    lanes = _lanes(spans)
    room = max(height - RULER * scale, LEAST_LANE * scale)
    lane = min(LANE * scale, max(LEAST_LANE * scale, room / (max(lanes, default=0) + 1)))
    bars = []
    for number, (frames, place) in enumerate(zip(spans, lanes, strict=True)):
        high = height - RULER * scale - place * lane
        first, full, fading, over = (to_x(frame) for frame in frames)
        bars.append(Bar(number, (first, full, fading, over), high - lane + GAP * scale, high))
    return bars


def _lanes(spans: Sequence[Sequence[float]]) -> list[int]:
    """The first lane in which each span is free, spans taken in the order in which they begin."""
    ends: list[float] = []
    lanes = [0] * len(spans)
    for number in sorted(range(len(spans)), key=lambda k: (spans[k][0], k)):
        free = next((lane for lane, end in enumerate(ends) if end <= spans[number][0]), len(ends))
        ends[free:] = [spans[number][-1], *ends[free + 1 :]]
        lanes[number] = free
    return lanes


def dragged(grip: Grip, value: float, frames: float, fps: float) -> float:
    """A clip's start (frames) or one of its times (seconds) after a drag by so many frames.

    Whole frames; times stay 0 or more, and the start may lie before frame 0.
    """
    if grip is Grip.START:
        return float(round(value + frames))
    return max(0.0, round(value * fps + frames) / fps)
