"""Heads that look another way than their body: faces sought at the ends of a mesh, each with its own symmetry.

A body's plane of symmetry is not its head's once the neck is turned. A head is an end of the mesh, as hands and feet
are: a place farther from the middle than all round it.
"""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from ....arrays import Floats
from ....progress import Progress, Work
from ..surface.cloud import Cloud, Surface, sample
from ..surface.symmetry import symmetry_planes
from .search import Guess, best_guesses, search_plane

#: Points that ends are sought with, and a region is seen by; every how many-th of the latter tells its symmetry.
PROBES, REGION, SYMMETRY_STRIDE = 3_000, 30_000, 30
#: An end is at least so far from the middle, and farther than all points that near; in radii (root mean square).
FAR, ALONE = 1.3, 0.5
#: A region is what lies this near to an end, in radii: heads of grown-ups, of children and toons.
REACHES = (0.5, 0.65, 0.9)
#: A region with more of the mesh's points than this is no end of it.
LARGEST_SHARE = 0.3
#: A region's diagonal over 0.75 measures between these, metres of a real person.
LENGTHS = (0.18, 0.62)
#: Planes of symmetry of each region that are searched.
PLANES = 2
#: A guess that costs less than this ends the search, one that costs more than that is none; metres.
CERTAIN, HOPELESS = 3.5e-3, 6e-3


def guesses_at_ends(surface: Surface, cloud: Cloud) -> Work[list[Guess]]:
    """The best guesses at the ends of a mesh; none where it has no ends.

    Parameters
    ----------
    surface : the mesh.
    cloud : points spread over it.
    """
    _, radius = middle_and_radius(cloud.positions)
    corners = surface.vertices[surface.triangles]
    found = ends(cloud.positions)
    places = [(end, reach * radius) for reach in REACHES for end in found]
    guesses: list[Guess] = []
    for number, (end, reach) in enumerate(places):
        yield Progress(number / len(places), "Searching for a turned head")
        if (np.linalg.norm(cloud.positions - end, axis=1) < reach).mean() > LARGEST_SHARE:
            continue
        guesses += _guesses_in(surface.part((np.linalg.norm(corners - end, axis=2) < reach).any(axis=1)))
        if any(guess.cost < CERTAIN for guess in guesses):
            break
    return best_guesses([guess for guess in guesses if guess.cost < HOPELESS])


def _guesses_in(part: Surface) -> list[Guess]:
    """The best guesses in a part of the mesh, about its own planes of symmetry."""
    cloud = sample(part, REGION)
    if len(cloud) == 0:
        return []
    area = float(np.linalg.norm(part.cross(), axis=1).sum() / 2.0)
    diagonal = float(np.linalg.norm(np.ptp(cloud.positions, axis=0)))
    planes = symmetry_planes(cloud.positions[::SYMMETRY_STRIDE])[:PLANES]
    return [guess for plane in planes for guess in search_plane(cloud, area, diagonal, plane, lengths=LENGTHS)]


def ends(positions: Floats) -> list[Floats]:
    """Places (3,) of points (N, 3) spread over a mesh that lie farther from its middle than all round them."""
    probes = positions[:: max(1, len(positions) // PROBES)]
    middle, radius = middle_and_radius(probes)
    away = np.linalg.norm(probes - middle, axis=1)
    around = cKDTree(probes).query_ball_point(probes, ALONE * radius)
    return [probes[k] for k, near in enumerate(around) if away[k] >= max(FAR * radius, away[near].max())]


def middle_and_radius(positions: Floats) -> tuple[Floats, float]:
    """The mean of points (N, 3), and their root mean squared distance from it."""
    middle = positions.mean(axis=0)
    return middle, float(np.sqrt(((positions - middle) ** 2).sum(axis=1).mean()))
