"""The outer skin thinned out where the mesh is dense, so that a scan's face is solved as fast as any other's.

Elastic skin bends over a centimetre: vertices much nearer to each other than that cost time and change little. A dense
skin is solved on a share of its own vertices: close together along lips and lids, ever farther apart away from them.
What these do, the other vertices do by their place among them along the skin.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import chain

import numpy as np
from scipy import sparse
from scipy.sparse.csgraph import dijkstra
from scipy.spatial import cKDTree

from ...arrays import Bools, Floats, Ints
from ...physics.elastic import diagonal_matrix
from ...physics.mesh import Sparse, adjacency, triangulate, vertex_areas
from ...polygons import PolygonTable
from ...progress import Progress, Work, stepwise, worked_out
from ..mesh.openings import Opening
from ..mesh.template import MM
from .outer import Denser, OuterSkin
from .stiffness import springs_on, stiffness_round, turned

#: A skin of more vertices than this is thinned out; with fewer it is fast enough whole, and truer at mouth and lids.
MOST = 20_000

#: No two vertices are kept nearer to each other than the first beside the margins of lips and lids, and so much more
#: by each metre from them, up to the last; metres.
NEAREST, WIDENING, FARTHEST = 0.8 * MM, 0.04, 2.2 * MM

#: Vertices as near to a margin as this share of that distance are left out: the margin's own stand for them.
BESIDE = 0.7

#: At the corners, where the lips' and the lids' ways part within a millimetre, they are nearer: so much at them, and so
#: much more by each metre from them; metres.
AT_CORNERS, ROUND_CORNERS = 0.3 * MM, 0.12

#: One that stands for less skin than this share of the square of that distance is not kept.
LEAST = 0.05

#: A vertex goes with kept ones nearer than so many times that distance.
REACH = 2.4

#: Weights are level nearer to a vertex than this share of its reach; slopes that its neighbours do not tell are held
#: at 0 by this much.
LEVEL, SHEET_TIE = 0.05, 1e-3

#: Weights whose sizes sum up to more than this tell nothing, and mere averages are taken; what no other vertex reaches
#: goes with the one that is nearest, which counts so much for every other.
FIRM, FAINT = 2.0, 1e-6

#: Vertices whose weights are worked out at once.
AT_ONCE = 4000

#: Vertices that are first compared with each other; each later batch is twice as large.
FIRST_BATCH = 1000

#: Vertices that are compared with a batch at once.
COMPARED = 50_000


@dataclass(frozen=True, eq=False)
class Places:
    """Where vertices are about the margins of all openings; (n,) along the skin, metres.

    Attributes
    ----------
    upper, lower : distances from upper and lower margins. corner : from where these meet.
    """

    upper: Floats
    lower: Floats
    corner: Floats

    @cached_property
    def off(self) -> Floats:
        """(n,) distance from the nearest margin."""
        return np.minimum(self.upper, self.lower)

    @cached_property
    def side(self) -> Floats:
        """(n,) +1 towards an upper margin, -1 towards a lower one; less the more a corner is what is nearest."""
        beside = np.clip(1.0 - self.off / np.maximum(self.corner, 1e-9), 0.0, 1.0)
        return beside * np.sign(self.lower - self.upper)


@dataclass(frozen=True, eq=False)
class Cells:
    """Kept vertices and what of the skin is nearest to each.

    Attributes
    ----------
    kept : (N,) vertices that are kept. owners : (n,) the nearest of them along the skin, by its number among them.
    triangles : (T, 3) between those whose surroundings meet; the last `web` of them are of webs.
    springs : pairs (S, 2) and weights (S,) of the springs between them, which stand for all of the skin's.
    """

    kept: Ints
    owners: Ints
    triangles: Ints
    web: int
    springs: tuple[Ints, Floats]


class Thinning:
    """One dense skin being thinned out; each part is worked out when first asked for."""

    def __init__(self, skin: OuterSkin) -> None:
        self.given = skin

    @cached_property
    def _triangles(self) -> Ints:
        return triangulate(self.given.polygons)

    @cached_property
    def _graph(self) -> Sparse:
        return adjacency(self.given.positions, self._triangles, diagonals=False)

    @cached_property
    def _openings(self) -> tuple[Opening, ...]:
        return self.given.mouth, *self.given.eyes.values()

    @stepwise
    def _places(self) -> Work[Places]:
        sources = (
            [opening.upper for opening in self._openings],
            [opening.lower for opening in self._openings],
            [arc[[0, -1]] for opening in self._openings for arc in (opening.upper, opening.lower)],
        )
        fields = []
        for number, arcs in enumerate(sources):
            yield Progress(number / len(sources), "Preparing the skin")
            indices = np.unique(np.concatenate(arcs))
            fields.append(dijkstra(self._graph, directed=False, indices=indices, min_only=True))
        return Places(*(np.minimum(field, 1.0) for field in fields))

    @cached_property
    def _apart(self) -> Floats:
        """(n,) how far from each other vertices are kept, metres."""
        places = self._places
        beside = np.minimum(NEAREST + WIDENING * places.off, FARTHEST)
        return np.minimum(beside, AT_CORNERS + ROUND_CORNERS * places.corner)

    @cached_property
    def _webs(self) -> PolygonTable:
        return self.given.polygons[len(self.given.polygons) - self.given.web :]

    @stepwise
    def chosen(self) -> Work[Ints]:
        """(M,) vertices that are far enough from each other."""
        positions = self.given.positions
        arcs = [
            _thinned(positions, arc, self._apart)
            for opening in self._openings
            for arc in (opening.upper, opening.lower)
        ]
        stay = np.unique(np.concatenate([*arcs, self._webs.loops]))
        return (yield from _chosen(positions, self._apart, stay, self._places.off > BESIDE * self._apart))

    @stepwise
    def cells(self) -> Work[Cells]:
        """What is nearest to which of them; those that stand for hardly any skin are left out, too."""
        names = ("_triangles", "_graph", "_places", "chosen")
        for done, name in enumerate(names):
            yield Progress(done / len(names), "Preparing the skin")
            yield from worked_out(self, name)
        first_web = len(self._triangles) - int((self._webs.sizes - 2).sum())
        kept = self.chosen
        while True:
            yield Progress(1.0, "Preparing the skin")
            found = dijkstra(self._graph, directed=False, indices=kept, min_only=True, return_predecessors=True)
            owners = np.searchsorted(kept, found[2])
            yield Progress(1.0, "Preparing the skin")
            triangles, web = _dual(owners[self._triangles], first_web)
            surface = vertex_areas(self.given.positions[kept], triangles) > LEAST * self._apart[kept] ** 2
            if surface.all():
                break
            kept = kept[surface]
        places = self.given.positions[kept]
        stiffness = yield from stiffness_round(self.given.positions, self.given.polygons, owners, self.given.areas)
        sheet, webs = np.split(triangles, [len(triangles) - web])
        triangles = np.concatenate([(yield from turned(places, sheet, stiffness)), webs])
        yield Progress(1.0, "Preparing the skin")
        return Cells(kept, owners, triangles, web, springs_on(places, triangles, stiffness))

    @property
    def kept(self) -> Ints:
        """(N,) vertices that are kept."""
        return self.cells.kept

    @cached_property
    def skin(self) -> OuterSkin:
        """The same skin with fewer vertices."""
        local = np.full(self.given.vertex_count, -1, dtype=np.int64)
        local[self.kept] = np.arange(len(self.kept))

        def inside(opening: Opening) -> Opening:
            return Opening(*(local[arc][local[arc] >= 0] for arc in (opening.upper, opening.lower)))

        return OuterSkin(
            index=self.given.index[self.kept],
            positions=self.given.positions[self.kept],
            polygons=PolygonTable.of(self.cells.triangles),
            points=self.given.points,
            mouth=inside(self.given.mouth),
            eyes={side: inside(opening) for side, opening in self.given.eyes.items()},
            sewn=self.given.sewn,
            web=self.cells.web,
            mechanisms=self.given.mechanisms,
            stands_for=Denser(self.given, self.kept, self.cells.springs),
        )

    @stepwise
    def carry(self) -> Work[Sparse]:
        """(n, N) weights that give every vertex what the kept ones round it do; a kept vertex does its own."""
        count = len(self.kept)
        graph = adjacency(self.skin.positions, self.skin.polygons, diagonals=False)
        joined = sparse.csr_array((np.ones_like(graph.data), graph.indices, graph.indptr), shape=graph.shape)
        step = joined + diagonal_matrix(np.ones(count))
        around = sparse.csr_array(step @ step @ step)
        owners = self.cells.owners
        parts = np.array_split(np.argsort(owners, kind="stable"), len(owners) // AT_ONCE + 1)
        shares = list[tuple[Ints, Ints, Floats]]()
        for part in parts:
            yield Progress(len(shares) / len(parts), "Preparing the skin")
            shares.append(self._shares(around, part))
        rows, columns, weights = (np.concatenate(each) for each in zip(*shares, strict=True))
        return sparse.csr_array((weights, (rows, columns)), shape=(len(owners), count))

    def _shares(self, around: Sparse, part: Ints) -> tuple[Ints, Ints, Floats]:
        """Entries of `carry` for some vertices (p,): rows, columns, weights.

        Moving least squares over what is `around` each one's owner, with weights that grow without end towards a kept
        vertex: constant and linear displacements are carried as they are.
        """
        owners, positions = self.cells.owners[part], self.given.positions
        columns, has = _padded(around, owners)
        reach = REACH * self._apart[part][:, None]
        away = (positions[self.kept][columns] - positions[part][:, None]) / reach[:, :, None]
        distance = np.linalg.norm(away, axis=2) + self._round_corners(part, columns) / reach
        weight = np.where(has, np.maximum(1.0 - distance, 0.0) ** 2 / (distance**2 + LEVEL**2), 0.0)
        weight[(columns == owners[:, None]) & has] += FAINT
        basis = np.concatenate([np.ones((*distance.shape, 1)), away], axis=2)
        moment = (weight[:, :, None] * basis).transpose(0, 2, 1) @ basis
        moment[:, range(1, 4), range(1, 4)] += SHEET_TIE * weight.sum(axis=1)[:, None]
        value = np.zeros((len(part), 4, 1))
        value[:, 0] = 1.0
        shares = weight * (basis @ np.linalg.solve(moment, value))[:, :, 0]
        beyond = np.abs(shares).sum(axis=1) > FIRM
        shares[beyond] = weight[beyond] / weight[beyond].sum(axis=1, keepdims=True)
        own = self.kept[owners] == part
        shares[own] = (columns[own] == owners[own][:, None]) & has[own]
        used = has & (shares != 0.0)
        return np.repeat(part, used.sum(axis=1)), columns[used], shares[used]

    def _round_corners(self, part: Ints, columns: Ints) -> Floats:
        """(p, k) how much longer the way from vertices (p,) to kept ones is where it leads from lip to lip."""
        places, others = self._places, self.kept[columns]
        across = np.maximum(-places.side[part][:, None] * places.side[others], 0.0)
        return across * (places.corner[part][:, None] + places.corner[others])


def _thinned(positions: Floats, arc: Ints, apart: Floats) -> Ints:
    """Those of a margin's vertices (k,) that are kept: its ends, and between them as many as may be `apart` (n,)."""
    between = 0.5 * (apart[arc[1:]] + apart[arc[:-1]])
    steps = np.linalg.norm(np.diff(positions[arc], axis=0), axis=1) / between
    along = np.concatenate([[0.0], np.cumsum(steps)])
    count = max(int(along[-1]), 1) + 1
    places = np.searchsorted(along, np.linspace(0.0, along[-1], count) - 0.5 * steps.min(initial=0.0))
    return np.unique(arc[places])


def _chosen(positions: Floats, apart: Floats, stay: Ints, is_open: Bools) -> Work[Ints]:
    """(N,) vertices that are kept: `stay`, and of those open to it as many as may be, no two nearer than `apart` (n,).

    They come in an order that is even over the skin and always the same; each is kept that is not too near to one that
    was kept before it. Of a batch of them only those are compared that no earlier batch has left out.
    """
    kept = np.zeros(len(positions), dtype=bool)
    order = np.random.default_rng(0).permutation(len(positions))
    queue = np.argsort(order)
    queue = queue[is_open[queue]]
    count = FIRST_BATCH
    while len(queue):
        batch, queue = queue[:count], queue[count:]
        new = batch[_first_apart(positions[batch], apart[batch])]
        kept[new] = True
        near = np.zeros(len(queue), dtype=bool)
        for first in range(0, len(queue), COMPARED):
            yield Progress(0.0, "Preparing the skin")
            some = queue[first : first + COMPARED]
            near[first : first + COMPARED] = _too_near(positions[some], apart[some], positions[new], apart[new])
        queue = queue[~near]
        count *= 2
    kept[stay] = True
    return np.flatnonzero(kept)


def _first_apart(positions: Floats, apart: Floats) -> Bools:
    """(k,) which of some vertices are kept, the first first: those that are far enough from all kept before them."""
    kept, open_to = np.zeros((2, len(positions)), dtype=bool)
    open_to[:] = True
    pairs = cKDTree(positions).query_pairs(float(apart.max(initial=0.0)), output_type="ndarray")
    distance = np.linalg.norm(positions[pairs[:, 0]] - positions[pairs[:, 1]], axis=1)
    pairs = pairs[distance < apart[pairs].min(axis=1)]
    while open_to.any():
        beaten = np.zeros(len(positions), dtype=bool)
        beaten[pairs.max(axis=1)] = True
        new = open_to & ~beaten
        kept |= new
        open_to &= ~new
        open_to[pairs[new[pairs].any(axis=1)].ravel()] = False
        pairs = pairs[open_to[pairs].all(axis=1)]
    return kept


def _too_near(positions: Floats, apart: Floats, kept: Floats, kept_apart: Floats) -> Bools:
    """(k,) which vertices are nearer than they may be to one that is kept."""
    if len(positions) == 0 or len(kept) == 0:
        return np.zeros(len(positions), dtype=bool)
    found = cKDTree(kept).query_ball_point(positions, np.minimum(apart, kept_apart.max()), return_length=False)
    sizes = np.fromiter(map(len, found), dtype=np.int64, count=len(found))
    own = np.repeat(np.arange(len(positions)), sizes)
    other = np.fromiter(chain.from_iterable(found), dtype=np.int64, count=len(own))
    distance = np.linalg.norm(positions[own] - kept[other], axis=1)
    near = np.zeros(len(positions), dtype=bool)
    near[own[distance < np.minimum(apart[own], kept_apart[other])]] = True
    return near


def _dual(owners: Ints, first_web: int) -> tuple[Ints, int]:
    """(T, 3) triangles between vertices whose surroundings meet in a triangle, and how many are webs; these are last.

    Parameters
    ----------
    owners : (t, 3) whose surroundings the corners of each triangle belong to. first_web : the first that is of a web.
    """
    a, b, c = owners.T
    meets = np.flatnonzero((a != b) & (b != c) & (c != a))
    _, first = np.unique(np.sort(owners[meets], axis=1), axis=0, return_index=True)
    triangles = meets[np.sort(first)]
    return owners[triangles], int((triangles >= first_web).sum())


def _padded(rows: Sparse, numbers: Ints) -> tuple[Ints, Bools]:
    """(p, k) columns of some rows (p,) of a matrix, and which of them are there: short rows are filled up."""
    starts, sizes = rows.indptr[numbers], np.diff(rows.indptr)[numbers]
    place = np.arange(int(sizes.max(initial=1)))[None, :]
    has = place < sizes[:, None]
    return rows.indices[starts[:, None] + np.where(has, place, 0)].astype(np.int64), has
