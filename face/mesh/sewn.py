"""Openings that open nowhere: lips and lids that are one surface, as scans and toys have them.

There the way along the skin from one lip to the other leads straight across instead of round the corner of the mouth,
or in and out of a mouth bag. What lies between the margins, the web, is part of the skin that muscles pull on, so that
it moves as a whole and nothing is stretched; but as a way along the skin it does not count, or the upper lip would be
taken for a part of the lower one.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from scipy import sparse
from scipy.sparse.csgraph import connected_components, dijkstra

from ...arrays import Bools, Floats, Ints
from ...errors import ModelError
from ...physics import mesh
from ...physics.mesh import Sparse
from ...polygons import PolygonTable
from ...progress import Progress, Work, run
from ..figures import Share, read_figures
from .lid_ball import lid_ball
from .openings import LIDS, Opening


@dataclass(frozen=True)
class SewnFigures:
    """When an opening counts as sewn, and lids as shut (presets/anatomy/parts.toml)."""

    straight: Share
    shut: Share


SEWN = read_figures("parts.sewn", SewnFigures)

#: Ways along the skin round an opening are hardly ever longer than this many times its size.
FARTHEST = 4.0

#: Opening -> points beyond its upper and its lower margin, and its corners.
ACROSS = {
    "mouth": ("8.1", "8.2", "8.3", "8.4"),
    "l": ("3.1", "3.3", "3.11", "3.7"),
    "r": ("3.2", "3.4", "3.8", "3.12"),
}


def sewn_openings(
    positions: Floats, skin: PolygonTable, nearest: Mapping[str, int], points: Mapping[str, Floats]
) -> frozenset[str]:
    """Which of "mouth", "l" and "r" (the eyes) are sewn: the lips as they are, lids only where they are shut.

    An eye that is open and one surface with its lids is not sewn: its lids close over it.

    Parameters
    ----------
    positions : (V, 3) head space, metres. skin : its polygons.
    nearest : feature point -> vertex. points : feature point -> (3,) in head space.
    """
    return run(sewn_steps(positions, skin, nearest, points))


def sewn_steps(
    positions: Floats, skin: PolygonTable, nearest: Mapping[str, int], points: Mapping[str, Floats]
) -> Work[frozenset[str]]:
    """As `sewn_openings`, bit by bit."""
    ways = mesh.adjacency(positions, skin)
    yield Progress(0.5, "Preparing the skin")
    known = [name for name, across in ACROSS.items() if all(point in nearest for point in across)]
    whole = list[str]()
    for number, name in enumerate(known):
        yield Progress(0.5 + 0.5 * number / len(known), "Preparing the skin")
        if _leads_across(positions, ways, nearest, name):
            whole.append(name)
    eyes = [name for name in whole if name in LIDS]
    if eyes:
        yield Progress(1.0, "Preparing the skin")
    edges = mesh.adjacency(positions, skin, diagonals=False) if eyes else ways
    return frozenset(whole) - {side for side in eyes if not _is_shut(positions, skin, edges, nearest, points, side)}


def _leads_across(positions: Floats, ways: Sparse, nearest: Mapping[str, int], name: str) -> bool:
    """Whether the way along the skin from one lip or lid to the other leads straight across."""
    at = [nearest[point] for point in ACROSS[name]]
    lower, corners = at[1], at[2:]
    limit = FARTHEST * float(np.linalg.norm(np.ptp(positions[at], axis=0)))
    far = dijkstra(ways, directed=False, indices=at[:2], limit=limit)
    if far[:, corners].sum(axis=0).min() > limit:  # what is farther than the limit was not seen
        far = dijkstra(ways, directed=False, indices=at[:2])
    around = min(far[0, corner] + far[1, corner] for corner in corners)
    return bool(far[0, lower] <= SEWN.straight * around)


def _is_shut(
    positions: Floats,
    skin: PolygonTable,
    edges: Sparse,
    nearest: Mapping[str, int],
    points: Mapping[str, Floats],
    side: str,
) -> bool:
    """Whether lids that are one surface are shut: they all but meet, or one bulges over the eye without a rim."""
    above, below, *ends = (points[point] for point in ACROSS[side])
    if np.linalg.norm(above - below) < SEWN.shut * np.linalg.norm(ends[0] - ends[1]):
        return True
    try:
        ball = lid_ball(positions, skin, edges, nearest, points, side)
    except ModelError:
        return False  # said where the face's skin is built
    return ball is not None and ball.is_lid


def web_of(positions: Floats, polygons: PolygonTable, outside: Bools, opening: Opening) -> tuple[Bools, Opening]:
    """The web of a sewn opening, and the opening with margins along the web's two sides, which share no vertex.

    Parameters
    ----------
    positions : (V, 3) head space, metres. polygons : of the skin, F.
    outside : (F,) which of them lie outside all openings.
    opening : as its feature points tell; where its margins run along the same edges, the web is what touches these.

    Returns
    -------
    (F,) mask of the web, and the opening.
    """
    ends = np.array([opening.upper[0], opening.upper[-1]])
    shared = np.setdiff1d(np.intersect1d(opening.upper, opening.lower), ends)
    web = _inside(positions, polygons, outside, opening.loop)
    web[polygons.owners[np.isin(polygons.loops, shared)]] = True
    rest = polygons.kept(outside & ~web)
    margin = np.setdiff1d(np.intersect1d(polygons.kept(web).loops, rest.loops), ends)
    height = positions[margin, 1] - _seam(positions, opening, positions[margin, 0])
    graph = mesh.adjacency(positions, rest, diagonals=False)
    upper = _along(graph, positions, np.concatenate([ends, margin[height > 0.0]]))
    lower = _along(graph, positions, np.concatenate([ends[::-1], margin[height <= 0.0]]))
    return web, Opening(upper, lower)


def _inside(positions: Floats, polygons: PolygonTable, outside: Bools, loop: Ints) -> Bools:
    """(F,) polygons inside the margins (k,) of one opening: those not outside that hang together with its loop."""
    inner = polygons.kept(~outside)
    _, labels = connected_components(mesh.adjacency(positions, inner, diagonals=False), directed=False)
    own = np.isin(labels, labels[np.intersect1d(loop, inner.loops)])
    return np.asarray(~outside & own[polygons.loops[polygons.starts]])


def _seam(positions: Floats, opening: Opening, across: Floats) -> Floats:
    """Heights (k,) of the seam, midway between both margins, at places (k,) across the face."""
    heights = []
    for arc in (opening.upper, opening.lower):
        order = np.argsort(positions[arc, 0], kind="stable")
        heights.append(np.interp(across, positions[arc[order], 0], positions[arc[order], 1]))
    return np.asarray((heights[0] + heights[1]) / 2.0)


def _along(graph: Sparse, positions: Floats, side: Ints) -> Ints:
    """A path from the first to the second of vertices (k,) along edges between them; where there is none, in order."""
    among = np.full(graph.shape[0], -1, dtype=np.int64)
    among[side] = np.arange(len(side))
    edges = sparse.coo_array(graph)
    kept = (among[edges.row] >= 0) & (among[edges.col] >= 0)
    entries = (edges.data[kept], (among[edges.row[kept]], among[edges.col[kept]]))
    own = sparse.csr_array(entries, shape=(len(side), len(side)))
    _, previous = dijkstra(own, indices=np.array(0), return_predecessors=True)
    path = [1]
    while path[-1] != 0 and previous[path[-1]] >= 0:
        path.append(int(previous[path[-1]]))
    if path[-1] == 0:
        return side[path[::-1]]
    way = positions[side[1], 0] - positions[side[0], 0]
    return side[np.argsort((positions[side, 0] - positions[side[0], 0]) / way, kind="stable")]
