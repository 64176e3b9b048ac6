"""Lip points stay on their own lip: closed lips touch, and what is nearest through the air may be the other one."""

from __future__ import annotations

import numpy as np
from scipy import sparse
from scipy.sparse.csgraph import dijkstra

from ...arrays import Bools, Floats, Ints

#: Ways along the skin between the lips stay within this many times the distance of their points.
ABOUT = 4.0

#: Points of the inner lips, upper and lower.
LIP_POINTS = (("2.2", "2.6", "2.7"), ("2.3", "2.8", "2.9"))


def own_lips(vertices: Floats, triangles: Ints, upper: int, lower: int, size: float) -> tuple[Bools, Bools]:
    """(V,) vertices that are nearer to the upper lip than to the lower, and the other way round, along the surface.

    Only those about the mouth are told.

    Parameters
    ----------
    vertices : (V, 3). triangles : (T, 3) of the skin.
    upper, lower : vertices in the middle of the outer lips, 8.1 and 8.2.
    size : how far points of the lips lie from these at most.
    """
    reach = ABOUT * size
    near = np.linalg.norm(vertices - vertices[[upper, lower]].mean(axis=0), axis=1) <= reach
    ends = triangles[near[triangles].all(axis=1)][:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    lengths = np.maximum(np.linalg.norm(vertices[ends[:, 0]] - vertices[ends[:, 1]], axis=1), 1e-12)
    rows, columns = ends.T
    graph = sparse.coo_array((lengths, (rows, columns)), shape=(len(vertices),) * 2).tocsr()
    counts = sparse.coo_array((np.ones(len(rows)), (rows, columns)), shape=graph.shape).tocsr()
    graph.data /= counts.data
    above, below = dijkstra(graph, directed=False, indices=[upper, lower])
    return above < below, below < above
