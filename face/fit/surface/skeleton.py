"""A surface as a coarse net, and how far its places lie from each other along it: limbs keep that when they move."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import sparse
from scipy.sparse.csgraph import connected_components, dijkstra
from scipy.spatial import cKDTree

from ....arrays import Floats, Ints
from ....progress import Progress, Work
from .cloud import Surface, nearest

#: Cells of the net over the root of the surface's area.
CELL = 0.02
#: Pieces of less than this share of the area hang on what is nearest to them; so many of the others are tied together.
SMALL, TIED = 0.005, 40


@dataclass(frozen=True, eq=False)
class Net:
    """A surface as a coarse net: vertices that are near to each other along it are one node.

    Attributes
    ----------
    places : (N, 3) middles of the nodes.
    area : (N,) of the surface round each.
    graph : (N, N) distances between neighbours.
    node : (V,) the node that each vertex of the surface belongs to; -1 where it belongs to no triangle.
    """

    places: Floats
    area: Floats
    graph: sparse.csr_array
    node: Ints

    def along(self, nodes: Ints, *, within: float = np.inf) -> Floats:
        """(len(nodes), N) distances along the surface from some nodes; infinite beyond a limit."""
        return np.asarray(dijkstra(self.graph, directed=False, indices=nodes, limit=within), dtype=np.float64)


def net_of(surface: Surface) -> Work[Net]:
    """The net of a surface; its pieces hang together where they are nearest to each other."""
    yield Progress(0.0, "Finding the ends of the mesh")
    used, corners = _numbered(surface)
    places, area = surface.vertices[used], surface.twice_areas / 2.0
    cell = np.floor(places / (CELL * np.sqrt(area.sum()))).astype(np.int64)
    yield Progress(0.3, "Finding the ends of the mesh")
    sides, node = _nodes(corners, cell)
    yield Progress(0.8, "Finding the ends of the mesh")
    count = int(node.max()) + 1
    share = np.bincount(node, minlength=count)
    middles = np.column_stack([np.bincount(node, places[:, k]) / share for k in range(3)])
    areas = np.asarray(np.bincount(node[corners].ravel(), np.repeat(area / 3.0, 3), minlength=count), dtype=np.float64)
    keys = np.unique(np.sort(node[sides], axis=1) @ np.array([count, 1]))
    ends = np.column_stack([keys // count, keys % count])
    ends = _tied(middles, areas, ends[ends[:, 0] != ends[:, 1]])
    lengths = np.linalg.norm(middles[ends[:, 0]] - middles[ends[:, 1]], axis=1)
    every = np.full(len(surface.vertices), -1, dtype=np.int64)
    every[used] = node
    return Net(middles, areas, _links(ends, np.maximum(lengths, np.finfo(float).tiny), count), every)


def _numbered(surface: Surface) -> tuple[Ints, Ints]:
    """(U,) vertices that triangles use; (T, 3) triangles with those numbered one after another."""
    in_use = np.zeros(len(surface.vertices), dtype=bool)
    in_use[surface.triangles] = True
    return np.flatnonzero(in_use), (np.cumsum(in_use) - 1)[surface.triangles]


def _nodes(corners: Ints, cell: Ints) -> tuple[Ints, Ints]:
    """(E, 2) sides of triangles (T, 3) between two cells; (U,) the node of each vertex: what hangs together in a cell.

    Triangles that lie in one cell join their corners as they are: of a dense mesh these are nearly all.
    """
    low = cell.min(axis=0)
    extent = cell.max(axis=0) - low + 1
    number = ((cell - low) @ np.array([extent[1] * extent[2], extent[2], 1]))[corners]
    whole = (number[:, 0] == number[:, 1]) & (number[:, 1] == number[:, 2])
    split = corners[~whole]
    sides = np.concatenate([split[:, [0, 1]], split[:, [1, 2]], split[:, [2, 0]]])
    within = np.concatenate([number[~whole, k] == number[~whole, (k + 1) % 3] for k in range(3)])
    members = np.concatenate([corners[whole].ravel(), sides[within].ravel()]).astype(np.int32)
    sizes = np.repeat([0, 3, 2], [len(cell), int(whole.sum()), int(within.sum())])
    starts = np.concatenate([[0], np.cumsum(sizes)]).astype(np.int32)
    joined = sparse.csr_array((np.ones(len(members)), members, starts), shape=(len(sizes), len(sizes)))
    return sides[~within], connected_components(joined, directed=False)[1][: len(cell)].astype(np.int64)


def _links(ends: Ints, lengths: Floats, count: int) -> sparse.csr_array:
    """(count, count) lengths of links (E, 2)."""
    return sparse.csr_array((lengths, (ends[:, 0], ends[:, 1])), shape=(count, count))


def _tied(places: Floats, areas: Floats, ends: Ints) -> Ints:
    """Links (E, 2) with further ones that tie the pieces of the net together, the large ones to each other first."""
    count, piece = connected_components(_links(ends, np.ones(len(ends)), len(places)), directed=False)
    if count == 1:
        return ends
    sizes = np.bincount(piece, areas)
    order = np.argsort(-sizes, kind="stable")
    large = order[: max(1, min(TIED, int((sizes >= SMALL * areas.sum()).sum())))]
    members = [np.flatnonzero(piece == number) for number in large]
    tied, ties = members[0], []
    for nodes in members[1:]:
        ties.append(_nearest_pair(places, tied, nodes)[None])
        tied = np.concatenate([tied, nodes])
    rest = np.flatnonzero(~np.isin(piece, large))
    if len(rest):
        _, near = nearest(cKDTree(places[tied]), places[rest])
        ties.append(np.column_stack([rest, tied[near]]))
    return np.concatenate([ends, *ties])


def _nearest_pair(places: Floats, some: Ints, others: Ints) -> Ints:
    """(2,) the node among some that is nearest to one among others, and that one."""
    distance, near = nearest(cKDTree(places[some]), places[others])
    best = int(distance.argmin())
    return np.array([some[near[best]], others[best]])
