"""What is shown where a stream is unknown for a while: the tracker lost the face, or frames are missing.

Silence over a whole stream is a statement: anatomy decides. Silence between values is a hole, and a face that falls to
rest for one frame and comes back pops. A short hole is bridged evenly. In a long one nobody knows what the face did: it
goes to rest, or to what is laid out under the stream, and comes back as gently.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arrays import Bools, Floats, Ints
from ...errors import ParameterError
from ..standard import FAP_COUNT

#: Seconds of the longest hole that is bridged evenly: longer than a blink, shorter than most expressions.
LONGEST_BRIDGE = 0.5
#: Seconds in which a face goes to rest at the beginning of a longer one, and comes back at its end.
EASE = 0.4


@dataclass(frozen=True, eq=False)
class Bridged:
    """A stream without holes.

    Attributes
    ----------
    frames : (T, 68) FAP units; NaN where a FAP is silent.
    said : what was bridged, in words for people.
    """

    frames: Floats
    said: tuple[str, ...] = ()


def bridged(frames: Floats, fps: float, *, whole: bool = False, under: Floats | None = None) -> Bridged:
    """A stream whose holes are bridged, and what is to be said of them.

    Parameters
    ----------
    frames : (T, 68) FAP units, NaN where not stated.
    fps : frames per second.
    whole : a tracker's: what is stated at all is meant to be known all the time. Else only frames that state nothing
        are holes, and a FAP that is silent while others are stated is silent on purpose.
    under : (T, 68) what shows where the stream knows nothing, NaN where that is rest; None: rest.

    Raises
    ------
    ParameterError : frames of another shape.
    """
    filled = np.array(frames, dtype=np.float64)
    if filled.ndim != 2 or filled.shape[1] != FAP_COUNT:
        raise ParameterError("frames", f"must have the shape (T, {FAP_COUNT})", filled.shape)
    below = np.zeros_like(filled) if under is None else np.nan_to_num(under)
    known = ~np.isnan(filled)
    blind: Bools = np.asarray(~known.any(axis=1))
    longest = max(1, round(LONGEST_BRIDGE * fps))
    ease = max(1, round(EASE * fps))
    mended = np.zeros_like(known)
    for column in np.flatnonzero(known.any(axis=0) & ~known.all(axis=0)):
        for first, last in _runs(~known[:, column]):
            if whole or blind[first : last + 1].all():
                hole = slice(first, last + 1)
                way = _evenly if last - first < longest else _eased
                filled[hole, column] = way(filled[:, column], below[:, column], first, last, ease)
                mended[hole, column] = True
    if under is not None:
        filled = np.where(np.isnan(filled), under, filled)
    goes_to = "goes to rest" if under is None else "shows the timeline alone"
    partly: Bools = np.asarray((mended & ~blind[:, None]).any(axis=1))
    said = _said(np.asarray(blind & known.any()), partly, longest, fps, goes_to)
    return Bridged(filled, said)


def _evenly(values: Floats, below: Floats, first: int, last: int, ease: int) -> Floats:
    """Values of a short hole from frame to frame: on a line between its borders; at an end of the stream, held."""
    borders = [frame for frame in (first - 1, last + 1) if 0 <= frame < len(values)]
    return np.interp(np.arange(first, last + 1), borders, values[borders])


def _eased(values: Floats, below: Floats, first: int, last: int, ease: int) -> Floats:
    """Values of a long hole: from its borders to what lies below, and back."""
    places = np.arange(first, last + 1)
    shown = below[first : last + 1].copy()
    reach = float(min(ease, (last - first + 2) // 2))
    for border, away in ((first - 1, places - first + 1), (last + 1, last + 1 - places)):
        if 0 <= border < len(values):
            left = np.clip(1.0 - away / reach, 0.0, 1.0)
            shown += left**2 * (3.0 - 2.0 * left) * (values[border] - below[border])
    return np.asarray(shown)


def _runs(holes: Bools) -> Ints:
    """(n, 2) first and last place of each run of True in (T,)."""
    edges = np.diff(np.concatenate([[False], holes, [False]]).astype(np.int8))
    return np.stack([np.flatnonzero(edges == 1), np.flatnonzero(edges == -1) - 1], axis=1)


def _said(blind: Bools, partly: Bools, longest: int, fps: float, goes_to: str) -> tuple[str, ...]:
    """What is to be said of frames that state nothing, and of those that lack something."""
    runs = _runs(blind)
    short = [run for run in runs if run[1] - run[0] < longest]
    long = [run for run in runs if run[1] - run[0] >= longest]
    said = []
    for what, some in (
        ("bridged from those around", short),
        (f"longer than {longest / fps:.2g} s, the face {goes_to}", long),
    ):
        if some:
            count = sum(int(last - first) + 1 for first, last in some)
            where = ", ".join(_place(first, last) for first, last in some[:3]) + (" ..." if len(some) > 3 else "")
            said.append(f"{count} unknown frame{'s' * (count > 1)} ({where}): {what}")
    if partly.any():
        count = int(partly.sum())
        said.append(f"{count} frame{'s lack' if count > 1 else ' lacks'} some FAPs: bridged from those around")
    return tuple(said)


def _place(first: int, last: int) -> str:
    """Frames in a few letters."""
    return f"{first}" if first == last else f"{first} to {last}"
