"""Topology helpers against counts and measures known in closed form."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from risorius.errors import ParameterError
from risorius.physics import mesh

SQUARE = np.array([[0.0, 0, 0], [2, 0, 0], [2, 1, 0], [0, 1, 0]])


def grid(columns: int, rows: int, *, width: float = 1.0, height: float = 1.0) -> tuple[Any, Any]:
    """A flat rectangle of quads."""
    x, y = np.meshgrid(np.linspace(0, width, columns + 1), np.linspace(0, height, rows + 1))
    vertices = np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], axis=1)
    corner = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
    return vertices, np.stack([corner, corner + 1, corner + columns + 2, corner + columns + 1], axis=1)


def ring(inner: int) -> tuple[Any, list[list[int]]]:
    """An annulus of quads with `inner` corners around."""
    angle = 2 * np.pi * np.arange(inner) / inner
    circle = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    after = (np.arange(inner) + 1) % inner
    faces = np.stack([np.arange(inner), np.arange(inner) + inner, after + inner, after], axis=1)
    return np.concatenate([circle, 2 * circle]), faces.tolist()


def test_areas_add_up_on_mixed_polygons() -> None:
    vertices = np.array([[0.0, 0, 0], [2, 0, 0], [2, 1, 0], [0, 1, 0], [3, 0, 0], [3, 1, 0], [2.5, 2, 0]])
    polygons = [[0, 1, 2, 3], [1, 4, 5, 6, 2]]
    assert mesh.polygon_areas(vertices, polygons) == pytest.approx([2.0, 1.0 + 0.5])
    assert mesh.vertex_areas(vertices, polygons).sum() == pytest.approx(3.5)


def test_areas_of_a_triangle_are_thirds() -> None:
    areas = mesh.vertex_areas(SQUARE, [[0, 1, 2]])
    assert areas == pytest.approx([1 / 3, 1 / 3, 1 / 3, 0])


def test_areas_do_not_depend_on_the_first_corner() -> None:
    kite = SQUARE + np.array([[0, 0, 0], [1.0, 0, 0.5], [0, 0, 0], [0, 0.3, 0]])
    first = mesh.vertex_areas(kite, [[0, 1, 2, 3]])
    assert mesh.vertex_areas(kite, [[2, 3, 0, 1]]) == pytest.approx(first, rel=1e-14)
    assert mesh.vertex_areas(kite, [[3, 2, 1, 0]]) == pytest.approx(first, rel=1e-14)


def test_fan_triangles_keep_winding_and_area() -> None:
    angle = 2 * np.pi * np.arange(7) / 7
    vertices = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    triangles = mesh.triangulate([[0, 1, 2, 3], list(range(7))])
    assert triangles.shape == (2 + 5, 3)
    assert triangles[:2].tolist() == [[0, 1, 2], [0, 2, 3]]
    a, b, c = vertices[triangles[2:]].transpose(1, 0, 2)
    signed = np.cross(b - a, c - a)[:, 2] / 2
    assert (signed > 0).all()
    assert signed.sum() == pytest.approx(7 / 2 * np.sin(2 * np.pi / 7))


def test_edges_and_diagonals_are_counted_once() -> None:
    _, quads = grid(4, 3)
    assert len(mesh.unique_edges(quads)) == 4 * 4 + 5 * 3
    edges = mesh.unique_edges(quads)
    np.testing.assert_array_equal(mesh.unique_edges(quads, below=9), edges[(edges < 9).all(axis=1)])
    assert len(mesh.face_diagonals(quads)) == 2 * 12
    assert len(mesh.face_diagonals([[0, 1, 2], [0, 2, 3]])) == 0
    assert len(mesh.face_diagonals([[0, 1, 2, 3, 4]])) == 5


def test_a_diagonal_that_is_an_edge_elsewhere_is_an_edge() -> None:
    assert mesh.face_diagonals([[0, 1, 2, 3], [0, 2, 4]]).tolist() == [[1, 3]]


def test_a_cap_with_many_corners_stays_sparse() -> None:
    pairs, _, counts = mesh.face_pairs([list(range(64))])
    assert len(pairs) == counts[0] < 4 * 64


def test_normals_of_a_sphere_are_radial() -> None:
    polar, turn = np.meshgrid(np.linspace(0.3, 2.8, 40), 2 * np.pi * np.arange(60) / 60, indexing="ij")
    vertices = np.stack([np.sin(polar) * np.cos(turn), np.sin(polar) * np.sin(turn), np.cos(polar)], axis=2)
    index = np.arange(2400).reshape(40, 60)
    after = np.roll(index, -1, axis=1)
    quads = np.stack([index[:-1], index[1:], after[1:], after[:-1]], axis=2).reshape(-1, 4)
    normals = mesh.vertex_normals(vertices.reshape(-1, 3), quads)
    inside = index[1:-1].ravel()
    assert (normals[inside] * vertices.reshape(-1, 3)[inside]).sum(axis=1).min() > 0.9995


def test_adjacency_is_symmetric_and_measures_lengths() -> None:
    graph = mesh.adjacency(SQUARE, [[0, 1, 2, 3]])
    assert graph.toarray() == pytest.approx(graph.T.toarray())
    assert graph[0, 2] == pytest.approx(np.sqrt(5))
    assert mesh.adjacency(SQUARE, [[0, 1, 2, 3]], diagonals=False)[0, 2] == 0


def test_vertices_in_one_spot_stay_joined() -> None:
    doubled = np.concatenate([SQUARE, SQUARE[:1]])
    graph = mesh.adjacency(doubled, [[0, 1, 2], [0, 4, 1]])
    assert 0.0 < graph[0, 4] < 1e-6


def test_within_keeps_whole_polygons_only() -> None:
    kept = mesh.within([[0, 1, 2], [1, 2, 3, 4]], np.array([True, True, True, False, True]))
    assert [list(polygon) for polygon in kept] == [[0, 1, 2]]


@pytest.mark.parametrize("polygons", [[[0, 1]], [[0, 1, 4]], [[0, -1, 2]]])
def test_wrong_polygons_are_named(polygons: list[list[int]]) -> None:
    with pytest.raises(ParameterError, match="polygons"):
        mesh.vertex_areas(SQUARE, polygons)
