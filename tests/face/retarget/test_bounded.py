"""Least squares over time within bounds, beside SciPy's and by its own rules."""

from __future__ import annotations

import numpy as np
import pytest
from risorius.face.retarget.bounded import bounded_over_time
from scipy.optimize import lsq_linear


def problem(frames: int, controls: int) -> tuple[np.ndarray, np.ndarray]:
    """Effects (m, K) of length 1, dependent on each other in part, and motions (T, m)."""
    rng = np.random.default_rng(controls)
    effects = rng.standard_normal((60, controls)) + 0.7 * rng.standard_normal((60, 1))
    effects /= np.linalg.norm(effects, axis=0)
    return effects, rng.standard_normal((frames, 60)) * 0.3


def test_it_is_scipys_bounded_least_squares_frame_by_frame() -> None:
    effects, motions = problem(7, 12)
    low, high = np.full(12, -0.1), np.full(12, 0.4)
    found = bounded_over_time(effects.T @ effects, motions @ effects, low, high, np.zeros(12), 0.0)
    for values, motion in zip(found, motions, strict=True):
        best = lsq_linear(effects, motion, (low, high), tol=1e-12)
        assert np.linalg.norm(effects @ values - motion) <= np.sqrt(2.0 * best.cost) + 1e-6
        assert np.abs(values - best.x).max() < 1e-3
    assert (found >= low).all()
    assert (found <= high).all()


def test_smoothing_lessens_second_differences_and_leaves_what_is_even() -> None:
    effects, motions = problem(40, 6)
    matrix, bounds = effects.T @ effects, (np.full(6, -5.0), np.full(6, 5.0))
    rough, even = (bounded_over_time(matrix, motions @ effects, *bounds, np.zeros(6), s) for s in (0.0, 10.0))
    bends = [float((np.diff(values, 2, axis=0) ** 2).sum()) for values in (rough, even)]
    assert bends[1] < 0.1 * bends[0]
    line = np.linspace(0.0, 1.0, 40)[:, None] * np.linspace(0.2, 0.8, 6)
    kept = bounded_over_time(matrix, line @ matrix, *bounds, np.zeros(6), 10.0)
    assert np.abs(kept - line).max() < 1e-3


def test_what_costs_something_is_not_used_against_another() -> None:
    one = np.array([1.0, 0.0, 0.0])
    effects = np.column_stack([one, -one, [0.0, 1.0, 0.0]])
    wanted = np.array([[0.5, 0.0, 0.0]])
    found = bounded_over_time(effects.T @ effects, wanted @ effects, np.zeros(3), np.ones(3), np.full(3, 1e-3), 0.0)
    assert found[0] == pytest.approx([0.5, 0.0, 0.0], abs=2e-3)


def test_controls_that_do_the_same_share_a_motion_without_end() -> None:
    effects = np.tile([[1.0], [0.0]], (1, 3))
    found = bounded_over_time(
        effects.T @ effects, np.array([[0.9, 0.9, 0.9]]), np.zeros(3), np.ones(3), np.zeros(3), 0.0
    )
    assert found.sum() == pytest.approx(0.9, abs=1e-3)
