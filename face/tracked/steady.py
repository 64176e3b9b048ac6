"""Trembling taken out of what a tracker saw, without delay and without taking the edge off what moves.

A tracker measures each image anew, and a face that keeps still trembles by what it errs. Each FAP is compared with
parabolas through a fifth of a second about it (Savitzky and Golay 1964), which look ahead as far as back. Where the two
differ by no more than they usually do, the parabola counts; a blink or closing lips, which differ by more, stay but for
that much. A recording that does not tremble stays as it is.
"""

from __future__ import annotations

import numpy as np
from scipy.signal import savgol_filter

from ...arrays import Bools, Floats, Ints

#: Parabolas through so many seconds, about the length of the shortest motions of a face.
WINDOW, ORDER = 0.2, 2
#: A difference of more than so many standard deviations is motion. The median of absolute values gives these: of errors
#: that are distributed normally it is 1 / 1.4826 of one.
MOTION, NORMAL = 3.0, 1.4826


def steadied(frames: Floats, fps: float) -> Floats:
    """(T, 68) FAPs without trembling; NaN stays NaN and parts the stretches on its two sides."""
    steady = np.array(frames, dtype=np.float64)
    for column in steady.T:
        off = _off_parabolas(column, fps)
        most = MOTION * NORMAL * _median(np.abs(off))
        column -= np.clip(off, -most, most)
    return steady


def trembling(frames: Floats, fps: float) -> Floats:
    """(68,) standard deviation of what trembles of each FAP, FAP units; 0 where nothing is known."""
    return np.array([NORMAL * _median(np.abs(_off_parabolas(column, fps))) for column in np.asarray(frames).T])


def _median(values: Floats) -> float:
    """The median of what is known; 0 of nothing."""
    known = values[~np.isnan(values)]
    return float(np.median(known)) if len(known) else 0.0


def _off_parabolas(values: Floats, fps: float) -> Floats:
    """(T,) how far values are off the parabolas about them; 0 in stretches that are too short for one."""
    off = np.where(np.isnan(values), np.nan, 0.0)
    window = 2 * round(WINDOW * fps / 2.0) + 1
    for first, end in _stretches(~np.isnan(values)):
        if min(window, end - first) > ORDER + 1 and end - first >= window:
            off[first:end] = values[first:end] - savgol_filter(values[first:end], window, ORDER)
    return off


def _stretches(known: Bools) -> Ints:
    """(n, 2) first and end of each unbroken run of known values."""
    edges = np.diff(np.concatenate([[False], known, [False]]).astype(np.int8))
    return np.stack([np.flatnonzero(edges == 1), np.flatnonzero(edges == -1)], axis=1)
