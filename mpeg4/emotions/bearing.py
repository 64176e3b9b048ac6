"""Where a word turns eyes and head while it is performed: what a still face does not tell.

Source of the figures: the words' own tables in presets/emotions.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...arrays import Floats
from ...tables import KeyedTable
from ..standard import ANGLE_UNIT, FAP_COUNT

#: FAPs of both eyeballs, to the left and down; of the head, down, to the left, and onto the right shoulder.
EYES_LEFT, EYES_DOWN = (23, 24), (25, 26)
HEAD_DOWN, HEAD_LEFT, HEAD_TILT = 48, 49, 50

#: No neck or eye turns further, degrees.
MOST = 45.0


@dataclass(frozen=True)
class Bearing:
    """How far eyes and head turn at the apex of a word, degrees.

    Attributes
    ----------
    eyes : to the subject's left, down. head : to the subject's left, down, onto the right shoulder.
    """

    eyes: tuple[float, float] = (0.0, 0.0)
    head: tuple[float, float, float] = (0.0, 0.0, 0.0)

    def frame(self, *, eyes: float, head: float) -> Floats:
        """(68,) FAP units at shares of what eyes and head do; NaN elsewhere and where a share is 0."""
        faps = np.full(FAP_COUNT, np.nan)
        if eyes > 0.0:
            for numbers, degrees in zip((EYES_LEFT, EYES_DOWN), self.eyes, strict=True):
                faps[[number - 1 for number in numbers]] = eyes * math.radians(degrees) / ANGLE_UNIT
        if head > 0.0:
            for number, degrees in zip((HEAD_LEFT, HEAD_DOWN, HEAD_TILT), self.head, strict=True):
                faps[number - 1] = head * math.radians(degrees) / ANGLE_UNIT
        return faps


def read_bearing(entry: KeyedTable) -> Bearing:
    """A word's bearing out of its table.

    Raises
    ------
    FormatError : names the file, the key and the rule.
    """
    entry.only("eyes", "head", "source")
    entry.text("source")
    turns = {
        name: tuple(map(float, entry.numbers(name, count)))
        for name, count in (("eyes", 2), ("head", 3))
        if name in entry
    }
    for name, degrees in turns.items():
        if max(map(abs, degrees)) > MOST:
            raise entry.refuse(f"must be degrees from -{MOST:g} to {MOST:g}", name)
    return Bearing(**turns)  # type: ignore[arg-type]  # of the lengths that were read
