"""What counts how much: the skin, the points that FAPs are read from, the gaze, and controls that fight each other.

What is nearest over the outer skin alone often misses what FAPs measure, looks aside to lift a lid, and has keys on
that undo each other. Each of these is mended as far as the skin's motion is shown hardly less well for it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...arrays import Bools, Floats
from .bounded import bounded_over_time
from .fights import COSTS, ON, Pairs, Settled, against, both_on, costs, opposed_pairs
from .normal import Normal, Seen, Wishes, normal_equations

#: How many times as much as all skin the points of FAPs may count, and the gaze. The first of each is always given.
EMPHASES = (0.1, 0.2, 0.4, 0.8, 1.6, 3.2, 6.4)
GAZES = (0.4, 0.6, 0.8, 1.2, 1.6, 2.4, 3.2, 6.4)
#: A FAP that is requested counts as much as this many others.
REQUESTED = 8.0
#: So much less of the skin's motion may be explained for the gaze's sake, for FAPs before fights are settled, in all.
YIELD_TO_GAZE, YIELD_TO_FAPS, YIELD = 0.0135, 0.012, 0.0185
#: So much of it FAPs get however much the gaze has taken.
STEP = 0.0015
#: Fights are settled where FAPs are still met nearer than by the skin alone, by this share of its errors, or where what
#: is wrong is less than this share of what they move.
NEARER, SLIGHT = 0.98, 0.05
#: Squared errors that are none, square metres.
NOTHING = 1e-12
#: What a control costs, as a share of what its whole range does: what changes nothing is off.
SPARING = 0.0015
#: Frames that all this is chosen on, at most.
SAMPLE = 60
#: How often the cost of fights is shared anew.
ROUNDS = 3


@dataclass(frozen=True, eq=False)
class Counted:
    """Which points are what: (m,) `faps`, the others are of the gaze; `requested` FAPs."""

    faps: Bools
    requested: Bools

    def weights(self, emphasis: float, gaze: float) -> Floats:
        """(m,) how much each point counts, all skin 1."""
        each = np.where(self.requested, REQUESTED, 1.0)
        return np.asarray(each * np.where(self.faps, emphasis, max(emphasis, gaze)) / max(float(each.sum()), 1.0))


def weighed_values(
    does: Seen,
    asked: Wishes,
    counted: Counted,
    low: Floats,
    high: Floats,
    *,
    smooth: float,
    mirror: Mapping[int, int],
) -> Floats:
    """(T, K) values of controls for a motion, points and gaze weighed and fights settled.

    Parameters
    ----------
    does : what K controls do. asked : what T frames ask of them. low, high : (K,) limits.
    smooth : weight of second differences over time. mirror : control -> its mirror image.
    """
    some = np.unique(np.linspace(0, len(asked.size) - 1, SAMPLE).astype(np.int64))
    sample = _Trial(does, Wishes(asked.skin[some], asked.points[some], asked.size[some]), counted, low, high)
    gaze = sample.most(GAZES, YIELD_TO_GAZE, lambda tried: sample.values(counted.weights(EMPHASES[0], tried), []))
    spent = sample.loss(sample.values(counted.weights(EMPHASES[0], gaze), []))
    emphasis = sample.most(
        EMPHASES, max(YIELD_TO_FAPS, spent + STEP), lambda tried: sample.values(counted.weights(tried, gaze), [])
    )
    settled = sample.settled(counted.weights(emphasis, gaze), mirror)
    more = [step for step in EMPHASES if step >= emphasis]
    emphasis = sample.most(more, YIELD, lambda tried: sample.values(counted.weights(tried, gaze), settled))
    whole = _Trial(does, asked, counted, low, high)
    return whole.values(counted.weights(emphasis, gaze), settled, smooth)


@dataclass(frozen=True, eq=False)
class _Trial:
    """Some frames, on which weights are tried."""

    does: Seen
    asked: Wishes
    counted: Counted
    low: Floats
    high: Floats

    @cached_property
    def reach(self) -> Floats:
        """(K,) how far each control goes from its rest."""
        return np.maximum(self.high, -self.low)

    @cached_property
    def plain(self) -> Floats:
        """(T, K) the values that are nearest over the skin alone; over the points, where no control moves skin."""
        weights = self.counted.weights(0.0, 0.0) if self.does.square.any() else self.counted.weights(1.0, 1.0)
        return self._least(self._normal(weights), np.zeros(len(self.low)), 0.0)

    def values(self, weights: Floats, settled: Sequence[Settled], smooth: float = 0.0) -> Floats:
        """(T, K) values by weights (m,), with some fights settled."""
        normal = self._normal(weights)
        reach = self.reach * normal.scale
        found = self._least(normal, SPARING * reach, smooth)
        for _ in range(ROUNDS if settled else 0):
            found = self._least(normal, SPARING * reach + costs(settled, found * normal.scale, reach), smooth)
        return found

    def most(self, ladder: Sequence[float], bound: float, values: Callable[[float], Floats]) -> float:
        """The last step of a ladder whose values the skin allows, or the first."""
        chosen = ladder[0]
        for step in ladder[1:]:
            if self.loss(values(step)) > bound:
                break
            chosen = step
        return chosen

    def settled(self, weights: Floats, mirror: Mapping[int, int]) -> list[Settled]:
        """The fights that can be settled: neither skin nor FAPs nor gaze suffer more than they may."""
        normal, found = self._normal(weights), self.values(weights, [])
        slight = SLIGHT**2 * self._errors(np.zeros_like(found)) + NOTHING
        errors = np.maximum(np.maximum(NEARER**2 * self._errors(self.plain), slight), self._errors(found))
        untried = opposed_pairs(normal.matrix, self.low, self.high, mirror)
        settled: list[Settled] = []
        while fighting := [pairs for pairs in untried if both_on(pairs, found, self.reach) > ON]:
            worst = max(fighting, key=lambda pairs: both_on(pairs, found, self.reach) * against(pairs, normal.matrix))
            untried.remove(worst)
            settled, found = self._with(worst, settled, found, weights, errors)
        return settled

    def _with(
        self, pairs: Pairs, settled: list[Settled], found: Floats, weights: Floats, errors: Floats
    ) -> tuple[list[Settled], Floats]:
        """Fights and values with another fight settled, as hard as may be; as they were where it may not be."""
        kept, before = (settled, found), both_on(pairs, found, self.reach)
        for cost in COSTS:
            more = [*settled, Settled(pairs, cost)]
            tried = self.values(weights, more)
            if self.loss(tried) > YIELD or (self._errors(tried) > errors).any():
                break
            left = both_on(pairs, tried, self.reach)
            if left < before / 2.0:
                kept = more, tried
            if left <= ON:
                break
        return kept

    def loss(self, values: Floats) -> float:
        """How much less of the skin's motion values explain than the plain ones, a share of all of it."""
        size = float(self.asked.size.sum())
        return (self._left(values) - self._left(self.plain)) / size if size > 0.0 else 0.0

    def _left(self, values: Floats) -> float:
        """Squared distance from the motion's skin over all frames, without what no values change."""
        shown = float(np.einsum("tj,jk,tk->", values, self.does.square, values))
        return shown - 2.0 * float((values * self.asked.skin).sum())

    def _errors(self, values: Floats) -> Floats:
        """(3,) squared errors of all FAPs, of those requested, of the gaze."""
        squares = (values @ self.does.points - self.asked.points) ** 2
        kinds = (self.counted.faps, self.counted.requested, ~self.counted.faps)
        return np.array([squares[:, kind].sum() for kind in kinds])

    def _normal(self, weights: Floats) -> Normal:
        """Its normal equations."""
        return normal_equations(self.does, self.asked, weights)

    def _least(self, normal: Normal, cost: Floats, smooth: float) -> Floats:
        """(T, K) values by least squares, each at a cost (K,) or (T, K)."""
        low, high = self.low * normal.scale, self.high * normal.scale
        return bounded_over_time(normal.matrix, normal.right, low, high, cost, smooth) / normal.scale
