"""Membership functions compared: figure 6 of the first paper is lost, so that its shape is chosen by measurement.

Here the paper's rule is written once more for many faces at once and any shape; with the product's own choice it says
the same as `api.recognise` (a test compares them). The robust rule takes the curve that was chosen for the paper's.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np
import risorius.api as api
from risorius.arrays import Bools, Floats
from risorius.mpeg4 import ARCHETYPES, VARIANTS, Rule
from risorius.mpeg4.emotions.beside import known_classes
from risorius.mpeg4.emotions.fuzzy import LEAST_SEEN, LEAST_WIDTH, RELATIVE_WIDTH
from risorius.mpeg4.emotions.recognition import UNSEEN_MEMBERSHIP
from risorius.mpeg4.emotions.robust import archetype_rule

from .poses import Measured
from .verdicts import correct, verdicts


class Shape(StrEnum):
    """Falls from 1 to 1/2 within one width; `flat` shapes, and the trapezoid, are 1 all over the printed range."""

    TRIANGLE = "triangle"
    TRAPEZOID = "trapezoid"
    NORMAL = "normal curve"
    FLAT_NORMAL = "normal curve, flat top"
    BELL = "bell, 1 / (1 + x²)"
    FLAT_BELL = "bell, flat top"

    @property
    def flat(self) -> bool:
        """Whether the whole printed range has the membership 1."""
        return self in (Shape.TRAPEZOID, Shape.FLAT_NORMAL, Shape.FLAT_BELL)

    def at(self, distance: Floats) -> Floats:
        """Membership at a distance in widths."""
        if self in (Shape.TRIANGLE, Shape.TRAPEZOID):
            return np.asarray(np.clip(1.0 - distance / 2.0, 0.0, 1.0))
        if self in (Shape.NORMAL, Shape.FLAT_NORMAL):
            return np.asarray(np.exp2(-(distance**2)))
        return np.asarray(1.0 / (1.0 + distance**2))


@dataclass(frozen=True)
class Choice:
    """A membership function and a rule; `relative` and `least` as RELATIVE_WIDTH and LEAST_WIDTH of the product."""

    shape: Shape
    relative: float
    least: float
    rule: Rule


RELATIVE, LEAST = (0.35, 0.5, 0.75, 1.0, 1.5, 2.0), (20.0, 40.0, 80.0, 120.0)

CHOICES = tuple(Choice(*each, Rule.PAPER) for each in itertools.product(Shape, RELATIVE, LEAST))


def own(rule: Rule) -> Choice:
    """What Risorius does."""
    return Choice(Shape.NORMAL, RELATIVE_WIDTH, LEAST_WIDTH, rule)


def believed(faps: Floats, choice: Choice) -> Floats:
    """(n, 6) beliefs in the archetypes from FAPs (n, 68); by the robust rule, whatever the choice of shape."""
    best = np.zeros((len(faps), len(ARCHETYPES)))
    if choice.rule is Rule.ROBUST:
        judged = archetype_rule().judge(faps)
        for (name, _), belief in zip(known_classes(), judged.beliefs.T, strict=True):
            best[:, ARCHETYPES.index(name)] = np.maximum(best[:, ARCHETYPES.index(name)], belief)
        return best
    for column, name in enumerate(ARCHETYPES):
        for variant in VARIANTS[name]:
            ranges = api.archetype(name, variant).ranges
            values = faps[:, [number - 1 for number in ranges]]
            best[:, column] = np.maximum(best[:, column], _in_profile(values, np.array(list(ranges.values())), choice))
    return best


def _in_profile(values: Floats, ranges: Floats, choice: Choice) -> Floats:
    """(n,) beliefs in one profile from the FAPs it asks for (n, k) and their ranges (k, 2)."""
    centres, halves = ranges.mean(axis=1), (ranges[:, 1] - ranges[:, 0]) / 2.0
    widths = np.maximum(np.maximum(halves, choice.relative * np.abs(centres)), choice.least)
    distance = np.maximum(np.abs(values - centres) - (halves if choice.shape.flat else 0.0), 0.0)
    members = choice.shape.at(distance / widths)
    seen = ~np.isnan(values)
    belief = np.where(seen, members, UNSEEN_MEMBERSHIP).prod(axis=1)
    return np.where(seen.mean(axis=1) >= LEAST_SEEN, belief, 0.0)


def score(measured: Measured, choice: Choice) -> tuple[float, float]:
    """The share of archetypes recognised, and that of the emotion that fares worst."""
    return correct(measured.asked, verdicts(believed(measured.faps, choice)))


@dataclass(frozen=True)
class Trial:
    """The best choice of one shape and rule on one half of the poses, and how it does on both.

    Attributes
    ----------
    split : what the halves differ in.
    choice : best on the one half.
    chosen, held_out : score there and on the other half.
    own_held_out : the product's score on that other half.
    """

    split: str
    choice: Choice
    chosen: tuple[float, float]
    held_out: tuple[float, float]
    own_held_out: tuple[float, float]


def best_of(measured: Measured, choices: Sequence[Choice]) -> tuple[Choice, tuple[float, float]]:
    """The choice that recognises most; of equals the one whose worst emotion fares best."""
    scores = {choice: score(measured, choice) for choice in choices}
    best = max(scores, key=scores.__getitem__)
    return best, scores[best]


def held_out(measured: Measured) -> list[Trial]:
    """Choosing on one half of the faces, or of the variants, and judging on the other half, both ways round."""
    names = np.unique(measured.faces)
    halves: dict[str, Bools] = {
        "faces": np.isin(measured.faces, names[::2]),
        "variants": measured.variants % 2 == 0,
    }
    trials = []
    for split, half in halves.items():
        for chosen_on in (half, ~half):
            choice, chosen = best_of(measured.part(chosen_on), CHOICES)
            other = measured.part(~chosen_on)
            trials.append(Trial(split, choice, chosen, score(other, choice), score(other, own(Rule.PAPER))))
    return trials
