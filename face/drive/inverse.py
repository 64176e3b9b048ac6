"""From wanted displacements of the feature points to amounts of muscles, lids and jaw.

A residual is judged by the elastic energy that it would take to pull the points the rest of the way, not by its
millimetres: what neighbouring points share is left to muscles, what one point alone wants is left to the skin.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from scipy import linalg

from ...arrays import Bools, Floats
from ...physics.mesh import Sparse
from ..mesh.fap_rows import FapRows
from ..response.actuators import Actuators, Amounts
from ..response.sheet import Tissue
from .bounded_least_squares import bounded_least_squares

#: How much of the points' motion the skin alone may explain, metres.
TAU = 6e-3
EXACT_NOISE = 0.05e-3

#: The jaw, not the skin, explains the chin.
CHIN_COMPLIANCE = 0.3
CHIN_FAPS = (3, 14, 15)

#: Beyond this opening at the chin the jaw's response is taken about the opening found first.
SECOND_PASS = 8e-3

ANGLE_PRIOR_ASKED, ANGLE_PRIOR_SILENT = 60e-3, 3e-3
SLIDE_PRIOR_SILENT = 2e-3


@dataclass(frozen=True)
class Wish:
    """What the rows should do.

    Attributes
    ----------
    targets, doubts : (m,) metres; NaN targets make no statement.
    muscles : prior amounts of muscles by name, metres.
    jaw_prior, slide_prior : usual size of the jaw's opening (at the chin) and slides, metres.
    carried : (m,) rows that only say where muscles move them relative to the jaw; None: no such rows.
    """

    targets: Floats
    doubts: Floats
    muscles: dict[str, float]
    jaw_prior: float
    slide_prior: float
    carried: Bools | None = None


class Kernel(NamedTuple):
    """How the skin answers loads on the rows.

    Attributes
    ----------
    matrix : (m, 3n) reads the rows off flattened displacements of the outer skin.
    responses : (m, n, 3) what the face shows under a unit load on each row, metres.
    """

    matrix: Sparse
    responses: Floats

    def first(self, count: int) -> Kernel:
        """The kernel of the first rows alone."""
        return Kernel(self.matrix[:count], self.responses[:count])


def kernel_of(rows: FapRows, reader: Sparse, tissue: Tissue) -> Kernel:
    """The kernel of rows whose points a (m, n) `reader` reads off the outer skin."""
    matrix = rows.matrix(reader)
    loads = np.asarray(matrix.todense()).reshape(len(rows), tissue.skin.vertex_count, 3)
    return Kernel(matrix, np.ascontiguousarray(tissue.point_responses(loads)))


class Inverse:
    """Prefactored inverse of one face."""

    def __init__(self, rows: FapRows, actuators: Actuators, kernel: Kernel) -> None:
        self.rows, self.actuators = rows, actuators
        self.matrix, self.kernel = kernel
        self.compliance: Floats = np.asarray(self.matrix @ self.kernel.reshape(len(rows), -1).T)
        self.compliance = (self.compliance + self.compliance.T) / 2.0
        self._scale = len(rows) / np.trace(self.compliance)

    @cached_property
    def _still(self) -> Floats:
        """(m, k) responses about the closed jaw."""
        return self.actuators.responses(self.matrix)

    @cached_property
    def _weighing(self) -> Floats:
        """(m, m) compliance with a stiff chin, scaled to a mean of 1."""
        share = np.where(np.isin(self.rows.numbers, CHIN_FAPS), CHIN_COMPLIANCE, 1.0)
        return np.asarray(self.compliance * self._scale * share[:, None] * share[None, :])

    def solve(self, wish: Wish) -> Amounts:
        """The amounts that explain a wish best."""
        actuators = self.actuators
        known = ~np.isnan(wish.targets)
        prior = actuators.prior
        prior[-3], prior[-2:] = wish.jaw_prior, wish.slide_prior
        mean: Floats = np.zeros(len(prior))
        for i, muscle in enumerate(actuators.muscles):
            mean[i] = wish.muscles.get(muscle.name, 0.0)
        upper = actuators.upper
        lower = np.zeros(len(upper))
        lower[-2:] = -upper[-2:]
        covariance = TAU**2 * self._weighing[np.ix_(known, known)] + np.diag(wish.doubts[known] ** 2)
        factor = linalg.cholesky(covariance, lower=True)
        responses = self._still.copy()
        if wish.carried is not None:
            responses[wish.carried, -3:] = 0.0
        solution: Floats = lower
        for _ in range(2):
            whitened = linalg.solve_triangular(
                factor, np.column_stack([responses[known], wish.targets[known]]), lower=True, check_finite=False
            )
            matrix = np.concatenate([whitened[:, :-1], np.diag(1.0 / prior)])
            right = np.concatenate([whitened[:, -1], mean / prior])
            solution = bounded_least_squares(matrix, right, lower, upper)
            if solution[-3] < SECOND_PASS:
                break
            responses[:, -3] = self._opening_response(float(solution[-3]))
            if wish.carried is not None:
                responses[wish.carried, -3] = 0.0
        return actuators.amounts(solution)

    def _opening_response(self, opening: float) -> Floats:
        """(m,) exact response of the rows to an opening of the jaw (metres at the chin), per metre."""
        amounts = np.zeros(len(self.actuators.prior))
        amounts[-3] = opening
        return np.asarray(self.matrix @ self.actuators.kinematic(self.actuators.amounts(amounts)).ravel()) / opening

    def correction(self, residual: Floats, doubts: Floats) -> Floats:
        """(n, 3) elastic displacement that takes the rows the rest of the way (m,), in metres; NaN rows are free.

        Rows with doubt 0 are met exactly; the others as far as their doubt (metres) is worth the skin's stretching.
        """
        known = ~np.isnan(residual)
        if not known.any():
            return np.zeros((self.actuators.skin.vertex_count, 3))
        compliance = self.compliance[np.ix_(known, known)] * self._scale
        loose = (doubts[known] / TAU) ** 2 + 1e-9
        weights = linalg.solve(compliance + np.diag(loose), residual[known], assume_a="pos") * self._scale
        return np.tensordot(weights, self.kernel[known], axes=1)
