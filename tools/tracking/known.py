"""The FAP streams that the filmed heads show: expressions one after another, each up and down again."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import risorius.api as api
from risorius.arrays import Floats

FPS = 12.5

#: Beside a film's pictures: FAPs (T, 68) measured on the mesh, expressions (T,), pictures per second.
TRUTH = "truth.npz"

#: Beside a film of emotions: what was read off it.
READ = "read.fap"

#: Neutral frames before the first expression, and how strong each expression is from frame to frame.
BEFORE = 4
COURSE = (0.5, 1.0, 0.6, 0.0)

#: Expression -> FAPs at full strength. What is not stated follows by anatomy, so that what counts is what is measured.
EXPRESSIONS: Mapping[str, Mapping[int, float]] = {
    "jaw": {3: 600},
    "smile": {6: 160, 7: 160, 59: 220, 60: 220, 53: 160, 54: 160, 12: 220, 13: 220, 41: 120, 42: 120},
    "brows up": {31: 180, 32: 180, 33: 200, 34: 200, 35: 150, 36: 150},
    "frown": {31: -110, 32: -110, 33: -90, 34: -90, 37: 90, 38: 90, 61: 60, 62: 60, 63: 80},
    "lids shut": {19: 900, 20: 900, 21: 150, 22: 150},
    "pucker": {6: -140, 7: -140, 53: -140, 54: -140, 16: 150, 17: 150},
    "gaze left": {23: 30000, 24: 30000},
    "gaze down": {25: 25000, 26: 25000, 19: 250, 20: 250},
    "head": {48: 15000, 49: 25000, 50: 12000},
    "one side": {12: 250, 59: 250, 6: 120, 35: 160, 33: 150, 20: 500},
    "corners down": {12: -160, 13: -160, 59: -160, 60: -160, 31: 120, 32: 120, 5: 60, 18: 90},
    "upper lip": {4: -160, 8: -160, 9: -160, 51: -160, 55: -160, 56: -160, 61: 100, 62: 100, 63: 120, 64: 60},
    "lower lip": {5: -150, 10: -150, 11: -150, 52: -150, 57: -150, 58: -150},
    "jaw aside": {3: 250, 15: 150},
    "jaw forward": {14: 150},
    "cheeks puffed": {39: 150, 40: 150},
    "nostrils": {61: 120, 62: 120},
    "eyes wide": {19: -250, 20: -250, 31: 100, 32: 100},
}


EMOTIONS = ("joy", "surprise", "fear", "anger", "sadness", "disgust")


def known_expressions() -> dict[str, Floats]:
    """Expression -> (68,) FAPs at full strength, NaN where it says nothing."""
    apexes: dict[str, Floats] = {name: np.full(68, np.nan) for name in EXPRESSIONS}
    for name, values in EXPRESSIONS.items():
        for number, value in values.items():
            apexes[name][number - 1] = value
    return apexes


def known_emotions() -> dict[str, Floats]:
    """Each of the six emotions by its word."""
    return {name: api.expression(name).frame() for name in EMOTIONS}


#: Kind of film -> what it shows.
STREAMS = {"faps": known_expressions, "emotions": known_emotions}


def stream_of(apexes: Mapping[str, Floats]) -> tuple[Floats, list[str]]:
    """(T, 68) frames, NaN where they say nothing, and the expression that each frame shows."""
    rows: list[Floats] = [np.full(68, np.nan)] * BEFORE
    shown = ["neutral"] * BEFORE
    for name, apex in apexes.items():
        rows += [strength * apex if strength > 0.0 else np.full(68, np.nan) for strength in COURSE]
        shown += [name] * len(COURSE)
    return np.array(rows), shown
