"""Heads that look another way than their body: faces sought at the ends of a mesh, each with its own symmetry.

A body's plane of symmetry is not its head's once the neck is turned, and a body whose arms differ has none. A head is
an end of the mesh, as hands and feet are: a place farther from the middle than all round it, along the surface. How
the limbs are held does not change that, and arms that are near to the head in space are far along the surface. Of the
ends a head has the most surface within reach.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ....arrays import Bools, Floats, Ints
from ..surface.cloud import Cloud, Surface, sample, sample_shelves
from ..surface.shelves import MANY, Shelves
from ..surface.skeleton import Net
from ..surface.symmetry import symmetry_planes
from .search import Guess, best_guesses, search_plane

#: Points that a region is seen by; every how many-th of them tells its symmetry.
REGION, SYMMETRY_STRIDE = 30_000, 30
#: The middle is where the way to so many places that are far from each other is shortest.
FAR_PLACES = 4
#: An end is farther from the middle than all that is so near to it, and what is so near tells how much of a head it is;
#: shares of the root of the surface's area, which measures some 1.3 m of a grown-up.
ALONE = 0.2
#: So many ends are searched, of those that have this share of the bulkiest one's surface.
ENDS, BULKY = 4, 0.5
#: A region is what lies this near to an end, shares of the same: heads of grown-ups, of children, toons and busts.
REACHES = (0.28, 0.22, 0.42, 0.6)
#: A region with more of the mesh's surface than this is no end of it; at most so many are searched.
LARGEST_SHARE, REGIONS = 0.55, 8
#: A region's diagonal over 0.75 measures between these, metres of a real person.
LENGTHS = (0.18, 0.62)
#: Planes of symmetry of each region that are looked at closely, and searched.
REFINED, PLANES = 5, 2
#: A guess that costs more than this is none, metres.
HOPELESS = 6e-3


@dataclass(frozen=True, eq=False)
class End:
    """An end of a surface: distances (N,) of the net's nodes from it along the surface, and how much is round it."""

    away: Floats
    bulk: float


def guesses_at_ends(surface: Surface, net: Net) -> Iterator[list[Guess]]:
    """The best guesses in ever further regions at the ends of a mesh with its net, the likeliest first."""
    size = float(np.sqrt(net.area.sum()))
    found = ends(net)[:ENDS]
    regions = [end.away < reach * size for reach in REACHES for end in found if end.bulk >= BULKY * found[0].bulk]
    small = [chosen for chosen in regions if net.area[chosen].sum() <= LARGEST_SHARE * size**2]
    shelves = by_node(surface, net) if len(surface.triangles) > MANY else None
    for chosen in small[:REGIONS]:
        if shelves is not None:
            cloud = sample_shelves(surface, shelves, chosen, REGION)
            guesses = _guesses_about(cloud, float(shelves.areas[chosen].sum()))
        else:
            part = surface.part(_touched(surface, net, chosen))
            guesses = _guesses_about(sample(part, REGION), float(part.twice_areas.sum() / 2.0))
        yield best_guesses([guess for guess in guesses if guess.cost < HOPELESS])


def by_node(surface: Surface, net: Net) -> Shelves:
    """The triangles of a dense surface on a shelf for each node of its net, that of their first corner."""
    return Shelves.of(net.node[surface.triangles[:, 0]], len(net.places), surface.twice_areas / 2.0)


def _touched(surface: Surface, net: Net, chosen: Bools) -> Bools:
    """(T,) triangles with a corner in one of the chosen nodes (N,)."""
    return np.asarray(chosen[net.node][surface.triangles].any(axis=1), dtype=np.bool_)


def _guesses_about(cloud: Cloud, area: float) -> list[Guess]:
    """The best guesses in a part of the mesh, seen by a cloud and of some area, about its own planes of symmetry."""
    if len(cloud) == 0:
        return []
    diagonal = float(np.linalg.norm(np.ptp(cloud.positions, axis=0)))
    planes = symmetry_planes(cloud.positions[::SYMMETRY_STRIDE], refined=REFINED)[:PLANES]
    return [guess for plane in planes for guess in search_plane(cloud, area, diagonal, plane, lengths=LENGTHS)]


def ends(net: Net) -> list[End]:
    """Where a surface ends: what has the most surface round it first."""
    alone = ALONE * float(np.sqrt(net.area.sum()))
    far = np.zeros((0, len(net.places)))
    for _ in range(FAR_PLACES):
        nearest = far.min(axis=0) if len(far) else net.along(np.array([0]))[0]
        far = np.vstack([far, net.along(np.array([int(nearest.argmax())]))])
    away = net.along(np.array([int(far.sum(axis=0).argmin())]))[0]
    tips = []
    for node in _summits(net, away):
        near = net.along(np.array([node]), within=alone)[0] < alone
        if away[near].max() <= away[node]:
            tips.append(End(net.along(np.array([node]))[0], float(net.area[near].sum())))
    return sorted(tips, key=lambda end: -end.bulk)


def _summits(net: Net, height: Floats) -> Ints:
    """Nodes that are no lower than any of their neighbours."""
    both = (net.graph + net.graph.T).tocoo()
    highest = height.copy()
    np.maximum.at(highest, both.row, height[both.col])
    found: Ints = np.flatnonzero(height >= highest)
    return found
