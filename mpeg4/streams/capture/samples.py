"""Samples in time: what a tracker wrote, before it is a stream at an even rate."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ....arrays import Floats
from ....errors import ParameterError
from ...standard import FRAMES_LIMIT, check_fps
from .rates import LONGEST_STEP, usual_rate
from .times import USUAL_RATE, Times

#: In an even row every missing frame is a gap, so steps of more than one and a half intervals are.
LONGEST_EVEN_STEP = 1.5

#: A moment within this share of an interval from a sample takes that sample as it is: trackers round their times.
SNAP = 1e-3


@dataclass(frozen=True, eq=False)
class Samples:
    """FAPs at times of a recording's own.

    Attributes
    ----------
    times : (T,) seconds, rising.
    frames : (T, 68) FAP units; NaN where unknown.
    assumed : what the file does not say and was assumed, in words for people.
    rate : samples per second; None: as the times show.
    even : whether each is a frame of an even count; then what lies between others is missing, however short.
    begin : seconds at which a stream of them begins; None: with the first sample.
    """

    times: Floats
    frames: Floats
    assumed: tuple[str, ...] = ()
    rate: float | None = None
    even: bool = False
    begin: float | None = None

    def __post_init__(self) -> None:
        if self.times.shape != (len(self.frames),) or len(self.times) == 0:
            raise ParameterError("times", f"must be one for each of {len(self.frames)} frames", self.times.shape)
        if not np.isfinite(self.times).all() or (np.diff(self.times) <= 0.0).any():
            raise ParameterError("times", "must be finite and increase from sample to sample", "unordered times")

    @classmethod
    def at_times(cls, times: Times, frames: Floats, *, start: float | str | None = None) -> Samples:
        """What a file says: frames of the rows that were kept, (T, 68), at their times, from `start` on."""
        if start is not None:
            return cls(times.seconds, frames, times.assumed, times.rate, times.even, times.since_first(start))
        begins = () if times.begins is None else (times.begins,)
        return cls(times.seconds, frames, (*times.assumed, *begins), times.rate, times.even)

    @property
    def fps(self) -> float:
        """Samples per second: as told, else the usual rate of their times."""
        if self.rate is not None:
            return self.rate
        return usual_rate(np.diff(self.times)) if len(self.times) > 1 else USUAL_RATE

    def evenly(self, fps: float | None = None) -> tuple[Floats, float]:
        """(N, 68) frames at an even rate from the beginning on, and that rate.

        Between samples values are interpolated; they are unknown where either neighbour is, and within gaps.

        Raises
        ------
        ParameterError : a rate that is no positive number; times so far apart that the stream would never end.
        """
        rate = self.fps if fps is None else fps
        check_fps(rate)
        begin = float(self.times[0]) if self.begin is None else self.begin
        count = np.floor((self.times[-1] - begin) * rate + 0.5) + 1
        if count > FRAMES_LIMIT:
            raise ParameterError("times", f"must not span more than {FRAMES_LIMIT} frames", float(count))
        return self.at(begin + np.arange(int(count)) / rate), rate

    def at(self, when: Floats) -> Floats:
        """(N, 68) FAPs at times (N,); NaN where unknown."""
        interval = 1.0 / self.fps
        outside = when < self.times[0] - interval / 2.0
        if len(self.times) == 1:
            return np.where(outside[:, None], np.nan, np.repeat(self.frames, len(when), axis=0))
        right = np.clip(np.searchsorted(self.times, when), 1, len(self.times) - 1)
        before, after = self.times[right - 1], self.times[right]
        share = np.clip((when - before) / (after - before), 0.0, 1.0)
        snap = np.minimum(SNAP * interval / (after - before), SNAP)
        share = np.where(share < snap, 0.0, np.where(share > 1.0 - snap, 1.0, share))[:, None]
        first, last = self.frames[right - 1], self.frames[right]
        mixed = first + share * (last - first)
        inside = np.where(share == 0.0, first, np.where(share == 1.0, last, mixed))
        longest = (LONGEST_EVEN_STEP if self.even else LONGEST_STEP) * interval
        too_far = ((after - before) > longest)[:, None] & (share > 0.0) & (share < 1.0)
        return np.where(too_far | outside[:, None], np.nan, inside)
