"""Feature points that survive any mesh density, and the openings that part lips and lids."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from risorius.api import Face, Part
from risorius.errors import ModelError
from risorius.face.default_head import HeadMesh
from risorius.face.mechanisms.separation import upper_lip_side
from risorius.face.mesh.openings import find_opening, outer_faces
from risorius.face.mesh.points import closest_on_triangles, lies_on_skin
from risorius.physics import mesh


def subdivided(vertices: np.ndarray, polygons: list[np.ndarray]) -> tuple[np.ndarray, list[list[int]]]:
    """Every quad in four and every triangle in three quads, by the middles of sides and faces; the surface stays."""
    edges = mesh.unique_edges(polygons)
    at = {(int(a), int(b)): len(vertices) + i for i, (a, b) in enumerate(edges)}
    middles = (vertices[edges[:, 0]] + vertices[edges[:, 1]]) / 2.0
    centres = np.array([vertices[p].mean(axis=0) for p in polygons])
    finer = []
    for number, polygon in enumerate(polygons):
        ring = polygon.tolist()
        side = [at[min(a, b), max(a, b)] for a, b in zip(ring, ring[1:] + ring[:1], strict=True)]
        centre = len(vertices) + len(edges) + number
        finer += [[corner, side[i], centre, side[i - 1]] for i, corner in enumerate(ring)]
    return np.concatenate([vertices, middles, centres]), finer


def test_points_given_as_positions_follow_the_surface_at_any_density(
    shared_head: Callable[[str], Any], shared_face: Callable[[str], Face]
) -> None:
    """The same surface with four times the polygons: points, units and what is measured stay."""
    coarse = shared_face("mediapipe")
    head = shared_head("mediapipe")
    vertices, polygons = subdivided(head.vertices, head.polygons)
    places = {name: point.position for name, point in coarse.points.items()}
    fine = Face.from_arrays(vertices, polygons, places)
    for name, place in places.items():
        bound = fine.points[name]
        if coarse.points[name].is_bound:
            np.testing.assert_allclose(bound.weights @ vertices[bound.vertices], place, atol=1e-5, err_msg=name)
    for unit, value in vars(coarse.units).items():
        assert getattr(fine.units, unit) == pytest.approx(value, rel=1e-9)
    smile = np.array([0.0, 0.0, 0.01]) * np.exp(-((vertices - places["8.3"]) ** 2).sum(axis=1) / 0.03**2)[:, None]
    finer, coarser = fine.measure(vertices + smile), coarse.measure(head.vertices + smile[: len(head.vertices)])
    np.testing.assert_allclose(finer, coarser, atol=8.0)
    assert np.nanmax(coarser) > 300.0


def test_the_closest_point_of_a_triangle_may_lie_inside_on_a_side_or_at_a_corner() -> None:
    """Against a dense set of places in each triangle."""
    rng = np.random.default_rng(2)
    a, b = (grid.ravel() for grid in np.meshgrid(np.linspace(0, 1, 81), np.linspace(0, 1, 81)))
    places = np.column_stack([1 - a - b, a, b])[a + b <= 1 + 1e-12]
    corners = rng.normal(size=(40, 3, 3))
    sampled = np.einsum("sk,nkd->nsd", places, corners)
    kinds = set()
    for position in 1.5 * rng.normal(size=(10, 3)):
        weights, distance = closest_on_triangles(position, corners)
        nearest = np.linalg.norm(sampled - position, axis=2).min(axis=1)
        assert (distance <= nearest + 1e-12).all()
        np.testing.assert_allclose(distance, nearest, atol=0.03)
        np.testing.assert_allclose(weights.sum(axis=1), 1.0)
        assert weights.min() >= 0.0
        closest = np.einsum("nk,nkd->nd", weights, corners)
        np.testing.assert_allclose(np.linalg.norm(closest - position, axis=1), distance, atol=1e-12)
        kinds |= set((weights > 1e-12).sum(axis=1).tolist())
    assert kinds == {1, 2, 3}


def test_a_point_inside_a_polygon_moves_with_its_corners(head: HeadMesh) -> None:
    corners = head.vertices[list(head.polygons[100])]
    inside = corners.mean(axis=0)
    face = Face.from_arrays(head.vertices, head.polygons, dict(head.points) | {"5.3": inside}, head.parts)
    bound = face.points["5.3"]
    assert bound.weights.sum() == pytest.approx(1.0)
    assert bound.weights.min() >= 0.0
    shift = np.array([0.01, 0.02, 0.03])
    at_rest, moved = head.vertices[bound.vertices], head.vertices[bound.vertices] + shift
    np.testing.assert_allclose(bound.weights @ moved, bound.weights @ at_rest + shift, atol=1e-12)
    assert np.linalg.norm(bound.weights @ at_rest - inside) < 0.5e-3  # a quad is not quite flat


def test_skin_points_are_bound_to_skin_however_near_a_brow_lies(face: Face) -> None:
    for name, point in face.points.items():
        if lies_on_skin(name):
            assert point.is_bound, name
            assert (face.parts[point.vertices] == Part.SKIN).all(), name
            assert np.linalg.norm(point.weights @ face.vertices[point.vertices] - point.position) < 2e-3, name


def test_a_point_far_from_the_mesh_follows_nothing(face: Face) -> None:
    assert not face.points["7.1"].is_bound  # the spine's pivot lies inside the neck


@pytest.mark.parametrize("name", ["ict", "makehuman"])
def test_the_outer_skin_ends_at_lips_and_lids(
    shared_head: Callable[[str], Any], shared_face: Callable[[str], Face], name: str
) -> None:
    """No vertex of mouth bag or eye sockets; of the skin only the lining of lips and lids, right behind their edges."""
    labels, face = shared_head(name).labels, shared_face(name)
    skin = face.anatomy.skin
    assert (labels[skin.index] == 0).all()
    left_out = np.setdiff1d(np.flatnonzero(labels == 0), skin.index)
    assert len(left_out) < 0.08 * (labels == 0).sum()
    margins = np.concatenate([skin.mouth.loop, *(skin.eyes[side].loop for side in "lr")])
    edges = skin.positions[margins]
    for place in face.anatomy.mesh.positions[left_out]:
        assert np.linalg.norm(edges - place, axis=1).min() < 12e-3


@pytest.mark.parametrize("name", ["default", "ict", "makehuman", "mediapipe"])
def test_lips_and_lids_are_parted(any_face: Callable[[str], Face], name: str) -> None:
    """Across the opening the way along the skin leads round a corner; mediapipe's mouth and eyes are filled in."""
    skin = any_face(name).anatomy.skin
    openings = {"mouth": skin.mouth, "left eye": skin.eyes["l"], "right eye": skin.eyes["r"]}
    for which, opening in openings.items():
        upper, lower = opening.upper[1:-1], opening.lower[1:-1]  # the corners belong to both
        assert len(upper) >= 3, which
        assert not np.intersect1d(upper, lower).size, which
        width = np.ptp(skin.positions[opening.loop, 0])
        middle = upper[np.argmin(np.abs(skin.positions[upper, 0] - skin.positions[opening.loop, 0].mean()))]
        along = skin.distance_from(np.array([middle]))[lower].min()
        through = np.linalg.norm(skin.positions[lower] - skin.positions[middle], axis=1).min()
        assert along > 1.4 * through, which
        assert along > 0.3 * width, which
    for arc, side in ((skin.mouth.upper, 1.0), (skin.mouth.lower, 0.0)):
        half = arc[len(arc) // 4 : -len(arc) // 4]
        np.testing.assert_allclose(upper_lip_side(skin)[half], side, atol=0.05)


def test_an_opening_runs_along_edges_through_its_points() -> None:
    """A flat 5 x 5 grid with a square hole's margin through its corners."""
    x, y = np.meshgrid(np.arange(5.0), np.arange(5.0))
    vertices = np.column_stack([x.ravel(), y.ravel(), np.zeros(25)])
    polygons = [np.array([i, i + 1, i + 6, i + 5]) for r in range(4) for i in range(5 * r, 5 * r + 4)]
    graph = mesh.adjacency(vertices, polygons, diagonals=False)
    nearest = {"a": 6, "b": 8, "c": 18, "d": 16}
    opening = find_opening(graph, nearest, ("a", "d", "missing", "c"), ("c", "b", "a"))
    assert opening.upper.tolist() == [6, 11, 16, 17, 18]
    assert opening.lower.tolist() == [18, 13, 8, 7, 6]
    outside = outer_faces(polygons, [opening], seed=0)
    assert [i for i, keep in enumerate(outside) if not keep] == [5, 6, 9, 10]


def test_points_on_separate_pieces_are_named_with_the_remedy() -> None:
    vertices = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [5, 0, 0], [6, 0, 0], [5, 1, 0]])
    graph = mesh.adjacency(vertices, [np.array([0, 1, 2]), np.array([3, 4, 5])], diagonals=False)
    with pytest.raises(ModelError, match=r"2\.4 and 2\.2 .*of 3 and 3 vertices.*Merge > By Distance"):
        find_opening(graph, {"2.4": 0, "2.2": 4}, ("2.4", "2.2"), ("2.2", "2.4"))
