"""How far muscles are believed, place by place: where they explain badly what is asked, the elastic skin answers.

Muscles bring motion that no FAP measures, in depth and between the points, as skin does that they have moved. Where
something else was drawn or asked, they leave much of it over, or would have to go further than muscles go; then the
rest of their motion is a guess, and the least motion of an elastic skin through the points is the better one. So their
answer is faded into the elastic one over the skin about such points. What an emotion expects of a muscle for its own
sake, and what was set by hand, is no explanation of anything and is not doubted.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ...arrays import Floats
from ..figures import Length, Pair, Share, read_figures
from ..response.actuators import Amounts
from ..skin.outer import smoothstep
from .inverse import Inverse
from .targets import Targets


@dataclass(frozen=True)
class BeliefFigures:
    """When and where muscles are not believed (presets/anatomy/targets.toml)."""

    over: Length
    unseen: Length
    doubted: Pair
    least: Share
    prior: float


FIGURES = read_figures("targets.belief", BeliefFigures)


class Belief:
    """Judges the muscles' explanations on one face."""

    def __init__(self, inverse: Inverse) -> None:
        self.inverse = inverse

    @cached_property
    def _near(self) -> Floats:
        """(n, m) how near the skin lies to each row's point, 0..1."""
        skin, rows = self.inverse.actuators.skin, self.inverse.rows
        points = np.array([skin.points[name] for name in rows.names]).reshape(-1, 3)
        squared = np.stack([((skin.positions - point) ** 2).sum(axis=1) for point in points], axis=1)
        return np.asarray(np.exp(-0.5 * squared / FIGURES.over**2))

    def shares(self, found: Amounts, targets: Targets) -> Floats:
        """(n,) how far the muscles among amounts found for targets are believed, 0..1."""
        inverse = self.inverse
        known = ~np.isnan(targets.displacements)
        carried = np.asarray(inverse.matrix @ inverse.actuators.carried(found).ravel())
        asked = np.where(known, targets.displacements - carried, 0.0)
        left = np.where(known, np.abs(asked - inverse.muscles_on_rows(found)) - targets.doubts, 0.0)
        size = self._near @ asked**2 + FIGURES.unseen**2
        first, last = FIGURES.doubted
        told = self._near @ known.astype(np.float64)
        unexplained = (self._near @ np.maximum(left, 0.0) ** 2) / size * (told / (told + FIGURES.prior))
        unexplained = smoothstep((unexplained - first) / (last - first))
        beyond = (self._near @ (asked**2 * (1.0 - targets.believed))) / size
        return np.asarray((1.0 - (1.0 - FIGURES.least) * unexplained) * (1.0 - beyond))

    def guessed(self, found: Amounts, amounts: Amounts, targets: Targets) -> Floats:
        """(n, 3) the part of the muscles' motion that is not believed, low strain, metres.

        found : amounts found for the targets. amounts : these, some of them set by hand.
        """
        actuators = self.inverse.actuators
        expected = np.array([targets.muscles.get(muscle.name, 0.0) for muscle in actuators.muscles])
        free = np.where(amounts.muscles == found.muscles, np.maximum(found.muscles - expected, 0.0), 0.0)
        doubt = 1.0 - self.shares(found, targets)
        return doubt[:, None] * actuators.low_strain(replace(found, muscles=free))
