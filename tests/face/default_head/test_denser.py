"""A skin made denser: all quads whatever the colouring, the surface the same, dense where faces fold."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest
from risorius.face.default_head.denser import Stripe, coloured, denser
from risorius.face.default_head.figures import read_figures
from risorius.face.default_head.folding import folding_skin
from risorius.face.default_head.limit import limit_matrix, quad_edges, subdivide
from risorius.face.default_head.skin import HeadSkin, build_skin

#: Positions are the same to this, metres.
SAME = 1e-9


@pytest.fixture(scope="module")
def coarse() -> HeadSkin:
    return build_skin(read_figures())


@pytest.fixture(scope="module")
def dense() -> HeadSkin:
    return folding_skin(read_figures())


def euler(skin: HeadSkin) -> int:
    return len(skin.vertices) - len(quad_edges(skin.quads).ends) + len(skin.quads)


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_any_colouring_leaves_quads_only_and_no_seam(coarse: HeadSkin, seed: int) -> None:
    left = np.random.default_rng(seed).random(len(coarse.vertices)) < 0.3
    skin = denser(coarse, left | left[coarse.mirror])
    assert len(skin.vertices) > len(coarse.vertices)
    assert all(len(set(quad)) == 4 for quad in skin.quads.tolist())
    assert np.array_equal(np.unique(skin.quads), np.arange(len(skin.vertices)))
    directed = Counter((int(q[k]), int(q[(k + 1) % 4])) for q in skin.quads for k in range(4))
    assert max(directed.values()) == 1
    assert euler(skin) == euler(coarse)
    assert np.array_equal(skin.mirror[skin.mirror], np.arange(len(skin.vertices)))
    assert len(skin.regions) == len(skin.quads)


def test_no_colour_changes_nothing(coarse: HeadSkin) -> None:
    skin = denser(coarse, np.zeros(len(coarse.vertices), dtype=bool))
    assert np.array_equal(skin.quads, coarse.quads)
    assert np.array_equal(skin.vertices, coarse.vertices)


def test_vertices_stay_and_new_ones_lie_on_the_same_limit_surface(coarse: HeadSkin, dense: HeadSkin) -> None:
    assert np.abs(dense.vertices[: len(coarse.vertices)] - coarse.vertices).max() < SAME
    positions, quads = coarse.cage_positions, coarse.cage.quads
    for _ in range(2):
        step = subdivide(len(positions), quads)
        positions, quads = step.matrix @ positions, step.quads
    surface = limit_matrix(len(positions), quads) @ positions
    own = dense.cage_matrix @ dense.cage_positions
    added = own[len(coarse.vertices) :]
    nearest = np.array([np.linalg.norm(surface - place, axis=1).min() for place in added])
    assert nearest.max() < SAME


def test_a_stripe_halves_the_edges_across_it(coarse: HeadSkin) -> None:
    stripe = Stripe(frozenset({"r01c03", "r01c04"}), frozenset({"r02c03", "r02c04"}))
    skin = denser(coarse, coloured(coarse, [stripe]))
    places = [
        np.linalg.norm(skin.vertices - skin.vertices[skin.vertex(f"r01c0{k}", f"r02c0{k}")], axis=1) for k in (3, 4)
    ]
    for distance in places:
        assert (
            np.sort(distance)[1]
            < 0.8 * np.sort(np.linalg.norm(coarse.vertices - skin.vertices[distance.argmin()], axis=1))[1]
        )


def mean_area(vertices: np.ndarray, quads: np.ndarray, low: tuple[float, ...], high: tuple[float, ...]) -> float:
    """Of the quads whose middle is in a box, square metres."""
    middle = vertices[quads].mean(axis=1)
    corners = vertices[quads[((middle > np.array(low)) & (middle < np.array(high))).all(axis=1)]]
    across = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    return float(0.5 * np.linalg.norm(across, axis=1).mean())


@pytest.mark.parametrize(
    ("low", "high"),
    [
        ((-0.012, -0.13, 0.062), (0.012, -0.08, 0.09)),
        ((0.024, -0.13, -0.03), (0.045, -0.08, 0.0)),
        ((0.02, -0.13, 0.041), (0.042, -0.08, 0.05)),
    ],
    ids=["glabella", "beside the nose", "upper lid"],
)
def test_the_head_is_denser_where_faces_fold(
    coarse: HeadSkin, dense: HeadSkin, low: tuple[float, ...], high: tuple[float, ...]
) -> None:
    area = mean_area(dense.vertices, dense.quads, low, high)
    assert area < 0.6 * mean_area(coarse.vertices, coarse.quads, low, high)
