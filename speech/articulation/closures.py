"""What must be reached at any tempo: lips that meet for p b m, the lower lip at the upper teeth for f v."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...arrays import Floats
from ...mpeg4 import VISEME_SHAPES
from ...progress import Progress, Work
from .blending import AT_ONCE, Aim
from .parts import FAPS_OF, JAW, Closure, Manner, MouthPart

#: Parts that a closure draws; tongue and corners stay with its neighbours.
DRAWN = (MouthPart.JAW, MouthPart.OPENING, MouthPart.ROUNDING)


def closed(frames: Floats, aims: Sequence[Aim], times: Floats, manner: Manner) -> Work[Floats]:
    """(T, 68) frames that reach the closure of every sound that has one.

    Parameters
    ----------
    frames : (T, 68) FAPs with what the jaw carries. times : (T,) seconds, evenly apart.
    """
    moved = frames.copy()
    for viseme, share in (yield from closing_shares(aims, times, manner)).items():
        moved = _drawn(moved, share, viseme, manner.closures[viseme])
    return moved


def closing_shares(aims: Sequence[Aim], times: Floats, manner: Manner) -> Work[dict[int, Floats]]:
    """Viseme -> (T,) how far its closure is reached at some times, evenly apart: 0 to 1."""
    step = float(times[1] - times[0]) if len(times) > 1 else 0.0
    shares = {}
    for place, (viseme, closure) in enumerate(manner.closures.items()):
        shares[viseme] = share = np.zeros(len(times))
        for number, aim in enumerate(aims):
            if number % AT_ONCE == 0:
                done = (place + number / len(aims)) / len(manner.closures)
                yield Progress(done, f"Closing the lips for sound {number + 1} of {len(aims)}")
            if aim.viseme == viseme:
                near = span(times, *reached(aim, closure, step))
                share[near] = np.maximum(share[near], closing(aim, closure, times[near], step))
    return shares


def span(times: Floats, first: float, last: float) -> slice:
    """Which of some times, ascending, lie from one to another: what is far away is not looked at, be it an hour."""
    return slice(int(np.searchsorted(times, first)), int(np.searchsorted(times, last, side="right")))


def reached(aim: Aim, closure: Closure, step: float) -> tuple[float, float]:
    """From when to when a closure shows."""
    middle, held = 0.5 * (aim.start + aim.end), max(0.5 * closure.hold * (aim.end - aim.start), 0.5 * step)
    return middle - held - closure.ramp, middle + held + closure.ramp


def closing(aim: Aim, closure: Closure, times: Floats, step: float) -> Floats:
    """(T,) how far a closure is reached, 0 to as far as is asked: held about the middle, for a frame at least."""
    middle = 0.5 * (aim.start + aim.end)
    held = max(0.5 * closure.hold * (aim.end - aim.start), 0.5 * step)
    away = np.clip((np.abs(times - middle) - held) / closure.ramp, 0.0, 1.0)
    return np.asarray(aim.closes * (0.5 + 0.5 * np.cos(np.pi * away)))


def _drawn(frames: Floats, share: Floats, viseme: int, closure: Closure) -> Floats:
    """Frames drawn to a closure: FAPs of `DRAWN`."""
    moved, shape = frames.copy(), VISEME_SHAPES[viseme]
    jaw = frames[:, JAW - 1]
    moved[:, JAW - 1] = jaw + share * (np.minimum(jaw, closure.jaw) - jaw)
    for number in (*FAPS_OF[MouthPart.OPENING], *FAPS_OF[MouthPart.ROUNDING]):
        goal = closure.faps.get(number, shape[number - 1])
        if not np.isnan(goal):
            moved[:, number - 1] += share * (goal - moved[:, number - 1])
    return moved
