"""The outer skin of one face as the elastic sheet that muscles pull on: geometry only.

It is the part of the mesh that a viewer sees: lips, lids and face up to the margins of mouth and eyes. Mouth bag and
eye sockets are left out of it and follow (`followers.py`).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property, partial

import numpy as np
from scipy import sparse
from scipy.sparse.csgraph import dijkstra
from scipy.spatial import cKDTree

from ...arrays import Floats, Ints
from ...physics import mesh
from ...physics.elastic import Factor, diagonal_matrix, dirichlet_springs, pair_laplacian
from ...physics.mesh import Sparse
from ...polygons import PolygonTable
from ...progress import Progress, Work, stepwise, worked_out
from ..figures import Length, read_figures
from ..mechanism import EVERY, Mechanism
from ..mesh.openings import Opening


@dataclass(frozen=True)
class SheetFigures:
    """Of the skin as a sheet over a head (presets/anatomy/skin.toml)."""

    bone_over: Length
    behind_the_eyes: Length


SHEET = read_figures("skin.sheet", SheetFigures)


def smoothstep(t: Floats) -> Floats:
    """3t^2 - 2t^3 on [0, 1], clamped outside."""
    t = np.clip(t, 0.0, 1.0)
    eased: Floats = t * t * (3.0 - 2.0 * t)
    return eased


def nearer_side(by: Floats, width: float) -> Floats:
    """(n,) 1 where one of two places is nearer along the skin, `by` (n,) at least `width` metres, 0 where the other is.

    One step across takes a step off one way and adds it to the other: what is between is `width` wide.
    """
    return smoothstep((by / width + 1.0) / 2.0)


def gaussian(positions: Floats, centre: Floats, radii: Floats | float) -> Floats:
    """(n,) exp(-|d/r|^2) round a centre (3,) with radius or radii (3,) in metres."""
    away: Floats = (((positions - centre) / radii) ** 2).sum(axis=1)
    value: Floats = np.exp(-away)
    return value


@dataclass(frozen=True, eq=False)
class Denser:
    """What a skin of few vertices stands for.

    Attributes
    ----------
    skin : the denser one. kept : (n,) those of its vertices that are the few ones.
    springs : pairs (S, 2) and weights (S,) between the few that stand for the springs between all.
    """

    skin: OuterSkin
    kept: Ints
    springs: tuple[Ints, Floats]

    def distance_from(self, sources: Ints) -> Floats:
        """(n,) distance from the nearest of some of the few along the skin of all, which is less rough, metres."""
        return self.skin.distance_from(self.kept[sources])[self.kept]


@dataclass(frozen=True, eq=False)
class OuterSkin:
    """The visible skin in head space.

    Attributes
    ----------
    index : (g,) vertex numbers of the face's mesh. Of a skin that is split (`fine_skin`) these are the first g of its
        vertices, of any other all of them.
    positions : (n, 3) rest positions in head space, metres.
    polygons : in local vertex numbers; last the webs of openings that are sewn.
    points : feature point -> (3,) position in head space.
    mouth, eyes : the openings, in local vertex numbers; eyes by "l" and "r".
    sewn : which of the openings "mouth", "l" and "r" are sewn (`mesh.sewn`). web : how many polygons are webs.
    mechanisms : those that this skin has; what is built on it leaves the others out.
    stands_for : the denser skin that it is a part of; None: it stands for itself.
    """

    index: Ints
    positions: Floats
    polygons: PolygonTable
    points: Mapping[str, Floats]
    mouth: Opening
    eyes: Mapping[str, Opening]
    sewn: frozenset[str] = frozenset()
    web: int = 0
    mechanisms: frozenset[Mechanism] = EVERY
    stands_for: Denser | None = None
    _cache: dict[str, Floats] = field(default_factory=dict, repr=False)

    def has(self, mechanism: Mechanism) -> bool:
        """Whether a mechanism has not been left out."""
        return mechanism in self.mechanisms

    @property
    def vertex_count(self) -> int:
        """Number of skin vertices n."""
        return len(self.positions)

    @cached_property
    def tree(self) -> cKDTree:
        """Its vertices, to look for the nearest ones."""
        return cKDTree(self.positions)

    @cached_property
    def areas(self) -> Floats:
        """(n,) area of skin that each vertex stands for, m^2."""
        return mesh.vertex_areas(self.positions, self.polygons)

    @cached_property
    def springs(self) -> tuple[Ints, Floats]:
        """Pairs (S, 2) of vertices and weights (S,), as of `physics.elastic.dirichlet_springs`."""
        return dirichlet_springs(self.positions, self.polygons) if self.stands_for is None else self.stands_for.springs

    @stepwise
    def laplacian(self) -> Work[Sparse]:
        """(n, n) L with u'Lu the integral of |grad u|^2 over the skin."""
        yield from worked_out(self, "springs")
        yield Progress(0.5, "Preparing the skin")
        return pair_laplacian(*self.springs, self.vertex_count)

    @cached_property
    def fans(self) -> tuple[Ints, Floats]:
        """(t, 3) local vertex numbers of every split of every polygon, and (t,) how much each one counts."""
        return mesh.fans(self.polygons)

    @cached_property
    def graph(self) -> Sparse:
        """(n, n) lengths of edges and face diagonals: distances along it are distances along the skin.

        Of a web only the ways into it count, so that none leads across.
        """
        if self.web == 0:
            return mesh.adjacency(self.positions, self.polygons)
        cut = mesh.adjacency(self.positions, self.polygons[: -self.web])
        into = sparse.coo_array(mesh.adjacency(self.positions, self.polygons[-self.web :]))
        inner = np.diff(cut.indptr)[into.col] == 0
        entries = (into.data[inner], (into.row[inner], into.col[inner]))
        return sparse.csr_array(cut + sparse.csr_array(entries, shape=cut.shape))

    def distance_from(self, sources: Ints) -> Floats:
        """(n,) distance along the skin from the nearest of some vertices, metres; far pieces count as 1 m away.

        Without `Mechanism.SEPARATION` it goes through the air, where one lip is as near as the other.
        """
        if not self.has(Mechanism.SEPARATION):
            through_the_air, _ = cKDTree(self.positions[sources]).query(self.positions)
            return np.minimum(np.asarray(through_the_air, dtype=np.float64), 1.0)
        if self.stands_for is not None:
            return self.stands_for.distance_from(sources)
        distance = dijkstra(self.graph, directed=self.web > 0, indices=np.unique(sources), min_only=True)
        return np.minimum(distance, 1.0)

    def smoothing(self, radius: float) -> Factor:
        """Prefactored filter: solve(areas * f) is f averaged over a Gaussian-like window of a given radius (metres)."""
        matrix = diagonal_matrix(self.areas) + 0.5 * radius**2 * self.laplacian
        return Factor(matrix, least=float(self.areas.min(initial=np.inf)))

    @cached_property
    def raw_normals(self) -> Floats:
        """(n, 3) outward unit normals of the sheet, whichever way its polygons wind."""
        normals = mesh.vertex_normals(self.positions, self.polygons)
        inside = (self.points["3.5"] + self.points["3.6"]) / 2.0 - np.array([0.0, 0.0, SHEET.behind_the_eyes])
        outwards = self.areas @ (normals * (self.positions - inside)).sum(axis=1)
        return normals * (1.0 if outwards >= 0.0 else -1.0)

    @stepwise
    def normals(self) -> Work[Floats]:
        """(n, 3) unit normals averaged over some way: the lie of the bone rather than of the wrinkle."""
        right = self.areas[:, None] * self.raw_normals
        yield Progress(0.0, "Preparing the skin")
        yield from worked_out(self, "laplacian")
        yield Progress(0.5, "Preparing the skin")
        smooth = self.smoothing(SHEET.bone_over).solve(right)
        unit: Floats = smooth / np.maximum(np.linalg.norm(smooth, axis=1, keepdims=True), 1e-12)
        return unit

    def tangential(self, vectors: Floats) -> Floats:
        """The part of vectors (n, 3) along the skin."""
        return np.asarray(vectors - self.normals * (vectors * self.normals).sum(axis=1, keepdims=True))

    @stepwise
    def margins_reached(self) -> Work[bool]:
        """Whether distances from lips and lids are worked out: along a dense skin each takes its time."""
        yield from worked_out(self if self.stands_for is None else self.stands_for.skin, "graph")
        margins = [("mouth upper", self.mouth.upper), ("mouth lower", self.mouth.lower)]
        for side, eye in self.eyes.items():
            margins += [(f"{side}upper", eye.upper), (f"{side}lower", eye.lower)]
        for number, (name, margin) in enumerate(margins):
            yield Progress(number / len(margins), "Preparing the skin")
            self.once(name, partial(self.distance_from, margin))
        return True

    @cached_property
    def lip_distances(self) -> tuple[Floats, Floats]:
        """Distances (n,) along the skin from the upper and from the lower lip's edge, metres."""
        mouth = self.mouth
        upper = self.once("mouth upper", lambda: self.distance_from(mouth.upper))
        return upper, self.once("mouth lower", lambda: self.distance_from(mouth.lower))

    def lid_distances(self, side: str) -> tuple[Floats, Floats]:
        """Distances (n,) along the skin from the upper and from the lower lid's edge of eye "l" or "r", metres."""
        eye = self.eyes[side]
        upper = self.once(f"{side}upper", lambda: self.distance_from(eye.upper))
        return upper, self.once(f"{side}lower", lambda: self.distance_from(eye.lower))

    def once(self, name: str, work: Callable[[], Floats]) -> Floats:
        """What is worked out of this skin under a name, worked out the first time alone."""
        if name not in self._cache:
            self._cache[name] = work()
        return self._cache[name]

    @cached_property
    def lid_edge_distance(self) -> Floats:
        """(n,) distance along the skin from the nearest lid edge of either eye, metres."""
        nearest: Floats = np.min([self.lid_distances(side)[i] for side in "lr" for i in (0, 1)], axis=0)
        return nearest

    @cached_property
    def lip_edge_distance(self) -> Floats:
        """(n,) distance along the skin from the nearest lip edge, metres."""
        return np.minimum(*self.lip_distances)
