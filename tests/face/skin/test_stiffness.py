"""Few springs are together as stiff as the many that they stand for, along every direction."""

from __future__ import annotations

import numpy as np
import pytest
from risorius.arrays import Floats, Ints
from risorius.face.skin.stiffness import springs_on, stiffness_round, turned
from risorius.physics.elastic import dirichlet_springs
from risorius.polygons import PolygonTable
from risorius.progress import run
from scipy.spatial import Delaunay

#: A sheet that resists three times as much one way as across it; nothing across the plane.
UNEVEN = np.array([[2.0, 0.9, 0.0], [0.9, 1.0, 0.0], [0.0, 0.0, 0.0]])


def scattered(count: int) -> tuple[Floats, Ints]:
    """Places over a unit square and triangles between them."""
    side = np.linspace(0.0, 1.0, 12)
    edge = np.concatenate([np.stack([side, x * np.ones(12)], axis=1) for x in (0.0, 1.0)])
    flat = np.concatenate([edge, edge[1:-1, ::-1], np.random.default_rng(1).uniform(0.02, 0.98, (count, 2))])
    flat = np.unique(flat, axis=0)
    places = np.column_stack([flat, np.zeros(len(flat))])
    triangles = Delaunay(flat).simplices.astype(np.int64)
    a, b, c = (places[corner] for corner in triangles.T)
    winds = np.cross(b - a, c - a)[:, 2] < 0.0
    triangles[winds] = triangles[winds][:, ::-1]
    return places, triangles


def energy(pairs: Ints, weights: Floats, field: Floats) -> float:
    """Twice the energy of springs under a displacement (n,)."""
    return float((weights * (field[pairs[:, 0]] - field[pairs[:, 1]]) ** 2).sum())


@pytest.mark.parametrize("stiffness", [np.diag([1.0, 1.0, 0.0]), UNEVEN], ids=["even", "uneven"])
@pytest.mark.parametrize("slope", [(1.0, 0.0), (0.0, 1.0), (1.0, 1.0), (1.0, -1.0)])
def test_a_sheet_resists_as_it_should_along_every_direction(stiffness: Floats, slope: tuple[float, float]) -> None:
    places, triangles = scattered(400)
    resists = np.broadcast_to(stiffness, (len(places), 3, 3))
    pairs, weights = springs_on(places, run(turned(places, triangles, resists)), resists)
    gradient = np.array([*slope, 0.0])
    assert energy(pairs, weights, places @ gradient) == pytest.approx(gradient @ stiffness @ gradient, rel=0.06)


def test_hardly_a_spring_would_push_once_sides_are_turned() -> None:
    places, triangles = scattered(400)
    resists = np.broadcast_to(UNEVEN, (len(places), 3, 3))
    idle = [
        float((springs_on(places, some, resists)[1] == 0.0).mean())
        for some in (triangles, run(turned(places, triangles, resists)))
    ]
    assert idle[0] > 0.05
    assert idle[1] < 0.02


def test_turning_sides_keeps_the_surface() -> None:
    places, triangles = scattered(400)
    resists = np.broadcast_to(UNEVEN, (len(places), 3, 3))
    after = run(turned(places, triangles, resists))
    a, b, c = (places[corner] for corner in after.T)
    areas = np.cross(b - a, c - a)[:, 2] / 2.0
    assert (areas > 0.0).all()
    assert areas.sum() == pytest.approx(1.0)
    assert (after != triangles).any()


def test_what_is_measured_is_what_the_springs_resist() -> None:
    places, triangles = scattered(300)
    table = PolygonTable.of(triangles)
    owners = (places[:, 0] * 3.999).astype(np.int64)
    areas = np.full(len(places), 1.0 / len(places))
    resists = run(stiffness_round(places, table, owners, areas))
    whole = (resists * np.bincount(owners, areas)[:, None, None]).sum(axis=0)
    gradient = np.array([0.3, -0.8, 0.0])
    wanted = energy(*dirichlet_springs(places, table), places @ gradient)
    assert gradient @ whole @ gradient == pytest.approx(wanted)
