"""Vertices at one place that are one: seams of importers, flat shading, unmerged halves and doubled faces.

A file format keeps one normal and one UV per vertex, so what an artist sees as one vertex comes back as several. They
are told by what they border: two open edges in one place are one edge, and a polygon that covers another is the same
polygon. Surfaces that merely touch, as closed lips do, share neither and stay apart.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy import sparse
from scipy.optimize import linear_sum_assignment
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from ...arrays import Bools, Floats, Ints
from ...physics.mesh import Polygons, corners, pair_keys
from ...polygons import PolygonTable
from ...progress import Progress, Work, run
from .points import PointSource

#: Two vertices are in one place when they lie nearer than this share of the mesh's median edge.
ONE_PLACE = 1e-3

#: An edge has no length when it is shorter than this share of the median edge: the tip of a lash still has one.
NO_LENGTH = 1e-4

#: Polygons that cover others are doubles where they make up at least this share of their mesh.
DOUBLED = 0.25


@dataclass(frozen=True, eq=False)
class Weld:
    """Which of a mesh's vertices are one.

    Attributes
    ----------
    leads : (V,) the vertex that stands for each one: the first of its copies, itself where there are none.
    polygons : those of the mesh between leading vertices; without doubles and what has no area.
    """

    leads: Ints
    polygons: PolygonTable

    @cached_property
    def copies(self) -> Ints:
        """(C,) vertices that another one stands for."""
        return np.flatnonzero(self.leads != np.arange(len(self.leads)))

    def of_leads(self, points: Mapping[str, PointSource]) -> dict[str, PointSource]:
        """Feature points with the leading vertex where one is given by its index."""
        return {name: self._lead(source) for name, source in points.items()}

    def _lead(self, source: PointSource) -> PointSource:
        """The leading vertex of an index within the mesh; positions, and what binding refuses, as they are."""
        if isinstance(source, int | np.integer) and 0 <= int(source) < len(self.leads):
            return int(self.leads[int(source)])
        return source


def weld(vertices: Floats, polygons: Polygons) -> Weld:
    """Weld a mesh's seams.

    Parameters
    ----------
    vertices : (V, 3) any unit.
    polygons : index sequences, three corners or more.
    """
    return run(weld_steps(vertices, polygons))


def weld_steps(vertices: Floats, polygons: Polygons) -> Work[Weld]:
    """As `weld`, bit by bit."""
    loops, sizes = corners(polygons, len(vertices))
    lengths = np.linalg.norm(vertices[loops] - vertices[_next(loops, sizes)], axis=1)
    usual = float(np.median(lengths[lengths > 0.0])) if lengths.any() else 0.0
    yield Progress(0.0, "Checking the mesh")
    place = _places(vertices, ONE_PLACE * usual)
    yield Progress(0.5, "Checking the mesh")
    doubles, covering = _covering(place, loops, sizes)
    if doubles.mean() < DOUBLED:
        doubles, covering = np.zeros_like(doubles), covering[:0]
    yield Progress(0.5, "Checking the mesh")
    closed = _closed(loops, sizes, lengths <= NO_LENGTH * usual)
    leads = _joined(np.arange(len(vertices)), np.concatenate([covering, closed]))
    kept = np.repeat(~doubles, sizes)
    yield Progress(0.5, "Checking the mesh")
    leads = _joined(leads, _seams(vertices, place, leads[loops[kept]], sizes[~doubles]))
    return Weld(leads, _without_slivers(leads[loops], sizes, doubles))


def _places(vertices: Floats, reach: float) -> Ints:
    """(V,) number of the place where each vertex lies: with all that are nearer than `reach`."""
    pairs = cKDTree(vertices).query_pairs(reach, output_type="ndarray")
    return _components(len(vertices), pairs)


def _components(count: int, pairs: Ints) -> Ints:
    """(count,) number of the connected component of each of some things of which pairs (P, 2) are joined."""
    graph = sparse.coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(count, count))
    return np.asarray(connected_components(graph, directed=False)[1], dtype=np.int64)


def _joined(leads: Ints, pairs: Ints) -> Ints:
    """(V,) the vertex that stands for each one, with pairs (P, 2) joined; the first copy stands for all."""
    own = np.stack([np.arange(len(leads)), leads], axis=1)
    component = _components(len(leads), np.concatenate([own, pairs]))
    _, first, of = np.unique(component, return_index=True, return_inverse=True)
    return np.asarray(first[np.ravel(of)], dtype=np.int64)


def _next(loops: Ints, sizes: Ints) -> Ints:
    """(C,) the vertex after each corner's in its polygon."""
    after = np.arange(1, len(loops) + 1)
    ends = np.cumsum(sizes)
    after[ends - 1] = ends - sizes
    return loops[after]


def _covering(place: Ints, loops: Ints, sizes: Ints) -> tuple[Bools, Ints]:
    """(F,) which polygons cover an earlier one, whichever way they wind; pairs (P, 2) of vertices that they share."""
    covered = np.zeros(len(sizes), dtype=bool)
    pairs = [np.zeros((0, 2), dtype=np.int64)]
    starts = np.cumsum(sizes) - sizes
    for size in np.unique(sizes):
        faces = np.flatnonzero(sizes == size)
        rows = loops[starts[faces][:, None] + np.arange(size)]
        rows = np.take_along_axis(rows, np.argsort(place[rows], axis=1, kind="stable"), axis=1)
        _, first, of = np.unique(place[rows], axis=0, return_index=True, return_inverse=True)
        original = first[np.ravel(of)]
        double = original != np.arange(len(faces))
        covered[faces[double]] = True
        pairs.append(np.stack([rows[original[double]].ravel(), rows[double].ravel()], axis=1))
    return covered, np.concatenate(pairs)


def _closed(loops: Ints, sizes: Ints, closed: Bools) -> Ints:
    """(P, 2) ends of edges without length, told by a mask (C,): polygons without area close the seam between them."""
    ends: Ints = np.stack([loops, _next(loops, sizes)], axis=1)[closed]
    return ends


def _seams(vertices: Floats, place: Ints, loops: Ints, sizes: Ints) -> Ints:
    """(P, 2) ends of open edges that lie in one place and are one edge."""
    edges = np.stack([loops, _next(loops, sizes)], axis=1)
    _, first, count = np.unique(pair_keys(np.sort(edges, axis=1)), return_index=True, return_counts=True)
    is_open = first[(count == 1) & (place[edges[first, 0]] != place[edges[first, 1]])]
    normals = _normals(vertices, loops, sizes, np.repeat(np.arange(len(sizes)), sizes)[is_open])
    edges = edges[is_open]
    forward = place[edges[:, 0]] < place[edges[:, 1]]
    edges[~forward] = edges[~forward, ::-1]
    where = place[edges]
    order = np.lexsort(where.T)
    starts = np.flatnonzero(np.concatenate([[True], (where[order][1:] != where[order][:-1]).any(axis=1)]))
    groups = np.split(order, starts[1:])
    pairs = [pair for group in groups if len(group) > 1 for pair in _matched(group, forward, normals)]
    both = np.array(pairs, dtype=np.int64).reshape(-1, 2)
    return np.concatenate([edges[both][:, :, end] for end in (0, 1)])


def _matched(group: Ints, forward: Bools, normals: Floats) -> list[tuple[int, int]]:
    """Which open edges of one place are one: two are; of two pairs, those whose polygons go on most smoothly.

    Closed lips may touch along an edge that is open in both, as every edge of a flat-shaded mesh is. Three surfaces
    that meet at an edge, as lashes meet a lid, are one.
    """
    one_way, other_way = group[forward[group]], group[~forward[group]]
    if len(group) > 2 and min(len(one_way), len(other_way)) == 0:
        return []  # a bunch of strips, such as lashes at their roots
    if len(group) == 2 or len(one_way) != len(other_way):
        return [(int(group[0]), int(other)) for other in group[1:]]
    rows, columns = linear_sum_assignment(-(normals[one_way] @ normals[other_way].T))
    return list(zip(one_way[rows].tolist(), other_way[columns].tolist(), strict=True))


def _normals(vertices: Floats, loops: Ints, sizes: Ints, wanted: Ints) -> Floats:
    """(k, 3) unit normals of some polygons, given by their numbers (k,)."""
    if len(wanted) == 0:
        return np.zeros((0, 3))
    those, of = np.unique(wanted, return_inverse=True)
    kept = np.zeros(len(sizes), dtype=bool)
    kept[those] = True
    loops, sizes = loops[np.repeat(kept, sizes)], sizes[those]
    starts = np.cumsum(sizes) - sizes
    places = vertices - vertices.mean(axis=0)
    vectors = np.add.reduceat(np.cross(places[loops], places[_next(loops, sizes)]), starts)
    normals: Floats = vectors / np.maximum(np.linalg.norm(vectors, axis=1, keepdims=True), 1e-30)
    return normals[np.ravel(of)]


def _without_slivers(loops: Ints, sizes: Ints, doubles: Bools) -> PolygonTable:
    """Polygons without corners that repeat the one before, doubles and what has no three corners left out."""
    repeats = loops == _next(loops, sizes)
    ends = np.cumsum(sizes)
    left = sizes - np.add.reduceat(repeats, ends - sizes) if len(sizes) else sizes
    kept = np.repeat(~doubles & (left >= 3), sizes) & ~repeats
    return PolygonTable(loops[kept], left[~doubles & (left >= 3)])
