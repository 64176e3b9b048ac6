"""Neighbouring sounds share a part of the mouth: dominance, after Cohen and Massaro 1993."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...arrays import Floats
from ...mpeg4 import FAP_COUNT
from .parts import FAPS_OF, Manner, MouthPart

#: Sounds farther away than this many reaches weigh nothing that shows.
FAR = 4.0


@dataclass(frozen=True, eq=False)
class Aim:
    """A sound's claim on the mouth: when, by which viseme, where to (68,), and how much of a closure, 0 to 1."""

    start: float
    end: float
    viseme: int
    target: Floats
    closes: float = 1.0


def blended(aims: Sequence[Aim], times: Floats, manner: Manner) -> Floats:
    """(T, 68) the mean of what sounds ask at some times, each part weighed in its own way; 0 for FAPs of no part.

    Parameters
    ----------
    aims : in order of time. times : (T,) seconds, ascending.
    """
    frames = np.zeros((len(times), FAP_COUNT))
    for part in MouthPart:
        columns = [number - 1 for number in FAPS_OF[part]]
        total, weights = np.zeros((len(times), len(columns))), np.zeros(len(times))
        for aim in aims:
            first, last = _felt(aim, times, manner, part)
            weight = _weight(aim, times[first:last], manner, part)
            weights[first:last] += weight
            total[first:last] += weight[:, None] * aim.target[columns]
        frames[:, columns] = total / np.maximum(weights, np.finfo(float).tiny)[:, None]
    return frames


def _felt(aim: Aim, times: Floats, manner: Manner, part: MouthPart) -> tuple[int, int]:
    """Which times a sound is felt at."""
    ahead, behind = manner.reach[part]
    first = int(np.searchsorted(times, aim.start - FAR * ahead))
    return first, int(np.searchsorted(times, aim.end + FAR * behind, side="right"))


def _weight(aim: Aim, times: Floats, manner: Manner, part: MouthPart) -> Floats:
    """How strongly a sound asks at some times: fully in its core, falling as a bell on either side."""
    ahead, behind = manner.reach[part]
    margin = 0.5 * (1.0 - manner.core) * (aim.end - aim.start)
    before, after = (aim.start + margin - times) / ahead, (times - aim.end + margin) / behind
    away = np.maximum(np.maximum(before, after), 0.0)
    return np.asarray(manner.strength[aim.viseme][part] * np.exp(-(away**2)))
