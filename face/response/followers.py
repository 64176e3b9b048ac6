"""Skin that does not show follows the skin that does: mouth bag and eye sockets."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np
from scipy import sparse
from scipy.spatial import cKDTree

from ...arrays import Bools, Floats, Ints
from ...physics.elastic import Factor, diagonal_matrix, laplacian
from ...physics.mesh import Sparse, applied, vertex_areas, with_short_indices
from ...polygons import PolygonTable
from ...progress import Progress, Work, run
from ..figures import Length, read_figures
from ..skin.outer import OuterSkin

#: Inner skin is tied to rest as weakly as this, relative to its neighbours, so that loose pieces stay put.
REST_TIE = 1e-4

#: Inner vertices that are tied to the outer skin at once, and what is said meanwhile.
AT_ONCE, FOLLOWING = 4000, "Preparing what follows the skin"


@dataclass(frozen=True)
class FleshFigures:
    """Of what lies between inner and outer skin (presets/anatomy/skin.toml)."""

    reach: Length
    length: Length


FLESH = read_figures("skin.flesh", FleshFigures)


class InnerSkin:
    """Skin behind the lips and lids: takes the smoothest displacement that fits the margins it hangs on.

    Where only a few millimetres of flesh lie between it and the outer skin, it goes with that skin, and so cannot come
    out through it.
    """

    def __init__(self, positions: Floats, polygons: PolygonTable, inner: Bools, outer: OuterSkin) -> None:
        """Prepare for positions (V, 3), the skin's polygons, the mask (V,) of vertices that follow, and `outer`.

        Lengths are metres of head space. Polygons without a vertex that follows may be left out.
        """
        run(self._bind(positions, polygons, inner, outer))

    @classmethod
    def steps(cls, positions: Floats, polygons: PolygonTable, inner: Bools, outer: OuterSkin) -> Work[Self]:
        """As the class, bit by bit."""
        made = cls.__new__(cls)
        yield from made._bind(positions, polygons, inner, outer)
        return made

    def _bind(self, positions: Floats, polygons: PolygonTable, inner: Bools, outer: OuterSkin) -> Work[None]:
        """Work out what follows what."""
        self.index: Ints = np.flatnonzero(inner)
        if len(self.index) == 0:
            return
        areas = vertex_areas(positions, polygons)
        rows: Sparse = laplacian(positions, polygons)[self.index]
        own: Sparse = rows[:, self.index]
        yield Progress(0.0, FOLLOWING)
        diagonal = own.diagonal()
        rest = REST_TIE * np.where(diagonal > 0, diagonal, 1.0)
        flesh = yield from _flesh(positions[self.index], areas[self.index], outer, len(positions))
        yield Progress(1.0, FOLLOWING)
        self._factor = Factor(own + diagonal_matrix(rest + np.asarray(flesh.sum(axis=1)).ravel()))
        yield Progress(1.0, FOLLOWING)
        keep = np.ones(len(positions))
        keep[self.index] = 0.0
        coupling: Sparse = (flesh - rows @ diagonal_matrix(keep)).tocsr()
        self._leads: Ints = np.unique(coupling.indices)
        self._coupling: Sparse = with_short_indices(coupling[:, self._leads])

    def follow(self, displacements: Floats) -> None:
        """Fill in the inner rows of displacement fields (..., V, 3), in place."""
        if len(self.index):
            leads = displacements[..., self._leads, :].reshape(-1, len(self._leads), 3)
            pulled = applied(self._coupling, leads)
            followed = [self._factor.solve(each) for each in pulled]
            displacements[..., self.index, :] = np.reshape(followed, (*displacements.shape[:-2], -1, 3))


def _flesh(inner: Floats, areas: Floats, outer: OuterSkin, count: int) -> Work[Sparse]:
    """(i, count) how firmly each inner vertex is tied to the outer skin that it lies behind.

    Summed over the outer skin within reach by its area, so that neither density nor the order of neighbours matters;
    before a flat skin at depth h the sum is (1 - (h / reach)^2)^4.
    """
    tree, ties = cKDTree(outer.positions), list[Sparse]()
    for first in range(0, len(inner), AT_ONCE):
        yield Progress(first / len(inner), FOLLOWING)
        some = slice(first, first + AT_ONCE)
        ties.append(_ties(inner[some], areas[some], outer, tree, count))
    return sparse.csr_array(sparse.vstack(ties))


def _ties(inner: Floats, areas: Floats, outer: OuterSkin, tree: cKDTree, count: int) -> Sparse:
    """The rows of `_flesh` of some inner vertices; `tree` is of the outer skin."""
    pairs = cKDTree(inner).sparse_distance_matrix(tree, FLESH.reach, output_type="coo_matrix")
    own, other, distance = pairs.row, pairs.col, pairs.data
    away = outer.positions[other] - inner[own]
    behind = np.maximum((away * outer.normals[other]).sum(axis=1) / np.maximum(distance, 1e-9), 0.0) ** 2
    near = outer.areas[other] * (1.0 - (distance / FLESH.reach) ** 2) ** 3 * 4.0 / (np.pi * FLESH.reach**2)
    ties = areas[own] * near * behind / FLESH.length**2
    return sparse.csr_array((ties, (own, outer.index[other])), shape=(len(inner), count))
