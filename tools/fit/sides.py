"""Whether found points of lips and lids lie on their own lip or lid, once they are bound to the mesh."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import risorius.api as api
from risorius.arrays import Floats
from risorius.physics.mesh import adjacency
from scipy.sparse.csgraph import dijkstra

from .heads import TrueHead

#: Points of upper lips and lids, and their counterparts below.
PAIRS = (("2.2", "2.3"), ("2.6", "2.8"), ("2.7", "2.9"), ("3.1", "3.3"), ("3.2", "3.4"))


def wrong_sides(head: TrueHead, positions: Mapping[str, Floats]) -> list[str]:
    """Points that lie nearer, along the surface, to the true place of their counterpart than to their own.

    Parameters
    ----------
    positions : found points in the coordinates of the head.

    Raises
    ------
    ModelError : no face can be made of the head with these points.
    """
    face = api.Face.from_arrays(head.vertices, head.polygons, dict(positions))
    graph = adjacency(face.vertices, face.polygons, diagonals=False)
    wrong = []
    for pair in PAIRS:
        if not all(name in head.points and name in face.points for name in pair):
            continue
        true = [int(np.linalg.norm(face.vertices - head.points[name], axis=1).argmin()) for name in pair]
        if true[0] == true[1]:
            continue
        away = dijkstra(graph, directed=False, indices=true)
        for own, name in enumerate(pair):
            point = face.points[name]
            if not point.is_bound:
                continue
            there = int(point.vertices[np.argmax(point.weights)])
            if away[own, there] > away[1 - own, there]:
                wrong.append(name)
    return wrong
