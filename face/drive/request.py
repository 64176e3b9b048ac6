"""What is asked of a face at one moment, and the ways in which it may be driven there."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import TypeAlias

import numpy as np

from ...arrays import Floats
from ...mpeg4 import FAP_COUNT, Archetype, Feeling

#: Archetype -> share of an expression, 0..1; an `Archetype` is its own name (a StrEnum).
EmotionShares: TypeAlias = Mapping[Archetype, float] | Mapping[str, float]

#: Muscle name -> contraction in [0, 1].
Contractions: TypeAlias = Mapping[str, float]


class Drive(StrEnum):
    """How FAPs move the face.

    natural : requests weighed against anatomy and each other, silent_faps filled by action units (default).
    exact : requests met exactly: muscles, then an elastic correction of the rest.
    muscles : contractions alone, as near as they come.
    points : the skin's elasticity alone, points moved exactly.
    """

    NATURAL = "natural"
    EXACT = "exact"
    MUSCLES = "muscles"
    POINTS = "points"


@dataclass(frozen=True, eq=False)
class ByHand:
    """Contractions set by hand, and how far the face has come towards them, 0..1."""

    contractions: Contractions
    share: float = 1.0


@dataclass(frozen=True, eq=False)
class Request:
    """What is asked of a face at one moment.

    Attributes
    ----------
    faps : (68,) FAP units, index = FAP number - 1; NaN where silent.
    drive : how they move the face.
    emotion : archetype -> share of the expression, where its word is known; counts in the natural drive alone.
    by_hand : contractions set by hand, the later over the earlier.
    """

    faps: Floats
    drive: Drive = Drive.NATURAL
    emotion: Feeling | None = None
    by_hand: tuple[ByHand, ...] = ()


def silent_faps() -> Floats:
    """(68,) FAPs of which none is asked."""
    return np.full(FAP_COUNT, np.nan)
