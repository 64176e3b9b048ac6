"""A head with fewer vertices: the edge whose collapse bends the surface least goes first."""

from __future__ import annotations

import heapq
from dataclasses import replace

import numpy as np
from risorius.arrays import Floats, Ints

from .heads import TrueHead
from .meshes import triangles_of

#: What the length of an edge adds to the cost of its collapse: it decides where the surface is flat.
LENGTH_WEIGHT = 1e-3


def decimated(head: TrueHead, count: int) -> TrueHead:
    """A head of `count` vertices, or of a few more where no edge is left that may go.

    Quadric error metrics: Garland and Heckbert, SIGGRAPH 1997, with the middle of an edge as its place.
    """
    vertices, triangles = head.vertices.copy(), triangles_of(head)
    quadrics = _quadrics(vertices, triangles)
    faces: list[set[int]] = [set() for _ in vertices]
    for number, triangle in enumerate(triangles):
        for corner in triangle.tolist():
            faces[corner].add(number)

    def around(vertex: int) -> set[int]:
        return {corner for face in faces[vertex] for corner in triangles[face].tolist()} - {vertex}

    def cost(a: int, b: int) -> float:
        middle = np.append((vertices[a] + vertices[b]) / 2.0, 1.0)
        length = ((vertices[a] - vertices[b]) ** 2).sum()
        return float(middle @ (quadrics[a] + quadrics[b]) @ middle + LENGTH_WEIGHT * length**2)

    edges = np.unique(np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0)
    age = np.zeros(len(vertices), dtype=np.int64)
    heap = [(cost(a, b), 0, 0, a, b) for a, b in edges.tolist()]
    heapq.heapify(heap)
    left = len(np.unique(triangles))
    while left > count and heap:
        _, age_a, age_b, a, b = heapq.heappop(heap)
        shared = faces[a] & faces[b]
        if (age_a, age_b) != (age[a], age[b]) or not shared or len(around(a) & around(b)) != len(shared):
            continue
        vertices[a] = (vertices[a] + vertices[b]) / 2.0
        quadrics[a] += quadrics[b]
        for face in shared:
            for corner in triangles[face].tolist():
                faces[corner].discard(face)
        for face in faces[b]:
            triangles[face][triangles[face] == b] = a
        faces[a] |= faces[b]
        faces[b] = set()
        age[a] += 1
        age[b] += 1
        left -= 1
        for other in around(a):
            heapq.heappush(heap, (cost(a, other), int(age[a]), int(age[other]), a, other))
    kept = sorted(set().union(*faces))
    used, numbered = np.unique(triangles[kept], return_inverse=True)
    polygons = list(numbered.reshape(-1, 3))
    return replace(head, name=f"{head.name}, {len(used)} vertices", vertices=vertices[used], polygons=polygons)


def _quadrics(vertices: Floats, triangles: Ints) -> Floats:
    """(V, 4, 4) squared distances from the planes round each vertex, weighted by their areas."""
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    cross = np.cross(b - a, c - a)
    area = np.linalg.norm(cross, axis=1)
    normal = cross / np.maximum(area, 1e-18)[:, None]
    planes = np.column_stack([normal, -(normal * a).sum(axis=1)])
    quadrics = np.zeros((len(vertices), 4, 4))
    for k in range(3):
        np.add.at(quadrics, triangles[:, k], area[:, None, None] * planes[:, :, None] * planes[:, None, :])
    return quadrics
