"""What grows out of the skin: lashes, brows, a beard, and whatever else is neither skin nor eye, tooth or tongue.

A piece goes with the skin where it touches it: there each vertex follows the skin about its nearest place, as far as
that goes along the surface, so that a lash of the upper lid never hangs on the lower one. What stands off turns with
its roots as a whole, so that a lash keeps its length as the lid comes down.

Limitations: a piece is as stiff as that everywhere; long hair does not hang, and touches nothing.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np
from scipy import sparse
from scipy.sparse.csgraph import connected_components, dijkstra
from scipy.spatial import cKDTree

from ...arrays import Bools, Floats, Ints
from ...physics import mesh
from ...physics.elastic import Factor, diagonal_matrix
from ...physics.mesh import Sparse
from ...polygons import PolygonTable
from ...progress import Progress, Work, run
from ..figures import Length, read_figures
from .rotations import nearest_rotations

#: Roots follow this many carriers, chosen among so many in space; the farthest counts for nothing, or hardly anything.
NEIGHBOURS, SEARCHED, FAINT = 12, 24, 1e-9

#: Neighbours lie on a sheet; across it a slope cannot be told and is held at 0 by this much. On a line a turn cannot.
SHEET_TIE, LINE_TIE = 0.02, 1e-3

#: The surface about so many nearest carriers tells how far off it a vertex is.
CLOSE = 4

#: Paths along the carriers are searched from this many places at once, and from fewer where these times the carriers
#: would be more figures than the second.
AT_ONCE, FIGURES = 256, 1_000_000

#: What is said meanwhile.
FOLLOWING = "Preparing what follows the skin"


@dataclass(frozen=True)
class RootFigures:
    """Where a piece touches the skin (presets/anatomy/skin.toml)."""

    touch: Length
    nearest: float
    detour: float


ROOTS = read_figures("skin.roots", RootFigures)


class RootedParts:
    """Pieces that go with skin or teeth: roots with what they touch, the rest with its roots."""

    def __init__(self, positions: Floats, polygons: PolygonTable, rooted: Ints, carriers: Ints) -> None:
        """Bind vertices `rooted` to `carriers`, both indices into positions (V, 3); head space, metres."""
        run(self._bind(positions, polygons, rooted, carriers))

    @classmethod
    def steps(cls, positions: Floats, polygons: PolygonTable, rooted: Ints, carriers: Ints) -> Work[Self]:
        """As the class, bit by bit."""
        made = cls.__new__(cls)
        yield from made._bind(positions, polygons, rooted, carriers)
        return made

    def _bind(self, positions: Floats, polygons: PolygonTable, rooted: Ints, carriers: Ints) -> Work[None]:
        """Work out what follows what."""
        self._bound = len(rooted) > 0 and len(carriers) > 0
        if not self._bound:
            return
        edges = _edges(positions, polygons, rooted)
        touching = _touching(_distance(positions, polygons, rooted, carriers), edges)
        self._roots, self._rest = rooted[touching], rooted[~touching]
        self._at, self._off = positions[self._roots], positions[self._rest]
        yield Progress(0.0, FOLLOWING)
        around, length = yield from _around(positions, polygons, carriers, self._at)
        yield Progress(1.0, FOLLOWING)
        carried = carriers[around]
        away = positions[carried] - self._at[:, None]
        reach = np.where(np.isfinite(length), length, 0.0).max(axis=1, keepdims=True)
        near = np.maximum((1.0 - np.minimum(length / np.maximum(reach, mesh.SHORTEST), 1.0) ** 2) ** 2, FAINT)
        near[~np.isfinite(length)] = 0.0
        shares = _linear_shares(away, near, reach)
        self._above = -np.einsum("rk,rkc->rc", shares, away)
        away = away - _means(near, away)[:, None]
        lean = near[:, :, None] * away
        moment = np.ascontiguousarray(away.transpose(0, 2, 1)) @ lean
        tie = np.maximum(LINE_TIE * np.trace(moment, axis1=1, axis2=2), mesh.SHORTEST**2)
        self._moment = moment + tie[:, None, None] * np.eye(3)
        readers = [_reader(carried, part, len(positions)) for part in (shares, *np.moveaxis(lean, 2, 0))]
        read = sparse.vstack(readers).tocsc()
        self._read: Ints = np.flatnonzero(np.diff(read.indptr))
        self._reader: Sparse = mesh.with_short_indices(read[:, self._read].tocsr())
        yield Progress(1.0, FOLLOWING)
        if len(self._rest):
            own = edges[~touching]
            self._factor = Factor(diagonal_matrix(np.asarray(own.sum(axis=1)).ravel()) - own[:, ~touching])
            self._to_roots: Sparse = own[:, touching]

    def follow(self, displacements: Floats) -> None:
        """Fill in the rows of rooted vertices of displacement fields (..., V, 3), in place."""
        if not self._bound:
            return
        moved = displacements.reshape(-1, *displacements.shape[-2:])
        read = mesh.applied(self._reader, moved[:, self._read]).reshape(len(moved), 4, -1, 3)
        change = self._turns(np.stack([read[:, 1], read[:, 2], read[:, 3]], axis=3)) - np.eye(3)
        shift = read[:, 0] + (change @ self._above[:, :, None])[..., 0]
        moved[:, self._roots] = shift
        if len(self._rest) == 0:
            return
        about = shift - (change @ self._at[:, :, None])[..., 0]
        roots = np.concatenate([change.reshape(*about.shape[:2], 9), about], axis=2)
        for each, wanted in zip(moved, roots, strict=True):
            motion = self._factor.solve(self._to_roots @ wanted)
            turned = (motion[:, :9].reshape(-1, 3, 3) @ self._off[:, :, None])[:, :, 0]
            each[self._rest] = turned + motion[:, 9:]

    def _turns(self, sheared: Floats) -> Floats:
        """(T, r, 3, 3) rotations of the carriers about each root, by their motion against their mean (T, r, 3, 3)."""
        moving = np.nonzero((sheared != 0.0).any(axis=(2, 3)))
        turns = np.tile(np.eye(3), (*sheared.shape[:2], 1, 1))
        turns[moving] = nearest_rotations(self._moment[moving[1]] + sheared[moving])
        return turns


def _distance(positions: Floats, polygons: PolygonTable, rooted: Ints, carriers: Ints) -> Floats:
    """(l,) how far rooted vertices are from the surface of the carriers, metres."""
    distance, nearest = cKDTree(positions[carriers]).query(positions[rooted], k=min(CLOSE, len(carriers)))
    distance, nearest = (np.reshape(part, (len(rooted), -1)) for part in (distance, nearest))
    member, close = np.zeros((2, len(positions)), dtype=bool)
    member[carriers], close[carriers[nearest]] = True, True
    triangles = mesh.fans(polygons.kept(polygons.within(member)))[0]
    triangles = triangles[close[triangles].any(axis=1)]
    if len(triangles) == 0:
        return np.asarray(distance[:, 0])
    samples = cKDTree(mesh.surface_samples(positions[triangles], ROOTS.touch))
    return np.minimum(distance[:, 0], samples.query(positions[rooted])[0])


def _edges(positions: Floats, polygons: PolygonTable, index: Ints) -> Sparse:
    """(n, n) 1 / length of the edges and diagonals of the polygons within some vertices (n,)."""
    member = np.zeros(len(positions), dtype=bool)
    member[index] = True
    local = np.full(len(positions), -1, dtype=np.int64)
    local[index] = np.arange(len(index))
    own = polygons.kept(polygons.within(member)).numbered(local)
    if not len(own):
        return sparse.csr_array((len(index), len(index)), dtype=np.float64)
    graph = mesh.adjacency(positions[index], own)
    return sparse.csr_array((1.0 / graph.data, graph.indices, graph.indptr), shape=graph.shape)


def _touching(distance: Floats, edges: Sparse) -> Bools:
    """(l,) which vertices, at some distance from the skin, their piece grows out of the skin at."""
    count, labels = connected_components(edges, directed=False)
    least = np.full(count, np.inf)
    np.minimum.at(least, labels, distance)
    return np.asarray(distance <= np.maximum(ROOTS.touch, ROOTS.nearest * least[labels]))


def _around(mesh_positions: Floats, polygons: PolygonTable, carriers: Ints, roots: Floats) -> Work[tuple[Ints, Floats]]:
    """(r, k) carriers about each root (r, 3), the nearest first, and their distances, infinite for what is another lip.

    Carriers are called by their number among them. Another lip is what cannot be reached from the nearest carrier by a
    way along the surface that is not much longer than through the air.
    """
    positions = mesh_positions[carriers]
    count = min(SEARCHED, len(positions))
    distance, found = (np.reshape(part, (len(roots), count)) for part in cKDTree(positions).query(roots, k=count))
    straight = np.linalg.norm(positions[found] - positions[found[:, :1]], axis=2)
    limit = ROOTS.detour * float(straight.max(initial=0.0)) + ROOTS.touch
    places, of = np.unique(found[:, 0], return_inverse=True)
    reached = np.flatnonzero(cKDTree(positions[places]).query(positions, distance_upper_bound=limit)[0] < np.inf)
    local = np.full(len(positions), -1, dtype=np.int64)
    local[reached] = np.arange(len(reached))
    yield Progress(0.0, FOLLOWING)
    lengths = _lengths(mesh_positions, polygons, carriers, reached)
    way = np.empty(found.shape)
    at_once = max(1, min(AT_ONCE, FIGURES // len(reached)))
    for first in range(0, len(places), at_once):
        yield Progress(first / len(places), FOLLOWING)
        searched = dijkstra(lengths, directed=False, indices=local[places[first : first + at_once]], limit=limit)
        mine = np.flatnonzero((of >= first) & (of < first + at_once))
        way[mine] = np.take_along_axis(searched[of[mine] - first], local[found[mine]], axis=1)
    distance = np.where(way <= ROOTS.detour * straight + ROOTS.touch, distance, np.inf)
    order = np.argsort(distance, axis=1, kind="stable")[:, : min(NEIGHBOURS, count)]
    return np.take_along_axis(found, order, axis=1), np.take_along_axis(distance, order, axis=1)


def _lengths(positions: Floats, polygons: PolygonTable, carriers: Ints, reached: Ints) -> Sparse:
    """(k, k) lengths of edges and diagonals between some of the carriers, given by their number among them."""
    among, member = np.zeros((2, len(positions)), dtype=bool)
    among[carriers[reached]], member[carriers] = True, True
    graph = mesh.adjacency(positions, polygons.kept(polygons.within(member) & polygons.touching(among)))
    return sparse.csr_array(graph[carriers[reached]][:, carriers[reached]])


def _means(near: Floats, values: Floats) -> Floats:
    """(r, 3) weighted means of what neighbours (r, k, 3) have, by how much each counts (r, k)."""
    return np.asarray(np.einsum("rk,rkc->rc", near, values) / near.sum(axis=1, keepdims=True))


def _reader(carriers: Ints, shares: Floats, count: int) -> Sparse:
    """(r, count) sums of what carriers (r, k) have, by their shares (r, k)."""
    row, column = np.nonzero(shares)
    return sparse.csr_array((shares[row, column], (row, carriers[row, column])), shape=(len(shares), count))


def _linear_shares(away: Floats, near: Floats, reach: Floats) -> Floats:
    """Weights (r, k) of neighbours that reproduce constant and, along the sheet they lie on, linear displacements.

    Moving least squares; neighbours given by offset (r, k, 3), how much each counts (r, k) and the farthest (r, 1).
    Averages alone would let a brow sink where the skin turns.
    """
    scaled = away / np.maximum(reach, mesh.SHORTEST)[:, :, None]
    basis = np.concatenate([np.ones((*near.shape, 1)), scaled], axis=2)
    moment = np.einsum("lk,lki,lkj->lij", near, basis, basis)
    moment[:, range(1, 4), range(1, 4)] += SHEET_TIE * near.sum(axis=1)[:, None]
    value = np.zeros((len(moment), 4, 1))
    value[:, 0] = 1.0
    shape = np.linalg.solve(moment, value)[:, :, 0]
    shares: Floats = near * np.einsum("lki,li->lk", basis, shape)
    return np.asarray(shares / shares.sum(axis=1, keepdims=True))
