"""The mouth and the eyes as openings of the skin: where the lips and the lids end.

A mesh may have a mouth bag, an open mouth boundary or triangles that fill it; eyes likewise. Forces must not pass
through any of these, or the lips would pull each other. So the outer skin is cut along closed paths through the
lip and lid points, and what lies inside a path is left to follow.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy import sparse
from scipy.sparse.csgraph import connected_components, dijkstra

from ...arrays import Bools, Ints
from ...errors import ModelError
from ...physics.mesh import Polygons, Sparse, pair_keys
from ...polygons import PolygonTable
from ...progress import Progress, Work, part_of, run

#: Closed path through the lips: upper arc from the left corner to the right one, then the lower arc back.
LIP_UPPER = ("2.4", "2.6", "2.2", "2.7", "2.5")
LIP_LOWER = ("2.5", "2.9", "2.3", "2.8", "2.4")

#: The same for each eye: upper lid from the inner to the outer corner, then the lower lid back.
LIDS = {
    "l": (("3.11", "3.1", "3.7"), ("3.7", "3.3", "3.11")),
    "r": (("3.8", "3.2", "3.12"), ("3.12", "3.4", "3.8")),
}

#: Upper and lower arc of every opening.
OPENINGS = {"mouth": (LIP_UPPER, LIP_LOWER), **LIDS}


@dataclass(frozen=True, eq=False)
class Opening:
    """One opening of the skin: the vertex paths (indices into the mesh) of its upper and lower margin."""

    upper: Ints
    lower: Ints

    @property
    def loop(self) -> Ints:
        """Every margin vertex once."""
        return np.asarray(np.unique(np.concatenate([self.upper, self.lower])), dtype=np.int64)


def _path(graph: Sparse, stops: Sequence[int], names: Sequence[str]) -> Work[Ints]:
    """Shortest path along edges through the given vertices, each vertex named once per leg."""
    steps = [stops[0]]
    legs = list(zip(stops, stops[1:], names, names[1:], strict=False))
    for number, (start, end, a, b) in enumerate(legs):
        if start == end:
            continue
        yield Progress(number / len(legs), "Preparing the skin")
        distance, previous = dijkstra(graph, indices=np.array(end), return_predecessors=True)
        if not np.isfinite(distance[start]):
            raise ModelError(_on_separate_pieces(graph, (start, end), (a, b)))
        at = start
        while at != end:
            at = int(previous[at])
            steps.append(at)
    return np.array(steps, dtype=np.int64)


def _on_separate_pieces(graph: Sparse, stops: tuple[int, int], names: tuple[str, str]) -> str:
    """What to say of two points that no edges join: which, how many vertices are on their pieces, and the remedy."""
    labels = connected_components(graph, directed=False)[1]
    sizes = [int(np.count_nonzero(labels == labels[stop])) for stop in stops]
    return (
        f"feature points {names[0]} and {names[1]} are on separate pieces of the mesh, of {sizes[0]} and {sizes[1]} "
        "vertices, not on one lip or lid: merge the vertices where the pieces meet (Mesh > Merge > By Distance), or "
        "move the points onto one piece"
    )


def find_opening(graph: Sparse, nearest: Mapping[str, int], upper: Sequence[str], lower: Sequence[str]) -> Opening:
    """The opening whose margin runs through the named points.

    Parameters
    ----------
    graph : (V, V) edge lengths (`physics.mesh.adjacency`).
    nearest : feature point -> vertex index.
    upper, lower : point names along the two arcs; those that the face lacks are skipped.

    Raises
    ------
    ModelError : when two of the points are not joined by edges.
    """
    return run(find_opening_steps(graph, nearest, upper, lower))


def find_opening_steps(
    graph: Sparse, nearest: Mapping[str, int], upper: Sequence[str], lower: Sequence[str]
) -> Work[Opening]:
    """As `find_opening`, bit by bit: a step for each leg between two points."""
    arcs = list[Ints]()
    for arc in (upper, lower):
        names = [name for name in arc if name in nearest]
        path = _path(graph, [nearest[name] for name in names], names)
        arcs.append((yield from part_of(path, 0.5 * len(arcs), 0.5 * len(arcs) + 0.5)))
    return Opening(upper=arcs[0], lower=arcs[1])


def outer_faces(polygons: Polygons, openings: Sequence[Opening], seed: int) -> Bools:
    """Which polygons belong to the outer skin: those joined to a seed vertex without crossing an opening's margin.

    Parameters
    ----------
    polygons : those of the skin.
    openings : margins that are not crossed.
    seed : a vertex well outside every opening, such as the nose tip.

    Returns
    -------
    (F,) mask.
    """
    arcs = [arc for opening in openings for arc in (opening.upper, opening.lower)]
    margins = [np.sort(np.stack([arc[:-1], arc[1:]], axis=1), axis=1) for arc in arcs]
    polygons = PolygonTable.of(polygons)
    sides = pair_keys(np.sort(np.stack([polygons.loops, polygons.after], axis=1), axis=1))
    free = np.flatnonzero(~np.isin(sides, pair_keys(np.concatenate(margins))))
    order = free[np.argsort(sides[free], kind="stable")]
    same = sides[order[1:]] == sides[order[:-1]]
    first, second = polygons.owners[order[:-1][same]], polygons.owners[order[1:][same]]
    graph = sparse.coo_array((np.ones(len(first)), (first, second)), shape=(len(polygons), len(polygons)))
    _, labels = connected_components(graph, directed=False)
    at_home = np.flatnonzero(polygons.loops == seed)
    if not len(at_home):
        raise ModelError("the nose tip 9.3 is not on a polygon of the skin")
    return np.asarray(labels == labels[polygons.owners[at_home[0]]])
