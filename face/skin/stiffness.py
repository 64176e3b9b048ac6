"""Springs between a few vertices of a dense skin that are together as stiff as the springs between all of them.

The springs of a skin do not resist alike in all directions where its polygons are not regular (`physics.elastic`). How
they resist round each kept vertex is one symmetric matrix; the springs of fewer vertices are the linear elements of a
sheet that resists so. Triangles are turned until hardly any of them would have to push: a spring only pulls. This is
Delaunay's rule for triangles, in a plane that is stretched as the sheet is stiff.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...arrays import Bools, Floats, Ints
from ...physics.elastic import dirichlet_springs
from ...physics.mesh import pair_keys
from ...polygons import PolygonTable
from ...progress import Progress, Work

#: Polygons whose springs are looked at together.
TOGETHER = 20_000

#: Triangles are turned so many times at most.
MOST_TURNS = 24

#: A triangle that is narrower than this share of its longest side squared counts as so wide: slivers are not stiff.
NARROWEST = 0.02

#: A spring that pushes less than this is let be.
LEVEL = -1e-6


def stiffness_round(positions: Floats, polygons: PolygonTable, owners: Ints, areas: Floats) -> Work[Floats]:
    """(N, 3, 3) how a skin's springs resist round each of N places, per area of skin: the identity along an even sheet.

    Parameters
    ----------
    positions : (n, 3) m. owners : (n,) the place of each vertex. areas : (n,) m^2.
    """
    count = int(owners.max()) + 1
    sums = np.zeros((count, 6))
    upper = np.triu_indices(3)
    for first in range(0, len(polygons), TOGETHER):
        yield Progress(first / len(polygons), "Preparing the skin")
        ends, weights = dirichlet_springs(positions, polygons[first : first + TOGETHER])
        way = positions[ends[:, 1]] - positions[ends[:, 0]]
        resists = (way[:, upper[0]] * way[:, upper[1]] * (0.5 * weights)[:, None]).T
        for column, each in enumerate(resists):
            for end in ends.T:
                sums[:, column] += np.bincount(owners[end], each, minlength=count)
    full = np.empty((count, 3, 3))
    full[:, upper[0], upper[1]] = full[:, upper[1], upper[0]] = sums
    return full / np.bincount(owners, areas, minlength=count)[:, None, None]


def springs_on(positions: Floats, triangles: Ints, stiffness: Floats) -> tuple[Ints, Floats]:
    """Pairs and weights of the springs of triangles (T, 3) between places (N, 3) that resist so (N, 3, 3).

    They are as of `physics.elastic.dirichlet_springs`; one that would push does nothing.
    """
    resists = stiffness[triangles].mean(axis=1)
    pairs, weights = [], []
    for corner in range(3):
        apex, a, b = np.roll(triangles, -corner, axis=1).T
        pairs.append(np.sort(np.stack([a, b], axis=1), axis=1))
        weights.append(_pull(positions, resists, (apex, a, b)))
    keys, place = np.unique(pair_keys(np.concatenate(pairs)), return_inverse=True)
    summed = np.bincount(place.ravel(), np.concatenate(weights), minlength=len(keys))
    return np.stack([keys >> 32, keys & 0xFFFFFFFF], axis=1), np.maximum(summed, 0.0)


def _pull(positions: Floats, stiffness: Floats, corners: Sequence[Ints]) -> Floats:
    """(t,) what triangles (apex, a, b) that resist so (t, 3, 3) add to the springs between a and b."""
    apex, a, b = (positions[corner] for corner in corners)
    from_b, from_apex = apex - b, a - apex
    normal = np.cross(a - apex, b - apex)
    double_area = np.linalg.norm(normal, axis=1)
    normal /= np.maximum(double_area, 1e-30)[:, None]
    longest = np.maximum((from_b**2).sum(axis=1), (from_apex**2).sum(axis=1))
    slope_a, slope_b = np.cross(normal, from_b), np.cross(normal, from_apex)
    resisted = (slope_a * (stiffness @ slope_b[:, :, None])[:, :, 0]).sum(axis=1)
    return np.asarray(-resisted / (2.0 * np.maximum(double_area, NARROWEST * longest)))


def turned(positions: Floats, triangles: Ints, stiffness: Floats) -> Work[Ints]:
    """(T, 3) the triangles between the same places with sides turned whose springs would push.

    A side that two triangles share is laid between their other corners, the worst first, and none twice in one round.
    """
    triangles = triangles.copy()
    fresh = np.ones(len(triangles), dtype=bool)
    for turn in range(MOST_TURNS):
        yield Progress(turn / MOST_TURNS, "Preparing the skin")
        sides = _shared_sides(triangles, fresh)
        chosen, pull = _pushing(positions, triangles, stiffness, sides)
        sides = _apart(sides.of(chosen[np.argsort(pull)]), len(triangles))
        if not len(sides.first):
            break
        triangles[sides.first] = np.stack([sides.c, sides.a, sides.d], axis=1)
        triangles[sides.second] = np.stack([sides.c, sides.d, sides.b], axis=1)
        fresh[:] = False
        fresh[sides.first] = fresh[sides.second] = True
    return triangles


@dataclass(frozen=True, eq=False)
class _Sides:
    """Sides from a to b that two triangles share, first (c, a, b) and second (d, b, a); (s,) each."""

    a: Ints
    b: Ints
    c: Ints
    d: Ints
    first: Ints
    second: Ints

    def of(self, some: Ints | Bools) -> _Sides:
        """Some of them."""
        return _Sides(*(each[some] for each in vars(self).values()))


def _shared_sides(triangles: Ints, fresh: Bools) -> _Sides:
    """The sides that two triangles share, of which one is fresh (T,)."""
    ends = np.concatenate([triangles[:, [1, 2]], triangles[:, [2, 0]], triangles[:, [0, 1]]])
    apexes, owners = triangles.T.ravel(), np.tile(np.arange(len(triangles)), 3)
    keys = pair_keys(np.sort(ends, axis=1))
    order = np.argsort(keys, kind="stable")
    starts = np.flatnonzero(np.concatenate([[True], np.diff(keys[order]) != 0]))
    twice = starts[np.diff(np.append(starts, len(keys))) == 2]
    one, other = order[twice], order[twice + 1]
    alike = (ends[one, 0] == ends[other, 1]) & (apexes[one] != apexes[other])
    alike &= fresh[owners[one]] | fresh[owners[other]]
    alike &= ~np.isin(pair_keys(np.sort(np.stack([apexes[one], apexes[other]], axis=1), axis=1)), keys)
    one, other = one[alike], other[alike]
    a, b = ends[one].T
    return _Sides(a, b, apexes[one], apexes[other], owners[one], owners[other])


def _pushing(positions: Floats, triangles: Ints, stiffness: Floats, sides: _Sides) -> tuple[Ints, Floats]:
    """Which sides' springs push and would push less if they were turned, and how they pull; none folds the skin."""
    a, b, c, d = sides.a, sides.b, sides.c, sides.d
    resists = 0.25 * (stiffness[a] + stiffness[b] + stiffness[c] + stiffness[d])
    now = _pull(positions, resists, (c, a, b)) + _pull(positions, resists, (d, b, a))
    pushing = np.flatnonzero(now < LEVEL)
    a, b, c, d, resists, now = a[pushing], b[pushing], c[pushing], d[pushing], resists[pushing], now[pushing]
    then = _pull(positions, resists, (a, d, c)) + _pull(positions, resists, (b, c, d))

    def normal(p: Ints, q: Ints, r: Ints) -> Floats:
        return np.cross(positions[q] - positions[p], positions[r] - positions[p])

    facing = normal(c, a, b) + normal(d, b, a)
    flat = ((normal(c, a, d) * facing).sum(axis=1) > 0.0) & ((normal(c, d, b) * facing).sum(axis=1) > 0.0)
    better = flat & (then > now)
    return pushing[better], now[better]


def _apart(sides: _Sides, count: int) -> _Sides:
    """Those of some sides, the first first, that have no triangle in common and are not turned to the same place."""
    number = np.arange(len(sides.first))
    taken = np.full(count, len(number))
    for owners in (sides.first, sides.second):
        np.minimum.at(taken, owners, number)
    alone = (taken[sides.first] == number) & (taken[sides.second] == number)
    keys = pair_keys(np.sort(np.stack([sides.c, sides.d], axis=1), axis=1))
    _, once = np.unique(np.where(alone, keys, -1 - number), return_index=True)
    return sides.of(once[alone[once]])
