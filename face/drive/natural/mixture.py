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
from ..bounded_least_squares import bounded_least_squares
from .recognition import Shown
from .synergies import JAW, JAW_FAP, Synergies

SUM_SPREAD = 1.5
SIDE_CORRELATION = 0.95
OWN_SPREAD = 0.17
OWN_GAIN = 1.15
OWN_LIMIT = 1.3
SILENCE_MM = 3.0
UNASKED_JAW_SPREAD = 0.05

L1_UNIT, L1_UNIT_MIDLINE, L1_SUM, L1_OTHER_SUM = 1.0, 2.0, 2.0, 6.0

#: No amount is larger: a bound for the solver, far beyond any face.
LARGEST_AMOUNT = 10.0


@dataclass(frozen=True, eq=False)
class Weighed:
    """Requests as they are explained, over the m FAPs that have a range.

    Attributes
    ----------
    wanted : (m,) mm, 0 where silent. asked : (m,) which are not silent.
    weight : (m,) 1/mm, how much a millimetre that is not explained counts.
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
        self._effects = np.column_stack([data.units, data.units @ data.sums])  # (m, k + s) mm
        self._paired = np.array([name.endswith(("_l", "_r")) for name in data.unit_names])

    def amounts(self, request: Weighed, shown: Shown) -> Floats:
        """(k,) amounts of the half units that explain a request best, its emotion's own sums preferred."""
        data, asked, effects = self.data, request.asked, self._effects
        own = self._own_strengths(request, shown)
        spread, mean, sparsity = self._priors(own, shown.certainty)
        if not asked[data.row_of[JAW_FAP]]:  # a jaw that nobody asks to open does not open to explain a lowered lip
            spread[data.unit_names.index(JAW)] = UNASKED_JAW_SPREAD
        whiten = self._whitening(spread, request.asymmetric)
        rows = [effects[asked] * request.weight[asked, None], whiten, *self._silence(asked, own, shown.certainty)]
        matrix = np.concatenate(rows)
        target = np.zeros(len(matrix))
        target[: asked.sum()] = request.wanted[asked] * request.weight[asked]
        target[asked.sum() : asked.sum() + len(whiten)] = whiten @ mean
        solution = _sparse_least_squares(matrix, target, sparsity)
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
            fit = OWN_GAIN * float(p @ t) / max(float(p @ p), 1e-9)
            strengths[emotion] = share * float(np.clip(fit, 0.0, OWN_LIMIT))
        return strengths

    def _priors(self, own: Mapping[str, float], certainty: float) -> tuple[Floats, Floats, Floats]:
        """Spread, mean and weight of the sum (L1) of every unit's and sum's amount, (k + s,) each."""
        data = self.data
        spread = np.concatenate([data.unit_spread, np.full(len(data.sum_names), SUM_SPREAD)])
        mean = np.zeros(len(spread))
        rival = L1_SUM + certainty * (L1_OTHER_SUM - L1_SUM)
        other = [rival if name[:-2] in ARCHETYPES else L1_SUM for name in data.sum_names]
        sparsity = np.concatenate([np.where(self._paired, L1_UNIT, L1_UNIT_MIDLINE), other])
        for column, name in enumerate(data.sum_names, start=len(data.unit_names)):
            if name[:-2] in own:
                spread[column] = SUM_SPREAD * (OWN_SPREAD / SUM_SPREAD) ** certainty
                mean[column], sparsity[column] = certainty * own[name[:-2]], (1.0 - certainty) * L1_SUM
        return spread, mean, sparsity

    def _whitening(self, spread: Floats, asymmetric: bool) -> Floats:
        """Square root of the prior's inverse covariance: halves of a pair go together unless asked otherwise."""
        names, correlation = self._names, 0.0 if asymmetric else SIDE_CORRELATION
        covariance = np.diag(spread**2)
        for i, name in enumerate(names):
            if name.endswith("_l"):
                j = names.index(name[:-2] + "_r")
                covariance[i, j] = covariance[j, i] = correlation * spread[i] * spread[j]
        root: Floats = np.linalg.cholesky(np.linalg.inv(covariance)).T
        return root

    def _silence(self, asked: Bools, own: Mapping[str, float], certainty: float) -> list[Floats]:
        """Rows (., k + s) for each sum: what it would move although nothing is asked there speaks against it."""
        unit_count, effects = len(self.data.unit_names), self._effects
        blocks = []
        for column, name in enumerate(self.data.sum_names, start=unit_count):
            doubt = 1.0 - certainty if name[:-2] in own else 1.0
            block = np.zeros((int((~asked).sum()), effects.shape[1]))
            block[:, column] = doubt * effects[~asked, column] / SILENCE_MM
            blocks.append(block)
        return blocks


def _sparse_least_squares(matrix: Floats, target: Floats, sparsity: Floats) -> Floats:
    """The x (n,) from 0 on with the least |matrix @ x - target|^2 + sparsity @ x."""
    root: Floats = np.asarray(np.linalg.cholesky(matrix.T @ matrix).T, dtype=np.float64)
    linear = matrix.T @ target - sparsity / 2.0
    shifted: Floats = np.asarray(np.linalg.solve(root.T, linear), dtype=np.float64)
    least = np.zeros(len(sparsity))
    return bounded_least_squares(root, shifted, least, least + LARGEST_AMOUNT)
