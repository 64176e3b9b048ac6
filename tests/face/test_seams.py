"""A mesh as importers leave it, with vertices doubled at seams, is the same face and does not tear."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
import risorius.api as api
from risorius.api import Face
from risorius.face.default_head import HeadMesh
from risorius.physics.mesh import corners


def split(
    vertices: np.ndarray, polygons: list[np.ndarray], keep: np.ndarray
) -> tuple[np.ndarray, list[np.ndarray], np.ndarray]:
    """A mesh whose polygons of different `keep` (F,) share no vertices; and the vertex each new one was."""
    loops, sizes = corners(polygons)
    key = np.stack([loops, np.repeat(keep, sizes)], axis=1)
    _, first, of = np.unique(key, axis=0, return_index=True, return_inverse=True)
    return vertices[loops[first]], np.split(np.ravel(of), np.cumsum(sizes)[:-1]), loops[first]


def cuts(head: HeadMesh) -> dict[str, np.ndarray]:
    """Polygon -> group, for the seams that importers leave."""
    middles = np.array([head.vertices[np.asarray(polygon)].mean(axis=0) for polygon in head.polygons])
    return {
        "halves": (middles[:, 0] > 0).astype(int),
        "uv": np.floor(middles[:, 2] / 0.03).astype(int) * 100 + np.floor(middles[:, 0] / 0.04).astype(int),
        "flat": np.arange(len(middles)),
    }


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["halves", "uv", "flat"])
@pytest.mark.parametrize("given_parts", [True, False])
def test_a_split_head_poses_as_the_whole_one(head: HeadMesh, kind: str, given_parts: bool) -> None:
    polygons = [np.asarray(polygon) for polygon in head.polygons]
    vertices, faces, was = split(head.vertices, polygons, cuts(head)[kind])
    points = head_points(head)
    whole = Face.from_arrays(head.vertices, polygons, points, head.parts if given_parts else None)
    torn = Face.from_arrays(vertices, faces, points, head.parts[was] if given_parts else None)
    assert len(vertices) > len(head.vertices) + 50
    np.testing.assert_array_equal(torn.parts, whole.parts[was])
    np.testing.assert_array_equal(torn.outer_skin, np.flatnonzero(np.isin(was, whole.outer_skin)))
    frame = api.archetype("surprise", 1).frame()
    found, wanted = torn.pose(frame), whole.pose(frame)
    np.testing.assert_allclose(found.positions, wanted.positions[was], atol=1e-9)
    np.testing.assert_allclose(found.achieved, wanted.achieved, atol=1e-3)
    np.testing.assert_allclose(torn.measure(found.positions), wanted.achieved, atol=1e-3)


@pytest.mark.slow
def test_points_may_be_copies(head: HeadMesh) -> None:
    polygons = [np.asarray(polygon) for polygon in head.polygons]
    vertices, faces, was = split(head.vertices, polygons, cuts(head)["flat"])
    last = {int(vertex): index for index, vertex in enumerate(was)}
    points = {n: last[int(p)] if isinstance(p, int | np.integer) else p for n, p in head.points.items()}
    face = Face.from_arrays(vertices, faces, points, head.parts[was])
    for name, point in face.points.items():
        if isinstance(head.points[name], int | np.integer):
            np.testing.assert_allclose(point.position, head.vertices[head.points[name]])
    assert np.isfinite(face.pose(api.archetype("joy", 1).frame()).positions).all()


@pytest.mark.slow
def test_a_doubled_head_moves_as_one(head: HeadMesh) -> None:
    polygons = [np.asarray(polygon) for polygon in head.polygons]
    count = len(head.vertices)
    twice = Face.from_arrays(
        np.concatenate([head.vertices, head.vertices]),
        [*polygons, *(polygon[::-1] + count for polygon in polygons)],
        head.points,
        np.concatenate([head.parts, head.parts]),
    )
    moved = twice.pose(api.archetype("anger", 1).frame()).positions
    np.testing.assert_array_equal(moved[:count], moved[count:])
    assert len(twice.polygons) == 2 * len(polygons)


@pytest.mark.slow
def test_creases_lie_on_both_sides_of_a_seam(head: HeadMesh) -> None:
    polygons = [np.asarray(polygon) for polygon in head.polygons]
    vertices, faces, was = split(head.vertices, polygons, cuts(head)["uv"])
    whole, torn = (
        api.Creases(Face.from_arrays(v, f, head_points(head), p))
        for v, f, p in ((head.vertices, polygons, head.parts), (vertices, faces, head.parts[was]))
    )
    for name, crease in whole.creases.items():
        np.testing.assert_allclose(torn.creases[name].places, crease.places[was], atol=1e-9)


def head_points(head: HeadMesh) -> dict[str, np.ndarray]:
    """The head's points as positions."""
    return {n: head.vertices[p] if isinstance(p, int | np.integer) else np.asarray(p) for n, p in head.points.items()}


@pytest.mark.slow
def test_a_strangers_split_head_does_not_tear(shared_head: Callable) -> None:
    head = shared_head("ict")
    loops, sizes = corners(head.polygons)
    vertices, faces = head.vertices[loops], np.split(np.arange(len(loops)), np.cumsum(sizes)[:-1])
    points = {n: head.vertices[p] if isinstance(p, int) else p for n, p in head.points.items()}
    moved = Face.from_arrays(vertices, faces, points).pose(api.archetype("surprise", 1).frame()).positions - vertices
    low, high = np.full(head.vertices.shape, np.inf), np.full(head.vertices.shape, -np.inf)
    np.minimum.at(low, loops, moved)
    np.maximum.at(high, loops, moved)
    assert np.linalg.norm(high - low, axis=1).max() < 1e-9
