"""Neighbouring sounds share a part of the mouth: dominance, after Cohen and Massaro 1993."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...arrays import Floats
from ...mpeg4 import FAP_COUNT, VISEMES
from ...progress import Progress, Work
from .parts import FAPS_OF, Manner, MouthPart

#: Sounds farther away than this many reaches weigh nothing that shows.
FAR = 4.0
#: Sounds between two reports of progress.
AT_ONCE = 500


@dataclass(frozen=True, eq=False)
class Aim:
    """A sound's claim on the mouth: when, by which viseme, where to (68,), and how distinctly, 0 to 2."""

    start: float
    end: float
    viseme: int
    target: Floats
    strength: float = 1.0

    @property
    def closes(self) -> float:
        """How much of a closure it is, 0 to 1."""
        return min(self.strength, 1.0)


def blended(aims: Sequence[Aim], times: Floats, manner: Manner) -> Work[Floats]:
    """(T, 68) the mean of what sounds ask at some times, each part weighed in its own way; 0 for FAPs of no part.

    Parameters
    ----------
    aims : in order of time. times : (T,) seconds, ascending.
    """
    frames = np.zeros((len(times), FAP_COUNT))
    for place, part in enumerate(MouthPart):
        columns = [number - 1 for number in FAPS_OF[part]]
        total, weights = np.zeros((len(times), len(columns))), np.zeros(len(times))
        felt = zip(*_felt(aims, times, manner, part), strict=True)
        for number, (aim, (first, last)) in enumerate(zip(aims, felt, strict=True)):
            if number % AT_ONCE == 0:
                done = (place + number / len(aims)) / len(MouthPart)
                yield Progress(done, f"Laying out sound {number + 1} of {len(aims)}: {part}")
            weight = _weight(aim, times[first:last], manner, part)
            weights[first:last] += weight
            total[first:last] += weight[:, None] * aim.target[columns]
        frames[:, columns] = total / np.maximum(weights, np.finfo(float).tiny)[:, None]
    return frames


def shared(aims: Sequence[Aim], times: Floats, manner: Manner) -> Work[dict[MouthPart, Floats]]:
    """Part of the mouth -> (T, 15) the share of each viseme in it, times how distinctly it is said; 0: rest.

    Parameters as for `blended`.
    """
    shares = {}
    for place, part in enumerate(MouthPart):
        yield Progress.counted(place, len(MouthPart), "parts of the mouth shared")
        told, weights = np.zeros((len(times), len(VISEMES))), np.zeros(len(times))
        for aim, first, last in zip(aims, *_felt(aims, times, manner, part), strict=True):
            weight = _weight(aim, times[first:last], manner, part)
            weights[first:last] += weight
            told[first:last, aim.viseme] += weight * aim.strength
        shares[part] = told / np.maximum(weights, np.finfo(float).tiny)[:, None]
    return shares


def _felt(aims: Sequence[Aim], times: Floats, manner: Manner, part: MouthPart) -> tuple[list[int], list[int]]:
    """From which time to which each sound is felt."""
    ahead, behind = manner.reach[part]
    first = np.searchsorted(times, np.array([aim.start for aim in aims]) - FAR * ahead)
    last = np.searchsorted(times, np.array([aim.end for aim in aims]) + FAR * behind, side="right")
    return first.tolist(), last.tolist()


def _weight(aim: Aim, times: Floats, manner: Manner, part: MouthPart) -> Floats:
    """How strongly a sound asks at some times: fully in its core, falling as a bell on either side."""
    ahead, behind = manner.reach[part]
    margin = 0.5 * (1.0 - manner.core) * (aim.end - aim.start)
    before, after = (aim.start + margin - times) / ahead, (times - aim.end + margin) / behind
    away = np.maximum(np.maximum(before, after), 0.0)
    return np.asarray(manner.strength[aim.viseme][part] * np.exp(-(away**2)))
