"""Samples in time: what a tracker wrote, before it is a stream at an even rate."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ....arrays import Floats
from ....errors import ParameterError

#: Values are interpolated between samples no farther apart than this many usual intervals; a longer gap is unknown.
LONGEST_GAP = 2.5

#: A moment within this share of an interval from a sample takes that sample as it is: trackers round their times.
SNAP = 1e-3

#: Frames of a stream; more is a damaged time, not a recording (eleven hours at 25 a second).
MOST_FRAMES = 1_000_000


@dataclass(frozen=True, eq=False)
class Samples:
    """FAPs at times of a recording's own.

    Attributes
    ----------
    times : (T,) seconds, rising.
    frames : (T, 68) FAP units; NaN where unknown.
    assumed : what the file does not say and was assumed, in words for people.
    """

    times: Floats
    frames: Floats
    assumed: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        if self.times.shape != (len(self.frames),) or len(self.times) == 0:
            raise ParameterError("times", f"must be one for each of {len(self.frames)} frames", self.times.shape)
        if not np.isfinite(self.times).all() or (np.diff(self.times) <= 0.0).any():
            raise ParameterError("times", "must be finite and increase from sample to sample", "unordered times")

    @property
    def fps(self) -> float:
        """Samples per second, from the usual interval, rounded where it is a whole number within a hundredth."""
        if len(self.times) < 2:
            return 25.0
        rate = 1.0 / float(np.median(np.diff(self.times)))
        return float(round(rate)) if abs(rate - round(rate)) < 0.01 * rate and rate >= 1.0 else rate

    def evenly(self, fps: float | None = None) -> tuple[Floats, float]:
        """(N, 68) frames at an even rate from the first time on, and that rate.

        Between samples values are interpolated; they are unknown where either neighbour is, and within long gaps.

        Raises
        ------
        ParameterError : a rate that is no positive number; times so far apart that the stream would never end.
        """
        rate = self.fps if fps is None else fps
        if not (math.isfinite(rate) and rate > 0.0):
            raise ParameterError("fps", "must be a positive number of frames per second", rate)
        count = np.floor((self.times[-1] - self.times[0]) * rate + 0.5) + 1
        if count > MOST_FRAMES:
            raise ParameterError("times", f"must not span more than {MOST_FRAMES} frames", float(count))
        return self.at(self.times[0] + np.arange(int(count)) / rate), rate

    def at(self, when: Floats) -> Floats:
        """(N, 68) FAPs at times (N,); NaN where unknown."""
        if len(self.times) == 1:
            return np.repeat(self.frames, len(when), axis=0)
        interval = float(np.median(np.diff(self.times)))
        right = np.clip(np.searchsorted(self.times, when), 1, len(self.times) - 1)
        before, after = self.times[right - 1], self.times[right]
        share = np.clip((when - before) / (after - before), 0.0, 1.0)
        share = np.where(share < SNAP, 0.0, np.where(share > 1.0 - SNAP, 1.0, share))[:, None]
        first, last = self.frames[right - 1], self.frames[right]
        mixed = first + share * (last - first)
        inside = np.where(share == 0.0, first, np.where(share == 1.0, last, mixed))
        too_far = ((after - before) > LONGEST_GAP * interval)[:, None] & (share > 0.0) & (share < 1.0)
        return np.where(too_far, np.nan, inside)
