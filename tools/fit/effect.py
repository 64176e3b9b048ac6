"""What misplaced feature points cost: FAPs and scanned expressions on faces whose points are found, or jittered.

The scanned head is posed from the FAPs of its scanned expressions, which its exact points measure. Where other points
pose it, the FAPs come out differently, and so does the share of the scans' variance that is explained.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
import risorius.api as api
from faithful.heads import load_face
from faithful.requests import LEAST_REQUEST
from faithful.scans import Shape, head_displacement, scanned_shapes
from risorius.api import Drive, Face, Part
from risorius.arrays import Floats, Ints
from risorius.errors import ModelError
from risorius.face.mesh.points import closest_on_triangles, lies_on_skin
from risorius.physics.mesh import vertex_normals
from scipy import sparse
from scipy.sparse.csgraph import dijkstra

#: FAPs of a scan below so many units are no part of what it shows.
LEAST_SHOWN = 20.0
#: How far points are jittered, mm, and with which seeds.
JITTERS, SEEDS = (0.5, 1.0, 2.0, 4.0), (1, 2)
MM = 1e-3


def measure_effect() -> list[dict[str, Any]]:
    """A row for exact points, found ones and each jitter: errors of points, shares explained, errors of FAPs."""
    exact = load_face("ict")
    shapes = scanned_shapes(exact)
    rows = []
    for name, points in _cases(exact):
        row: dict[str, Any] = {"name": name, "points": _distances(exact, points)}
        try:
            face = Face.from_arrays(exact.vertices, exact.polygons, points, exact.parts)
            row |= _judged(exact, face, shapes)
        except ModelError as refused:
            row["refused"] = str(refused)
        rows.append(row)
        print("effect", name, {key: np.round(np.median(row[key]), 3) for key in ("points", "ev", "fap") if key in row})
    return rows


def _cases(exact: Face) -> Iterator[tuple[str, Mapping[str, Floats]]]:
    """Name and points of each case."""
    true = {name: np.asarray(point.position) for name, point in exact.points.items()}
    yield "exact", true
    yield "found", true | dict(api.find_points(exact.vertices, exact.polygons, topologies=()).positions)
    walk = Walk(exact)
    for size in JITTERS:
        for seed in SEEDS:
            random = np.random.default_rng(seed)
            skin = {name: place for name, place in true.items() if lies_on_skin(name)}
            yield f"{size} mm", true | {name: walk.from_(place, size * MM, random) for name, place in skin.items()}


def _distances(exact: Face, points: Mapping[str, Floats]) -> list[float]:
    """Distance of each skin point from the exact one, mm."""
    return [
        float(np.linalg.norm(points[name] - point.position)) / MM
        for name, point in exact.points.items()
        if lies_on_skin(name)
    ]


def _judged(exact: Face, face: Face, shapes: list[Shape]) -> dict[str, Any]:
    """Share of each shape that a face's pose explains, and errors of the FAPs that the exact points see on it."""
    explained, errors = [], []
    for shape in shapes:
        positions = face.pose(shape.frame, drive=Drive.EXACT).positions
        explained.append(shape.explained_by(head_displacement(exact, positions)[shape.skin]))
        wrong = np.abs(exact.measure(positions) - shape.frame) / np.maximum(np.abs(shape.frame), LEAST_REQUEST)
        errors += wrong[~np.isnan(wrong) & (np.abs(shape.frame) >= LEAST_SHOWN)].tolist()
    return {"ev": explained, "fap": errors}


class Walk:
    """Short ways along a face's skin, so that no point crosses from lip to lip through the air."""

    def __init__(self, face: Face) -> None:
        skin = np.asarray(face.parts) == Part.SKIN
        fans = [(p[0], p[k], p[k + 1]) for p in face.polygons for k in range(1, len(p) - 1) if skin[p[0]]]
        self._vertices, self._triangles = face.vertices, np.array(fans, dtype=np.int64)
        self._normals = vertex_normals(face.vertices, self._triangles)
        edges: Ints = np.unique(self._triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=0)
        lengths = np.linalg.norm(self._vertices[edges[:, 0]] - self._vertices[edges[:, 1]], axis=1)
        count = len(self._vertices)
        self._graph = sparse.csr_array((lengths, (edges[:, 0], edges[:, 1])), shape=(count, count))
        self._own = np.unique(self._triangles)

    def from_(self, place: Floats, size: float, random: np.random.Generator) -> Floats:
        """(3,) a place at about a normally distributed distance, `size` metres in the mean square."""
        start = self._own[np.linalg.norm(self._vertices[self._own] - place, axis=1).argmin()]
        normal = self._normals[start]
        step = random.normal(scale=size / np.sqrt(2.0), size=3)
        step -= normal * (normal @ step)
        reach = 2.0 * float(np.linalg.norm(step)) + 4.0 * MM
        near = np.isfinite(dijkstra(self._graph, directed=False, indices=start, limit=reach))
        corners = self._vertices[self._triangles[near[self._triangles].any(axis=1)]]
        weights, distance = closest_on_triangles(place + step, corners)
        best = int(distance.argmin())
        landed: Floats = weights[best] @ corners[best]
        return landed
