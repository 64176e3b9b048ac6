"""Catmull-Clark subdivision, its limit, and the cage through given points."""

from __future__ import annotations

import numpy as np
import pytest
from risorius.errors import SolverError
from risorius.face.default_head.limit import cage_through, limit_matrix, quad_edges, subdivide

CUBE_VERTICES = np.array([[x, y, z] for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)])
CUBE_QUADS = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])


def grid(n: int) -> tuple[np.ndarray, np.ndarray]:
    """A flat n x n grid of quads with an open border."""
    k = np.arange((n + 1) ** 2).reshape(n + 1, n + 1)
    quads = np.stack([k[:-1, :-1], k[1:, :-1], k[1:, 1:], k[:-1, 1:]], axis=-1).reshape(-1, 4)
    u, v = np.meshgrid(np.arange(n + 1.0), np.arange(n + 1.0), indexing="ij")
    return np.stack([u, v, np.sin(u) * np.cos(0.7 * v)], axis=-1).reshape(-1, 3), quads


def open_box() -> tuple[np.ndarray, np.ndarray]:
    """A cube without its lid: valence-3 corners and a border."""
    return CUBE_VERTICES, CUBE_QUADS[:-1]


@pytest.mark.parametrize("mesh", [(CUBE_VERTICES, CUBE_QUADS), open_box(), grid(5)], ids=["cube", "open box", "grid"])
def test_repeated_subdivision_converges_to_the_limit_mask(mesh: tuple[np.ndarray, np.ndarray]) -> None:
    vertices, quads = mesh
    limit = limit_matrix(len(vertices), quads) @ vertices
    if len(quads_border_corners(quads)):  # the mask has no rule for a corner of the border itself
        limit[quads_border_corners(quads)] = np.nan
    kept = ~np.isnan(limit).any(axis=1)
    positions, errors = vertices, []
    for _ in range(4):
        errors.append(np.abs(positions[: len(vertices)] - limit)[kept].max())
        step = subdivide(len(positions), quads)
        positions, quads = step.matrix @ positions, step.quads
    # regular vertices contract by 1/4, valence 3 by (5 + sqrt 17) / 16 squared-ish: always faster than 1/2
    assert errors[3] < 0.55**3 * errors[0]
    finest = limit_matrix(len(positions), quads) @ positions
    assert np.allclose(finest[: len(vertices)][kept], limit[kept], atol=1e-12)


def quads_border_corners(quads: np.ndarray) -> np.ndarray:
    """Border vertices of valence 2."""
    valence = np.bincount(quad_edges(quads).ends.ravel())
    return np.flatnonzero(valence == 2)


def test_every_mask_is_an_affine_combination() -> None:
    vertices, quads = open_box()
    step = subdivide(len(vertices), quads)
    assert np.allclose(step.matrix.sum(axis=1), 1.0)
    assert np.allclose(limit_matrix(len(vertices), quads).sum(axis=1), 1.0)


def test_interior_of_a_regular_grid_is_the_uniform_cubic_spline() -> None:
    vertices, quads = grid(6)
    at = lambda i, j: i * 7 + j  # noqa: E731
    mask = np.outer([1, 4, 1], [1, 4, 1]) / 36.0
    expected = sum(mask[i, j] * vertices[at(2 + i, 2 + j)] for i in range(3) for j in range(3))
    assert np.allclose((limit_matrix(len(vertices), quads) @ vertices)[at(3, 3)], expected, atol=1e-14)


def test_the_cage_reaches_its_targets() -> None:
    cage = cage_through(CUBE_VERTICES, CUBE_QUADS, rounds=80, tolerance=1e-8)
    assert np.abs(cage).max() > 1.5  # it must lie well outside the points it is pulled through
    assert np.allclose(limit_matrix(8, CUBE_QUADS) @ cage, CUBE_VERTICES, atol=1e-8)


def test_a_cage_that_does_not_reach_says_how_far_it_is() -> None:
    with pytest.raises(SolverError, match="out of order") as caught:
        cage_through(CUBE_VERTICES, CUBE_QUADS, rounds=1, tolerance=1e-8)
    assert caught.value.residual is not None
    assert caught.value.residual > 1e-3
