"""From targets of the feature points to amounts of muscles, lids and jaw, and what the elastic skin adds.

A residual is judged by the elastic energy that it would take to pull the points the rest of the way, not by its
millimetres: what neighbouring points share is left to muscles, what one point alone wants is left to the skin.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np
from scipy import linalg

from ...arrays import Floats
from ...physics.mesh import Sparse
from ...progress import Progress, Work
from ..figures import Length, Share, read_figures
from ..mechanisms.jaw import Jaw, JawMotion
from ..mesh.fap_rows import FapRows
from ..response.actuators import OPENING, SLIDES, Actuators, Amounts
from ..response.sheet import ElasticSheet, blocks
from .bounded_least_squares import bounded_least_squares
from .targets import Targets


@dataclass(frozen=True)
class SkinFigures:
    """What the elastic skin leaves to muscles and jaw (presets/anatomy/targets.toml)."""

    share: Length
    chin: Share
    tip: float


@dataclass(frozen=True)
class TogetherFigures:
    """How far muscles of one side contract together (presets/anatomy/targets.toml)."""

    wing_and_lip: Share
    wing_and_procerus: Share
    wing_and_brow: Share


SKIN = read_figures("targets.skin", SkinFigures)
TOGETHER = read_figures("targets.together", TogetherFigures)

#: Muscles that contract together, and the correlation of their amounts.
PAIRS = (
    ("llsan_wing", "llsan_lip", TOGETHER.wing_and_lip),
    ("llsan_wing", "procerus", TOGETHER.wing_and_procerus),
    ("llsan_wing", "depressor_supercilii", TOGETHER.wing_and_brow),
)

#: Rows to be met as near as may be are met within this by muscles, lids and jaw, metres; the skin does the rest.
LEAST_DOUBT = 0.05e-3

CHIN_FAPS, TIP_FAPS = (3, 14, 15), (63, 64)

#: Beyond this opening at the chin the jaw's response is taken about the opening found first.
SECOND_PASS = 8e-3


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


def kernel_steps(rows: FapRows, reader: Sparse, sheet: ElasticSheet) -> Work[Kernel]:
    """The kernel of rows whose points a (m, n) `reader` reads off the outer skin, some rows at a time."""
    matrix = rows.matrix(reader)
    loads = np.asarray(matrix.todense()).reshape(len(rows), sheet.skin.vertex_count, 3)
    responses = np.empty_like(loads)
    for some in blocks(len(rows)):
        yield Progress(some.start / len(rows), "Relating muscles to FAPs")
        responses[some] = sheet.point_responses(loads[some])
    return Kernel(matrix, responses)


class Inverse:
    """Prefactored inverse of one face."""

    def __init__(self, rows: FapRows, actuators: Actuators, kernel: Kernel) -> None:
        self.rows, self.actuators = rows, actuators
        self.matrix, self.skin_responses = kernel
        self.compliance: Floats = np.asarray(self.matrix @ self.skin_responses.reshape(len(rows), -1).T)
        self.compliance = (self.compliance + self.compliance.T) / 2.0
        self._scale = len(rows) / np.trace(self.compliance)

    @cached_property
    def _still(self) -> Floats:
        """(m, k) responses about the closed jaw."""
        return self.actuators.responses(self.matrix)

    def muscles_on_rows(self, amounts: Amounts) -> Floats:
        """(m,) metres by which the muscles of amounts move the rows, low strain."""
        return np.asarray(self._still[:, : len(amounts.muscles)] @ amounts.muscles)

    @cached_property
    def _weighing(self) -> Floats:
        """(m, m) compliance with a stiff chin and a loose tip of the nose, scaled to a mean of 1."""
        share = np.where(np.isin(self.rows.numbers, CHIN_FAPS), SKIN.chin, 1.0)
        share = np.where(np.isin(self.rows.numbers, TIP_FAPS), SKIN.tip, share)
        return np.asarray(self.compliance * self._scale * share[:, None] * share[None, :])

    def solve(self, targets: Targets) -> Amounts:
        """The amounts that explain targets best."""
        actuators, known = self.actuators, ~np.isnan(targets.displacements)
        wanted = targets.displacements[known]
        doubts = np.maximum(targets.doubts[known], LEAST_DOUBT)
        covariance = SKIN.share**2 * self._weighing[np.ix_(known, known)] + np.diag(doubts**2)
        factor = linalg.cholesky(covariance, lower=True)
        usual, expected = self._usual(targets)
        upper = actuators.upper
        lower = np.zeros(len(upper))
        lower[SLIDES] = -upper[SLIDES]
        responses = self._still.copy()
        responses[targets.carried, OPENING:] = 0.0
        solution: Floats | None = None
        for _ in range(2):
            whitened = linalg.solve_triangular(
                factor, np.column_stack([responses[known], wanted]), lower=True, check_finite=False
            )
            matrix = np.concatenate([whitened[:, :-1], self._together / usual])
            right = np.concatenate([whitened[:, -1], self._together @ (expected / usual)])
            solution = bounded_least_squares(matrix, right, lower, upper, near=solution)
            if solution[OPENING] < SECOND_PASS:
                break
            responses[:, OPENING] = self._opening_response(float(solution[OPENING]))
            responses[targets.carried, OPENING] = 0.0
        assert solution is not None
        return actuators.amounts(solution)

    @cached_property
    def _together(self) -> Floats:
        """(k, k) square root of the inverse correlations of all amounts."""
        names = [muscle.name for muscle in self.actuators.muscles]
        correlation = np.eye(self.actuators.count)
        for one, other, share in PAIRS:
            for side in ("_l", "_r"):
                if one + side in names and other + side in names:
                    i, j = names.index(one + side), names.index(other + side)
                    correlation[i, j] = correlation[j, i] = share
        return np.asarray(np.linalg.cholesky(np.linalg.inv(correlation)).T)

    def _usual(self, targets: Targets) -> tuple[Floats, Floats]:
        """Usual size of every amount about what is expected of it, and that, metres."""
        usual = self.actuators.usual(targets.opening, targets.slide)
        expected: Floats = np.zeros(len(usual))
        for i, muscle in enumerate(self.actuators.muscles):
            expected[i] = targets.muscles.get(muscle.name, 0.0)
        return usual, expected

    def _opening_response(self, opening: float) -> Floats:
        """(m,) exact response of the rows to an opening of the jaw (metres at the chin), per metre."""
        jaw, read, positions = self._jaw_where_read
        moved = jaw.skin(positions, JawMotion(opening / self.actuators.chin_lever))
        return np.asarray(read @ moved.ravel()) / opening

    @cached_property
    def _jaw_where_read(self) -> tuple[Jaw, Sparse, Floats]:
        """The jaw of the few vertices that rows are read off, `matrix` of these alone, and where they are (r, 3)."""
        index = np.unique(self.matrix.indices // 3)
        columns = (3 * index[:, None] + np.arange(3)).ravel()
        whole = self.actuators.jaw
        jaw = replace(whole, weights=whole.weights[index], bulge=whole.bulge[index])
        return jaw, self.matrix[:, columns].tocsr(), self.actuators.skin.positions[index]

    def correction(self, residual: Floats, doubts: Floats) -> Floats:
        """(T, n, 3) elastic displacements that take the rows the rest of the way (T, m), in metres; NaN rows are free.

        Rows with doubt (T, m) 0 are met exactly; others as far as their doubt (metres) is worth the skin's stretching.
        """
        weights: Floats = np.zeros(residual.shape)
        for weight, left, doubt in zip(weights, residual, doubts, strict=True):
            known = ~np.isnan(left)
            if known.any():
                compliance = self.compliance[np.ix_(known, known)] * self._scale
                loose = (doubt[known] / SKIN.share) ** 2 + 1e-9
                weight[known] = linalg.solve(compliance + np.diag(loose), left[known], assume_a="pos") * self._scale
        return np.tensordot(weights, self.skin_responses, axes=1)
