"""Splits leave the surface alone: area, fields and paths along sides."""

from __future__ import annotations

import numpy as np
from risorius.physics import mesh
from risorius.physics.split import split

VERTICES = np.array([[0, 0, 0], [2, 0, 0], [2, 1, 0], [0, 1, 0], [3, 0.5, 0], [1, 2, 0], [2, 2, 0]], dtype=float)
POLYGONS = [np.array([0, 1, 2, 3]), np.array([1, 4, 2]), np.array([3, 2, 6, 5])]


def test_a_split_keeps_the_surface_and_what_is_linear_on_it() -> None:
    once = split(POLYGONS, len(VERTICES))
    finer = once.matrix @ VERTICES
    assert len(once.quads) == sum(len(polygon) for polygon in POLYGONS)
    np.testing.assert_array_equal(finer[: len(VERTICES)], VERTICES)
    np.testing.assert_allclose(
        mesh.polygon_areas(finer, once.quads).sum(), mesh.polygon_areas(VERTICES, POLYGONS).sum()
    )
    field = VERTICES @ [0.3, -2.0, 0.0] + 1.0
    np.testing.assert_allclose(once.matrix @ field, finer @ [0.3, -2.0, 0.0] + 1.0)
    assert (mesh.vertex_normals(finer, once.quads)[:, 2] > 0.99).all()  # winding kept


def test_a_path_goes_through_the_middles_of_its_sides() -> None:
    once = split(POLYGONS, len(VERTICES))
    path = np.array([0, 1, 4, 2])
    places = (once.matrix @ VERTICES)[once.halved(path)]
    assert len(places) == 7
    np.testing.assert_array_equal(places[::2], VERTICES[path])
    np.testing.assert_allclose(places[1::2], (VERTICES[path[:-1]] + VERTICES[path[1:]]) / 2.0)


def test_fans_count_every_polygon_once_and_prefer_no_corner() -> None:
    for roll in (0, 1, 3):
        triangles, shares = mesh.fans([np.roll(polygon, roll) for polygon in POLYGONS])
        corners = VERTICES[triangles]
        areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2.0
        np.testing.assert_allclose(shares @ areas, mesh.polygon_areas(VERTICES, POLYGONS).sum())
        assert len({tuple(sorted(t)) for t in triangles.tolist()}) == 9  # four per quad, one per triangle
