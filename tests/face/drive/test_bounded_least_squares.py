"""Bounded least squares against scipy's, and where it gives up."""

from __future__ import annotations

import numpy as np
import pytest
from risorius.errors import SolverError
from risorius.face.drive.bounded_least_squares import bounded_least_squares
from scipy.optimize import lsq_linear


@pytest.mark.parametrize("seed", range(60))
def test_random_problems_agree_with_an_independent_solver(seed: int) -> None:
    rng = np.random.default_rng(seed)
    rows, columns = rng.integers(8, 60), rng.integers(2, 40)
    matrix = np.vstack([rng.normal(size=(rows, columns)), np.eye(columns) * rng.uniform(0.05, 1.0)])
    right = np.append(3.0 * rng.normal(size=rows), np.zeros(columns))
    lower = np.where(rng.random(columns) < 0.2, -rng.random(columns), 0.0)
    upper = lower + rng.uniform(0.05, 1.0, columns)
    found = bounded_least_squares(matrix, right, lower, upper)
    known = lsq_linear(matrix, right, (lower, upper), method="bvls", tol=1e-13, max_iter=1000).x
    np.testing.assert_allclose(found, known, atol=1e-8)
    elsewhere = rng.uniform(lower, upper)
    for near in (found, elsewhere, lower, upper):
        np.testing.assert_allclose(bounded_least_squares(matrix, right, lower, upper, near=near), found, atol=1e-12)


def test_it_begins_at_the_bounds_of_a_like_problem(monkeypatch: pytest.MonkeyPatch) -> None:
    rng, solves, solve = np.random.default_rng(3), [], np.linalg.solve
    matrix, right = rng.normal(size=(60, 30)), rng.normal(size=60)
    lower, upper = np.full(30, -0.05), np.full(30, 0.05)
    found = bounded_least_squares(matrix, right, lower, upper)
    monkeypatch.setattr(np.linalg, "solve", lambda *given: solves.append(1) or solve(*given))
    bounded_least_squares(matrix, right, lower, upper, near=found)
    assert len(solves) == 1


def test_loose_bounds_give_plain_least_squares() -> None:
    rng = np.random.default_rng(1)
    matrix, right = rng.normal(size=(30, 8)), rng.normal(size=30)
    found = bounded_least_squares(matrix, right, np.full(8, -1e6), np.full(8, 1e6))
    np.testing.assert_allclose(found, np.linalg.lstsq(matrix, right, rcond=None)[0], atol=1e-9)


def test_dependent_columns_are_refused() -> None:
    matrix = np.ones((3, 2))
    with pytest.raises(SolverError, match="no single solution"):
        bounded_least_squares(matrix, np.ones(3), np.zeros(2), np.ones(2))
