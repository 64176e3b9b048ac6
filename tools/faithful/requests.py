"""How well a face meets the FAPs it is asked for: exactly in the exact drive, within anatomy in the natural one."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import risorius.api as api
from risorius.api import Drive, Face, Profile
from risorius.arrays import Bools, Floats
from risorius.face.drive.natural.synergies import load_synergies
from risorius.mpeg4 import VARIANTS

#: Requests below so many units are judged as if they were that large: an error of 3 units in 5 is nothing to see.
LEAST_REQUEST = 100.0

#: What "met" means in the natural drive, as a share of the request.
MET = 0.1


@dataclass(frozen=True)
class Met:
    """Errors (n,) of all requests of some profiles on one face, as shares of the request or of `LEAST_REQUEST`.

    Attributes
    ----------
    errors : (n,). moderate : (n,) requests that anatomy passes unchanged. possible : (n,) those inside the range.
    """

    errors: Floats
    moderate: Bools
    possible: Bools


def profiles() -> dict[str, Profile]:
    """The 25 profiles of the first paper's Table 5 ("fear:8") and the words of its Table 6."""
    archetypes = {f"{name}:{v}": api.archetype(name, v) for name in api.ARCHETYPES for v in VARIANTS[name]}
    return archetypes | {word: api.expression(word) for word in words()}


def words() -> list[str]:
    """The fourteen words of the first paper's Table 6, in its order."""
    return [name for name, word in api.WORDS.items() if "Table 6" in word.source and name not in api.ARCHETYPES]


def met(face: Face, drive: Drive, asked: dict[str, Profile]) -> Met:
    """How well a face meets profiles; only FAPs that it can show are judged."""
    parts = []
    for profile in asked.values():
        frame = profile.frame()
        emotion = profile.weights if drive is Drive.NATURAL else None
        achieved = face.pose(frame, drive=drive, emotion=emotion).achieved
        moderate, possible = within_range(frame)
        judged = ~np.isnan(frame) & ~np.isnan(achieved)
        errors = np.abs(achieved - frame) / np.maximum(np.abs(frame), LEAST_REQUEST)
        parts.append(np.stack([errors[judged], moderate[judged], possible[judged]]))
    errors, moderate, possible = np.concatenate(parts, axis=1)
    return Met(errors, moderate > 0.0, possible > 0.0)


def within_range(frame: Floats) -> tuple[Bools, Bools]:
    """(68,) requests of a frame within the part of the anatomical range that passes unchanged, and within all of it."""
    data = load_synergies()
    way = frame[data.numbers - 1] * data.per_fap
    limit = np.where(way < 0.0, data.low, data.high)
    linear = np.where(way < 0.0, data.low_linear, data.high_linear)
    moderate, possible = np.zeros(68, dtype=bool), np.zeros(68, dtype=bool)
    moderate[data.numbers - 1] = np.abs(way) <= np.abs(limit * linear)
    possible[data.numbers - 1] = np.abs(way) <= np.abs(limit)
    return moderate, possible
