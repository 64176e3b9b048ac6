"""Where lids and lips end: the rims of the skin that faces the viewer round an eye or the mouth.

Faces that look toward the viewer near an opening are joined over their sides; the piece that the skin round the
opening lies on ends at the lid margin, or where the lips meet. Sockets, eyeballs, gums and the mouth's bag are not
joined to it through faces that look outward. So no curvature is needed, and real holes are found the same way.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy import sparse
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from ...arrays import Floats, Ints
from .cloud import Surface, nearest

#: A rim is taken for the opening's when its mean distance from where it is expected stays below, metres.
FARTHEST = 10e-3
#: Narrowest and widest rim, times the expected width.
WIDTHS = {"eye": (0.5, 1.8), "mouth": (0.5, 1.5)}
#: Reach round the opening, metres; least outwardness of a face, the first being the usual one.
REACH = {"eye": 32e-3, "mouth": 48e-3}
FACINGS = {"eye": (0.3, 0.1, 0.45), "mouth": (0.2, 0.05, 0.4)}
#: Another outwardness is preferred where its rim lies nearer by this ratio.
NEARER = 0.8
#: Parts of an opening that are filled with skin less deep than this are no opening, metres.
FILLED_DEPTH = 2.5e-3


@dataclass(frozen=True)
class Margin:
    """The rim of an opening, from its corner on the subject's right along the upper edge.

    Attributes
    ----------
    upper : (U, 3) from the corner at the smallest x to that at the largest.
    lower : (L, 3) between the same corners.
    misfit : mean distance from where it was expected, metres.
    """

    upper: Floats
    lower: Floats
    misfit: float

    def corner(self, sign: float) -> Floats:
        """(3,) the corner on the subject's left (sign > 0) or right."""
        return np.asarray(self.upper[-1 if sign > 0.0 else 0])

    def at(self, edge: str, shares: Floats) -> Floats:
        """(N, 3) points of an edge ("upper", "lower") at shares of the way from the right to the left corner."""
        line = self.upper if edge == "upper" else self.lower
        way = line[-1] - line[0]
        along = (line - line[0]) @ way / max(float(way @ way), 1e-30)
        along = np.maximum.accumulate(along) + np.arange(len(line)) * 1e-9
        return np.column_stack([np.interp(shares, along, line[:, k]) for k in range(3)])


def find_margin(surface: Surface, kind: str, expected: Floats, outside: Floats) -> Margin | None:
    """The rim of an eye or the mouth, or None where there is none.

    Parameters
    ----------
    surface : the head in template coordinates, normals outward.
    kind : "eye" or "mouth".
    expected : (N, 3) where the template's rim lies now.
    outside : (N, 3) where its skin round the opening lies.
    """
    middle = expected.mean(axis=0)
    side = 0.25 * np.sign(middle[0]) if kind == "eye" else 0.0
    view = np.array([side, -1.0, 0.0])
    near = _Neighbourhood(surface, middle, REACH[kind])
    best: Margin | None = None
    for facing in FACINGS[kind]:
        found = _nearest_rim(near, view, facing, kind, expected, outside)
        if found is not None and (best is None or found.misfit < NEARER * best.misfit):
            best = found
    if best is None or kind == "mouth":
        return best
    return _with_inner_corner(near, best, np.sign(middle[0]), expected, outside)


class _Neighbourhood:
    """The triangles round an opening."""

    def __init__(self, surface: Surface, middle: Floats, reach: float) -> None:
        centres = surface.vertices[surface.triangles].mean(axis=1)
        chosen = np.linalg.norm(centres - middle, axis=1) < reach
        self.vertices = surface.vertices
        self.triangles = surface.triangles[chosen]
        self.centres = centres[chosen]
        cross = surface.part(chosen).cross()
        self.normals = cross / np.maximum(np.linalg.norm(cross, axis=1), 1e-30)[:, None]

    def rims(self, view: Floats, facing: float, outside: Floats) -> Iterator[Ints]:
        """Rims (closed lines of vertices) of the skin that faces a view and holds the places outside the opening."""
        shown = np.flatnonzero(self.normals @ (view / np.linalg.norm(view)) > facing)
        if len(shown) < 8:
            return
        triangles = self.triangles[shown]
        piece = _pieces(triangles)
        _, votes = cKDTree(self.centres[shown]).query(outside, k=3)
        most = np.bincount(piece[np.ravel(votes)]).argmax()
        yield from _closed_lines(triangles[piece == most])


def _pieces(triangles: Ints) -> Ints:
    """(T,) number of the piece of each triangle; pieces are joined over sides."""
    sides = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    keys = sides[:, 0] * (int(triangles.max()) + 1) + sides[:, 1]
    owner = np.tile(np.arange(len(triangles)), 3)
    order = np.argsort(keys, kind="stable")
    same = np.flatnonzero(keys[order][1:] == keys[order][:-1])
    a, b = owner[order][same], owner[order][same + 1]
    graph = sparse.coo_array((np.ones(len(a)), (a, b)), shape=(len(triangles), len(triangles)))
    return np.asarray(connected_components(graph, directed=False)[1], dtype=np.int64)


def _closed_lines(triangles: Ints) -> Iterator[Ints]:
    """The closed lines along which a piece of surface ends, with the surface to the left of the way."""
    sides = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    base = int(triangles.max()) + 1
    ends = sides[~np.isin(sides[:, 0] * base + sides[:, 1], sides[:, 1] * base + sides[:, 0])]
    onward: dict[int, list[int]] = {}
    for a, b in ends.tolist():
        onward.setdefault(a, []).append(b)
    while onward:
        start = next(iter(onward))
        line = [start]
        place: dict[int, int] = {start: 0}
        while True:
            following = onward.get(line[-1])
            if not following:
                break
            step = following.pop()
            if not following:
                del onward[line[-1]]
            if step in place:
                loop = line[place[step] :]
                for vertex in loop[1:]:
                    del place[vertex]
                del line[place[step] + 1 :]
                yield np.array(loop, dtype=np.int64)
                if not onward.get(step):
                    break
                continue
            place[step] = len(line)
            line.append(step)
        onward = {vertex: steps for vertex, steps in onward.items() if steps}


def _nearest_rim(
    near: _Neighbourhood, view: Floats, facing: float, kind: str, expected: Floats, outside: Floats
) -> Margin | None:
    """The rim that best agrees with where it is expected."""
    width = float(np.ptp(expected[:, 0]))
    tree = cKDTree(expected)
    best: Margin | None = None
    for line in near.rims(view, facing, outside):
        if len(line) < 6:
            continue
        places = near.vertices[line]
        if not WIDTHS[kind][0] * width < np.ptp(places[:, 0]) < WIDTHS[kind][1] * width:
            continue
        dense = _dense(places)
        misfit = float(nearest(cKDTree(dense), expected)[0].mean() + 0.7 * nearest(tree, dense)[0].mean())
        if misfit < (FARTHEST if best is None else best.misfit):
            found = _split(places, expected, misfit)
            best = best if found is None else found
    return best


def _dense(line: Floats, parts: int = 4) -> Floats:
    """Points on a closed line, some on every side."""
    ahead = np.roll(line, -1, axis=0)
    return np.concatenate([line + share * (ahead - line) for share in np.arange(parts) / parts])


def _split(line: Floats, expected: Floats, misfit: float) -> Margin | None:
    """A closed line cut at its corners: what runs to the subject's left is the upper edge."""
    way = expected[:, 0].argmax(), expected[:, 0].argmin()
    across = expected[way[0]] - expected[way[1]]
    along = line @ across
    right, left = int(along.argmin()), int(along.argmax())
    ahead = np.roll(line, -right, axis=0)
    place = (left - right) % len(line)
    upper = ahead[: place + 1]
    lower = np.vstack([ahead[place:], ahead[:1]])[::-1]
    return None if len(upper) < 2 or len(lower) < 2 else Margin(upper, lower, misfit)


def _with_inner_corner(near: _Neighbourhood, margin: Margin, side: float, expected: Floats, outside: Floats) -> Margin:
    """An eye's rim with its inner corner, which hides behind the nose's root, taken from a view more to the middle."""
    view = np.array([-0.3 * side, -1.0, 0.0])
    inner = _nearest_rim(near, view, FACINGS["eye"][0], "eye", expected, outside)
    if inner is None:
        return margin
    corner = inner.corner(-side)
    if np.linalg.norm(corner - margin.corner(-side)) > 9e-3:
        return margin
    at = 0 if side > 0.0 else -1
    upper, lower = margin.upper.copy(), margin.lower.copy()
    upper[at] = lower[at] = corner
    return Margin(upper, lower, margin.misfit)
