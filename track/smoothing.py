"""Trembling taken out of tracked FAPs, each unbroken stretch of a FAP for itself: unknown values stay unknown."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from enum import StrEnum

import numpy as np
from scipy.signal import savgol_filter

from ..arrays import Bools, Floats
from ..errors import ParameterError

#: Savitzky-Golay: parabolas through so many seconds, about the length of the shortest motions of a face.
WINDOW, ORDER = 0.2, 2

#: One-euro: cutoff (Hz) of a face at rest, its rise per FAP unit a second, and cutoff of the speed itself.
REST_CUTOFF, RISE, SPEED_CUTOFF = 1.5, 0.01, 1.0


class Smoothing(StrEnum):
    """How trembling is taken out.

    SAVGOL looks ahead as far as back, so that nothing lags (live it would come half a window late). EURO knows the past
    only and lags, the less the faster the face moves: what live use could have. NONE leaves values alone.
    """

    SAVGOL = "savgol"
    EURO = "euro"
    NONE = "none"

    @property
    def delay(self) -> float:
        """Seconds by which a slow motion comes late in the stream."""
        return 1.0 / (2.0 * np.pi * REST_CUTOFF) if self is Smoothing.EURO else 0.0


def smooth(frames: Floats, fps: float, how: str | Smoothing = Smoothing.SAVGOL) -> Floats:
    """Smoothed (T, F) values at an even rate; NaN stays NaN and parts the stretches on its two sides.

    Raises
    ------
    ParameterError : there is no such way.
    """
    try:
        way = Smoothing(how)
    except ValueError:
        raise ParameterError("smoothing", f"must be one of {', '.join(Smoothing)}", str(how)) from None
    smoothed: Floats = np.array(frames, dtype=np.float64)
    if way is Smoothing.NONE:
        return smoothed
    filtered: Callable[[Floats, float], Floats] = savitzky_golay if way is Smoothing.SAVGOL else one_euro
    for column in smoothed.T:
        for start, end in _stretches(~np.isnan(column)):
            column[start:end] = filtered(column[start:end], fps)
    return smoothed


def savitzky_golay(values: Floats, fps: float) -> Floats:
    """(T,) values, each by the parabola through those about it; as they are where the window is too short for one."""
    window = min(2 * round(WINDOW * fps / 2.0) + 1, len(values) - 1 + len(values) % 2)
    if window <= ORDER + 1:
        return values
    smoothed: Floats = savgol_filter(values, window, ORDER)
    return smoothed


def one_euro(values: Floats, fps: float) -> Floats:
    """(T,) values through a low-pass filter whose cutoff rises with the speed.

    Source: Casiez, Roussel, Vogel 2012, CHI, "1 euro filter"; figures: own choice.
    """
    out = values.copy()
    speed = 0.0
    for t in range(1, len(values)):
        speed += _share(SPEED_CUTOFF, fps) * ((values[t] - values[t - 1]) * fps - speed)
        out[t] = out[t - 1] + _share(REST_CUTOFF + RISE * abs(speed), fps) * (values[t] - out[t - 1])
    return out


def _share(cutoff: float, fps: float) -> float:
    """How much of a new value a first-order low-pass filter takes."""
    return 1.0 / (1.0 + fps / (2.0 * np.pi * cutoff))


def _stretches(known: Bools) -> Iterator[tuple[int, int]]:
    """First and end of each unbroken run of known values."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], known, [False]]).astype(np.int8)))
    yield from zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True)
