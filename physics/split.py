"""Splitting a mesh without changing its surface: every polygon into quads by the middles of its sides and its own."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import sparse

from ..arrays import Ints
from .mesh import Polygons, Sparse, by_size, pair_keys, unique_edges


@dataclass(frozen=True, eq=False)
class Split:
    """One split of a mesh with V vertices, E sides and F polygons.

    Attributes
    ----------
    matrix : (V + E + F, V) takes positions, or any field over the vertices, to the finer mesh: old vertices first,
        then middles of sides, then of polygons.
    quads : (Q, 4) int64, winding kept.
    edges : (E, 2) int64, the ends of each side, smaller index first, sorted.
    """

    matrix: Sparse
    quads: Ints
    edges: Ints

    def halved(self, path: Ints) -> Ints:
        """A path (k,) along sides of the coarser mesh with the sides' middles between its vertices."""
        sides = np.sort(np.stack([path[:-1], path[1:]], axis=1), axis=1)
        known, wanted = pair_keys(self.edges), pair_keys(sides)
        place = np.minimum(np.searchsorted(known, wanted), len(known) - 1)
        middles = np.where(known[place] == wanted, place + self.matrix.shape[1], path[:-1])
        return np.asarray(np.append(np.stack([path[:-1], middles], axis=1).ravel(), path[-1:]), dtype=np.int64)


def split(polygons: Polygons, vertex_count: int) -> Split:
    """Split every polygon with n corners into n quads; `vertex_count` is V."""
    edges = unique_edges(polygons)
    keys = pair_keys(edges)
    quads = [np.empty((0, 4), dtype=np.int64)]
    rows, columns, shares = [], [], []
    for faces, index in by_size(polygons, vertex_count):
        size = index.shape[1]
        sides = pair_keys(np.sort(np.stack([index, np.roll(index, -1, axis=1)], axis=2).reshape(-1, 2), axis=1))
        middles = np.searchsorted(keys, sides).reshape(index.shape) + vertex_count
        centres = np.broadcast_to((faces + vertex_count + len(edges))[:, None], index.shape)
        quads.append(np.stack([index, middles, centres, np.roll(middles, 1, axis=1)], axis=2).reshape(-1, 4))
        rows.append(centres.ravel())
        columns.append(index.ravel())
        shares.append(np.full(index.size, 1.0 / size))
    rows += [np.arange(vertex_count), np.repeat(np.arange(len(edges)) + vertex_count, 2)]
    columns += [np.arange(vertex_count), edges.ravel()]
    shares += [np.ones(vertex_count), np.full(edges.size, 0.5)]
    entries = (np.concatenate(shares), (np.concatenate(rows), np.concatenate(columns)))
    shape = (vertex_count + len(edges) + len(polygons), vertex_count)
    return Split(sparse.csr_array(entries, shape=shape), np.concatenate(quads), edges)
