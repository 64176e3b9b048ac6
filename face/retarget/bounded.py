"""Least squares over time within bounds: near to what is asked, smooth, and with no more of any control than it takes.

Alternating direction method of multipliers (Boyd et al. 2011): one half solves the least squares exactly, for all
frames at once along the axes in which its matrix is diagonal; the other keeps bounds and spares controls.
"""

from __future__ import annotations

import numpy as np
from scipy.linalg import cho_solve_banded, cholesky_banded

from ...arrays import Floats

ROUNDS = 600
#: Rounds end when nothing changes by more than this share of the largest value.
NEAR = 2e-5
#: How strongly the halves are held together at first, as a share of a control's own weight, and when that is changed.
HOLD, UNEVEN, STRONGER = 0.3, 5.0, 2.0
#: Rounds between two changes of that.
PATIENCE = 20


def bounded_over_time(
    matrix: Floats, right: Floats, low: Floats, high: Floats, sparing: Floats, smooth: float
) -> Floats:
    """The w (T, K) in its bounds with the least sum of ``w M w / 2 - r w + sparing |w| + smooth |w''|^2 / 2``.

    Parameters
    ----------
    matrix : (K, K) positive semidefinite, ones on its diagonal. right : (T, K).
    low, high : (K,) bounds on both sides of 0.
    sparing : (K,) or (T, K) what each control costs.
    smooth : weight of second differences over time; 0: each frame by itself.
    """
    values, axes = np.linalg.eigh(matrix)
    values = np.maximum(values, 0.0)
    hold = HOLD
    halves = _Halves(values, axes, len(right), smooth, hold)
    w = z = u = np.zeros_like(right)
    for number in range(ROUNDS):
        w = halves.solve(right + hold * (z - u))
        before = z
        loose = w + u
        z = np.clip(np.sign(loose) * np.maximum(np.abs(loose) - sparing / hold, 0.0), low, high)
        u = loose - z
        apart, moved = float(np.abs(w - z).max(initial=0.0)), float(np.abs(z - before).max(initial=0.0))
        if max(apart, moved) <= NEAR * max(float(np.abs(z).max(initial=0.0)), 1e-12):
            break
        if number % PATIENCE == PATIENCE - 1 and max(apart, moved) > UNEVEN * min(apart, moved):
            factor = STRONGER if apart > moved else 1.0 / STRONGER
            hold, u = hold * factor, u / factor
            halves = _Halves(values, axes, len(right), smooth, hold)
    return z


class _Halves:
    """Solves ``(M + hold + smooth D'D) w = b`` for all frames, D the second difference over time."""

    def __init__(self, values: Floats, axes: Floats, frames: int, smooth: float, hold: float) -> None:
        self.axes, self.factors = axes, values + hold
        self.banded: list[Floats] = []
        if smooth > 0.0 and frames > 2:
            bands = smooth * _second_differences(frames)
            for own in self.factors:
                whole = bands.copy()
                whole[-1] += own
                self.banded.append(np.asarray(cholesky_banded(whole, check_finite=False)))

    def solve(self, right: Floats) -> Floats:
        """(T, K) w for b (T, K)."""
        turned = right @ self.axes
        if not self.banded:
            return np.asarray(turned / self.factors @ self.axes.T)
        solved = np.empty_like(turned)
        for column, factor in enumerate(self.banded):
            solved[:, column] = cho_solve_banded((factor, False), turned[:, column], check_finite=False)
        return np.asarray(solved @ self.axes.T)


def _second_differences(frames: int) -> Floats:
    """(3, T) upper bands of D'D, as `cholesky_banded` takes them."""
    bands = np.zeros((3, frames))
    for first in range(3):
        for second in range(first, 3):
            product = (1.0, -2.0, 1.0)[first] * (1.0, -2.0, 1.0)[second]
            bands[2 - (second - first), second : frames - 2 + second] += product
    return bands
