"""Meshes whose vertices are doubled along a seam, as games and scans have them: closed by polygons without area."""

from __future__ import annotations

from collections import defaultdict
from itertools import pairwise

import numpy as np
import pytest
import risorius.api as api
from risorius.api import Face, Part
from risorius.face.default_head import HeadMesh


def seam(head: HeadMesh, start: int, length: int) -> list[int]:
    """Vertices of a line of edges across the quads of the skin, from a vertex on."""
    around: dict[int, set[int]] = defaultdict(set)
    faces: dict[int, set[int]] = defaultdict(set)
    for number, polygon in enumerate(head.polygons):
        for a, b in zip(polygon, (*polygon[1:], polygon[0]), strict=True):
            around[a].add(b)
            around[b].add(a)
            faces[a].add(number)
    path = [start, min(around[start])]
    while len(path) < length:
        before, here = path[-2:]
        (onward,) = (v for v in around[here] - {before} if not faces[v] & faces[before])
        path.append(onward)
    return path


def cut(head: HeadMesh, path: list[int]) -> tuple[np.ndarray, list[list[int]], np.ndarray, dict[int, int]]:
    """The head with the inner vertices of a path doubled for the polygons on its left, the gap closed by polygons."""
    twin = {vertex: len(head.vertices) + k for k, vertex in enumerate(path[1:-1])}
    steps = set(pairwise(path))
    polygons = []
    for polygon in head.polygons:
        left = any(side in steps for side in zip(polygon, (*polygon[1:], polygon[0]), strict=True))
        polygons.append([twin.get(v, v) if left else v for v in polygon])
    for a, b in sorted(steps):
        polygons.append(list(dict.fromkeys((a, b, twin.get(b, b), twin.get(a, a)))))
    vertices = np.concatenate([head.vertices, head.vertices[list(twin)]])
    return vertices, polygons, np.append(head.parts, np.full(len(twin), int(Part.SKIN))), twin


@pytest.mark.parametrize("drive", ["natural", "exact"])
@pytest.mark.slow
def test_a_seam_that_polygons_without_area_close_stays_closed(head: HeadMesh, face: Face, drive: str) -> None:
    cheek = int(np.linalg.norm(head.vertices - face.points["5.3"].position, axis=1).argmin())
    vertices, polygons, parts, twin = cut(head, seam(head, cheek, 8))
    assert len(twin) == 6
    doubled = Face.from_arrays(vertices, polygons, dict(head.points), parts)
    joy = api.expression("joy").frame()
    whole, parted = (each.pose(joy, drive=drive).positions for each in (face, doubled))
    assert np.linalg.norm(whole - face.vertices, axis=1)[list(twin)].max() > 5e-3
    np.testing.assert_allclose(parted[: len(whole)], whole, atol=5e-6)
    np.testing.assert_allclose(parted[list(twin.values())], parted[list(twin)], atol=5e-6)
