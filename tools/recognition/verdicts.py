"""What recognition says of measured faces, and how often it is right."""

from __future__ import annotations

from collections.abc import Mapping
from enum import StrEnum

import numpy as np
import risorius.api as api
from risorius.arrays import Bools, Floats
from risorius.mpeg4 import ARCHETYPES, Rule

from .poses import Measured

EMOTIONS = tuple(str(name) for name in ARCHETYPES)

#: The verdict where nothing is believed at all, and that of the robust rule on a face at rest.
NOTHING, NEUTRAL = "nothing", str(api.NEUTRAL)


class Way(StrEnum):
    """A way to recognise: from all FAPs or from the 15 features, by the paper's rule or the robust one."""

    FAPS_PAPER = "FAPs, paper"
    FAPS_ROBUST = "FAPs, robust"
    FEATURES_PAPER = "features, paper"
    FEATURES_ROBUST = "features, robust"

    @property
    def rule(self) -> Rule:
        """The rule it follows."""
        return Rule.PAPER if self in (Way.FAPS_PAPER, Way.FEATURES_PAPER) else Rule.ROBUST

    @property
    def of_features(self) -> bool:
        """Whether it sees the features alone."""
        return self in (Way.FEATURES_PAPER, Way.FEATURES_ROBUST)


Verdicts = Mapping[Way, np.ndarray]
"""Way -> (n,) the emotion of the largest belief, `NEUTRAL` or `NOTHING`."""

#: What a verdict may be besides an emotion.
OTHERS = (NEUTRAL, NOTHING)


def verdicts(believed: Floats) -> np.ndarray:
    """(n,) verdicts by equation (11) on beliefs (n, 6)."""
    named = np.array(EMOTIONS)[believed.argmax(axis=1)]
    return np.where(believed.max(axis=1) > 0.0, named, NOTHING)


def all_verdicts(measured: Measured) -> dict[Way, np.ndarray]:
    """Verdicts on measured faces by every way."""
    said = {}
    for way in Way:
        recognise, rows = (
            (api.recognise_features, measured.features) if way.of_features else (api.recognise, measured.faps)
        )
        said[way] = np.array([str(recognise(row, rule=way.rule).best or NOTHING) for row in rows])
    return said


def confusion(asked: np.ndarray, said: np.ndarray) -> Floats:
    """(6, 8) shares of the verdicts on each emotion; the last columns are `OTHERS`."""
    columns = (*EMOTIONS, *OTHERS)
    return np.array([[(said[asked == name] == verdict).mean() for verdict in columns] for name in EMOTIONS])


def correct(asked: np.ndarray, said: np.ndarray) -> tuple[float, float]:
    """The share of right verdicts, and that of the emotion that fares worst."""
    right: Bools = asked == said
    return float(right.mean()), min(float(right[asked == name].mean()) for name in np.unique(asked))
