"""Which emotions a request shows: told by its word, or by looking at it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ....arrays import Floats
from ....mpeg4 import Feeling, recognise
from ...figures import Share, read_figures
from .symmetry import mirrored


@dataclass(frozen=True)
class SightFigures:
    """How far the recogniser is believed (presets/anatomy/natural.toml)."""

    doubt: Share
    sharpness: float


SIGHT = read_figures("natural.sight", SightFigures)

#: An emotion of a smaller share of the evidence is not seen.
LEAST_SHARE = 0.01


@dataclass(frozen=True)
class Shown:
    """Which emotions a request shows, and how certain that is.

    Attributes
    ----------
    shares : archetype -> share, summing to 1 (or empty). certainty : 0..1; 1 where the word was given.
    """

    shares: Mapping[str, float]
    certainty: float

    @classmethod
    def by_word(cls, emotion: Feeling) -> Shown:
        """A given word's shares; none where it has action units of its own, which no archetype's sum explains."""
        if emotion.shows is not None:
            return cls({}, 1.0)
        shares = {str(name): float(share) for name, share in emotion.items() if share > 0.0}
        return cls(shares, 1.0 if shares else 0.0)

    @classmethod
    def by_sight(cls, faps: Floats) -> Shown:
        """What the paper's recogniser (section 5) makes of a request (68,) whose word is not known.

        Some of the paper's profiles differ a little from left to right. A face and its mirror image show the same
        emotion, so both are looked at.
        """
        seen, seen_mirrored = recognise(faps), recognise(mirrored(faps))
        evidence = {
            str(name): (float(belief) ** SIGHT.sharpness + float(seen_mirrored[name]) ** SIGHT.sharpness) / 2.0
            for name, belief in seen.items()
        }
        total = sum(evidence.values())
        if total <= 0.0:
            return cls({}, 0.0)
        shares = {name: value / total for name, value in evidence.items() if value > LEAST_SHARE * total}
        return cls(shares, total / (total + SIGHT.doubt**SIGHT.sharpness))
