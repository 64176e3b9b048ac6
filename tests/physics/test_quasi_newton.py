"""The minimiser: its direction against dense BFGS, its descent, its stopping."""

from __future__ import annotations

from collections import deque
from typing import Any

import numpy as np
import pytest
from risorius.physics import quasi_newton
from risorius.physics.elastic import Factor
from scipy import sparse


def positive_definite(size: int, seed: int) -> Any:
    root = np.random.default_rng(seed).normal(size=(size, size))
    return root @ root.T + size * np.eye(size)


def test_direction_is_the_dense_bfgs_update() -> None:
    """H+ = (I - s y'/s'y) H (I - y s'/s'y) + s s'/s'y, from P^-1 scaled by the latest pair."""
    rng, size = np.random.default_rng(0), 4
    p, stiffness = positive_definite(size, 1), positive_definite(3 * size, 2)
    inverse = np.kron(np.linalg.inv(p), np.eye(3))
    pairs = deque()
    for _ in range(3):
        s = rng.normal(size=3 * size)
        y = stiffness @ s
        shaped = [v.reshape(size, 3) for v in (s, y, inverse @ y)]
        pairs.append(quasi_newton._Pair(*shaped, float(s @ y)))
    gradient = rng.normal(size=3 * size)
    y = pairs[-1].y.ravel()
    dense = inverse * pairs[-1].curvature / (y @ inverse @ y)
    for pair in pairs:
        s, y = pair.s.ravel(), pair.y.ravel()
        keep = np.eye(3 * size) - np.outer(s, y) / (s @ y)
        dense = keep @ dense @ keep.T + np.outer(s, s) / (s @ y)
    scaled = (inverse @ gradient).reshape(size, 3)
    found = quasi_newton._direction(gradient.reshape(size, 3), scaled, pairs)
    assert found.ravel() == pytest.approx(-dense @ gradient, rel=1e-10)


def steep(positions: Any) -> tuple[float, Any]:
    """A well much steeper than the matrix says, and steeper with distance."""
    squared = (positions**2).sum()
    return float(20 * squared + squared**2), 40 * positions + 4 * squared * positions


def test_energy_never_rises_where_the_matrix_is_far_too_soft() -> None:
    factor, start = Factor(sparse.csr_array(np.eye(2))), np.array([[1.0, 2.0, -1.0], [0.5, 0.0, 3.0]])
    energies = [steep(start)[0]]
    for count in range(1, 12):
        found = quasi_newton.minimise(steep, start, factor, tolerance=1e-12, max_iterations=count)
        energies.append(steep(found.positions)[0])
    assert (np.diff(energies) <= 0).all()
    done = quasi_newton.minimise(steep, start, factor, tolerance=1e-9, max_iterations=100)
    assert done.converged
    assert np.abs(done.positions).max() < 1e-9


def test_one_exact_step_solves_what_the_matrix_describes() -> None:
    matrix = positive_definite(5, 3)
    goal = np.random.default_rng(4).normal(size=(5, 3))

    def objective(x: Any) -> tuple[float, Any]:
        pull = matrix @ (x - goal)
        return 0.5 * float(((x - goal) * pull).sum()), pull

    found = quasi_newton.minimise(
        objective, np.zeros((5, 3)), Factor(sparse.csr_array(matrix)), tolerance=1e-9, max_iterations=3
    )
    assert found.converged
    assert found.iterations == 2
    assert found.positions == pytest.approx(goal, abs=1e-9)


def test_not_converged_is_said() -> None:
    factor, start = Factor(sparse.csr_array(np.eye(1))), np.array([[1.0, 2.0, -1.7]])
    found = quasi_newton.minimise(steep, start, factor, tolerance=1e-12, max_iterations=2)
    assert not found.converged
    assert found.residual > 1e-12
