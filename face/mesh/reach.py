"""Which skin a face can move: what is near its feature points along the skin. A body's other skin stays where it is."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse.csgraph import connected_components, dijkstra
from scipy.spatial import cKDTree

from ...arrays import Bools, Floats, Ints
from ...physics.mesh import adjacency
from ...polygons import PolygonTable
from ..figures import Length, read_figures


@dataclass(frozen=True)
class ReachFigures:
    """How far from its points a face moves skin (presets/anatomy/skin.toml)."""

    along_the_skin: Length


REACH = read_figures("skin.reach", ReachFigures)


def within_reach(positions: Floats, polygons: PolygonTable, sources: Ints) -> Bools:
    """(V,) which vertices of some skin are within reach of some of them.

    A head whose skin all lies within reach through the air is taken whole. Pieces of their own, such as a mouth bag,
    are within reach through the air or not at all.

    Parameters
    ----------
    positions : (V, 3) head space, metres.
    polygons : those of the skin.
    sources : (n,) vertices of the skin that feature points hold on to.
    """
    skin = np.zeros(len(positions), dtype=bool)
    skin[polygons.loops] = True
    index = np.flatnonzero(skin)
    near = skin.copy()
    distance, _ = cKDTree(positions[sources]).query(positions[index], distance_upper_bound=REACH.along_the_skin)
    near[index] = np.isfinite(distance)
    if near[index].all():
        return near
    along = dijkstra(
        adjacency(positions, polygons.kept(polygons.within(near)), diagonals=False),
        directed=False,
        indices=np.unique(sources),
        min_only=True,
        limit=REACH.along_the_skin,
    )
    _, piece = connected_components(adjacency(positions, polygons, diagonals=False), directed=False)
    joined = np.isin(piece, piece[sources])
    return near & (np.isfinite(along) | ~joined)
