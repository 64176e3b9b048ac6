"""The mixture of action units that explains a request: sparse, never negative, and wary of what nobody asked for.

An amount of every half unit, and of every half sum of units (an emotion, or a habit of any face). A Gaussian over the
same units could not say "either joy or sadness": silent FAPs leaked from one to the other.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ....arrays import Bools, Floats
from ....mpeg4 import ARCHETYPES
from ...figures import Length, Share, read_figures
from ..bounded_least_squares import bounded_least_squares
from .recognition import Shown
from .synergies import JAW, JAW_FAP, Synergies


@dataclass(frozen=True)
class MixtureFigures:
    """Which mixtures are preferred (presets/anatomy/natural.toml)."""

    unit_spread: float
    sum_spread: float
    sides: Share
    own_spread: float
    own_gain: float
    own_most: float
    silence: Length
    unasked_jaw: float
    cost_unit: float
    cost_midline: float
    cost_sum: float
    cost_other: float


MIXTURE = read_figures("natural.mixture", MixtureFigures)

#: No amount is larger: a bound for the solver, far beyond any face.
LARGEST_AMOUNT = 10.0


@dataclass(frozen=True, eq=False)
class Weighed:
    """Requests as they are explained, over the m FAPs that have a range.

    Attributes
    ----------
    wanted : (m,) metres, 0 where silent. asked : (m,) which are not silent.
    weight : (m,) 1/m, how much what is not explained counts.
    asymmetric : whether left and right differ on purpose.
    """

    wanted: Floats
    asked: Bools
    weight: Floats
    asymmetric: bool


class Mixture:
    """Finds mixtures over some tables of units and sums."""

    def __init__(self, data: Synergies) -> None:
        self.data = data
        self._names = (*data.unit_names, *data.sum_names)
        self._effects = np.column_stack([data.units, data.units @ data.sums])  # (m, k + s) metres
        self._paired = np.array([name.endswith(("_l", "_r")) for name in data.unit_names])
        pairs = [(i, self._names.index(n[:-2] + "_r")) for i, n in enumerate(self._names) if n.endswith("_l")]
        self._left, self._right = np.array(pairs).T

    def amounts(self, request: Weighed, shown: Shown) -> Floats:
        """(k,) amounts of the half units that explain a request best, its emotion's own sums preferred."""
        data, asked, effects = self.data, request.asked, self._effects
        own = self._own_strengths(request, shown)
        spread, mean, cost = self._priors(own, shown.certainty)
        if not asked[data.row_of[JAW_FAP]]:  # a jaw that nobody asks to open does not open to explain a lowered lip
            spread[data.unit_names.index(JAW)] = MIXTURE.unasked_jaw
        whiten = self._whitening(spread, request.asymmetric)
        silence = self._silence(asked, own, shown.certainty)
        matrix = np.concatenate([effects[asked] * request.weight[asked, None], whiten, silence])
        target = np.zeros(len(matrix))
        target[: asked.sum()] = request.wanted[asked] * request.weight[asked]
        target[asked.sum() : asked.sum() + len(whiten)] = whiten @ mean
        solution = _sparse_least_squares(matrix, target, cost)
        count = len(data.unit_names)
        return np.asarray(solution[:count] + data.sums @ solution[count:])

    def _own_strengths(self, request: Weighed, shown: Shown) -> dict[str, float]:
        """Emotion -> strength at which its sum explains the request best."""
        data, asked, weight = self.data, request.asked, request.weight
        strengths = {}
        for emotion, share in shown.shares.items():
            both = [data.sum_names.index(emotion + half) for half in ("_l", "_r")]
            prediction = data.units @ data.sums[:, both].sum(axis=1)
            p, t = prediction[asked] * weight[asked], request.wanted[asked] * weight[asked]
            fit = MIXTURE.own_gain * float(p @ t) / max(float(p @ p), 1e-9)
            strengths[emotion] = share * float(np.clip(fit, 0.0, MIXTURE.own_most))
        return strengths

    def _priors(self, own: Mapping[str, float], certainty: float) -> tuple[Floats, Floats, Floats]:
        """Spread, mean and cost (per amount) of every unit and sum, (k + s,) each."""
        data = self.data
        units = [data.unit_spread.get(name.partition("_")[0], MIXTURE.unit_spread) for name in data.unit_names]
        spread = np.array([*units, *[MIXTURE.sum_spread] * len(data.sum_names)])
        mean = np.zeros(len(spread))
        rival = MIXTURE.cost_sum + certainty * (MIXTURE.cost_other - MIXTURE.cost_sum)
        sums = [rival if name[:-2] in ARCHETYPES else MIXTURE.cost_sum for name in data.sum_names]
        cost = np.concatenate([np.where(self._paired, MIXTURE.cost_unit, MIXTURE.cost_midline), sums])
        for column, name in enumerate(data.sum_names, start=len(data.unit_names)):
            if name[:-2] in own:
                spread[column] = MIXTURE.sum_spread * (MIXTURE.own_spread / MIXTURE.sum_spread) ** certainty
                mean[column], cost[column] = certainty * own[name[:-2]], (1.0 - certainty) * MIXTURE.cost_sum
        return spread, mean, cost

    def _whitening(self, spread: Floats, asymmetric: bool) -> Floats:
        """Square root of the prior's inverse covariance: halves of a pair go together unless asked otherwise."""
        left, right, correlation = self._left, self._right, 0.0 if asymmetric else MIXTURE.sides
        root: Floats = np.diag(1.0 / spread)
        alone = np.sqrt(1.0 - correlation**2)
        root[left, left] /= alone
        root[left, right] = -correlation / (alone * spread[right])
        return root

    def _silence(self, asked: Bools, own: Mapping[str, float], certainty: float) -> Floats:
        """(s, k + s) a row for each sum: all that it would move where nothing is asked speaks against it."""
        sums = self._effects[~asked, len(self.data.unit_names) :]
        doubts = [1.0 - certainty if name[:-2] in own else 1.0 for name in self.data.sum_names]
        against = np.array(doubts) * np.sqrt((sums**2).sum(axis=0)) / MIXTURE.silence
        return np.hstack([np.zeros((len(against), len(self.data.unit_names))), np.diag(against)])


def _sparse_least_squares(matrix: Floats, target: Floats, cost: Floats) -> Floats:
    """The x (n,) from 0 on with the least |matrix @ x - target|^2 + cost @ x."""
    root: Floats = np.asarray(np.linalg.cholesky(matrix.T @ matrix).T, dtype=np.float64)
    linear = matrix.T @ target - cost / 2.0
    shifted: Floats = np.asarray(np.linalg.solve(root.T, linear), dtype=np.float64)
    least = np.zeros(len(cost))
    return bounded_least_squares(root, shifted, least, least + LARGEST_AMOUNT)
