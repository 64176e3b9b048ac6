"""Where lids and lips end: among the rims of the skin, those of the eyes and the mouth."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from ....arrays import Floats, Ints
from ....progress import Progress, Work
from .cloud import Surface, nearest, sample
from .rims import Neighbourhood

#: A rim is taken for an opening's when its mean distance from where it is expected stays below, metres; mouths gape.
FARTHEST = {"eye": 17e-3, "mouth": 20e-3}
#: One eye alone is believed from here on only, metres.
FARTHEST_ALONE = 10e-3
#: What an eye's opening that is e times larger or smaller than expected counts as, in distance: folds beside lids are
#: thin; and the most that this may be, metres.
UNLIKE, MOST_UNLIKE = 3e-3, 6e-3
#: Share of the distance between one eye's corners and the other's mirrored ones that counts.
UNEVEN = 0.5
#: Narrowest and widest rim, times the expected width.
WIDTHS = {"eye": (0.5, 1.8), "mouth": (0.5, 1.5)}
#: Reach round the opening, metres; least outwardness of a face, the first being the usual one.
REACH = {"eye": 32e-3, "mouth": 48e-3}
FACINGS = {"eye": (0.3, 0.1, 0.45), "mouth": (0.2, 0.05, 0.4)}
#: Another outwardness than the usual one has to be nearer by this, metres.
UNUSUAL = 0.5e-3
#: The inner corner of an eye may lie this far beyond the rim seen from the front, metres.
CORNER_REACH = 9e-3
#: The corners of a mouth, and the outer one of an eye, lie this near to the ends of the rim, metres.
CORNER_END = 2e-3
#: Lips whose ends differ in depth by more than this are levelled, as far as this, metres; points it is done with.
LEVEL, LEVEL_REACH, LIP_POINTS = 1.0e-3, 5e-3, 12_000
#: A mouth whose inside reaches no deeper than this is no opening but a crease, or filled with skin; metres.
SHALLOW = 6e-3
#: A rim round an area below this share of its width's square, with no more than this behind it, metres, is no eye's:
#: it is the fold of an upper lid over an eye that is one surface with it.
FOLD, FOLD_DEPTH = 0.06, 2e-3

#: What is said meanwhile.
SOUGHT = "Fitting lids and lips"


@dataclass(frozen=True, eq=False)
class Expected:
    """Where the template's rim (N, 3), and its skin round the opening (M, 3), lie now."""

    margin: Floats
    outside: Floats


@dataclass(frozen=True, eq=False)
class Margin:
    """The rim of an opening, from its corner on the subject's right along the upper edge.

    Attributes
    ----------
    upper : (U, 3) from the corner at the smallest x to that at the largest.
    lower : (L, 3) between the same corners.
    misfit : mean distance from where it was expected, metres, and what an unexpected size counts as.
    """

    upper: Floats
    lower: Floats
    misfit: float

    def line(self) -> Floats:
        """(N, 3) the whole rim as a closed line."""
        return np.concatenate([self.upper, self.lower[-2:0:-1]])

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


def find_mouth(surface: Surface, expected: Expected) -> Work[Margin | None]:
    """Where the lips meet, or None where the mouth has no opening.

    Parameters
    ----------
    surface : the head in template coordinates, normals outward.
    expected : where the template's lips lie now.
    """
    near = Neighbourhood(surface, expected.margin.mean(axis=0), REACH["mouth"])
    view = np.array([0.0, -1.0, 0.0])
    found = yield from _candidates(near, view, "mouth", expected, FACINGS["mouth"])
    if not found:
        return None
    best = min(found, key=lambda margin: margin.misfit)
    return _met(_levelled(best, near), expected, right=True, left=True)


def find_eyes(surface: Surface, expected: Mapping[str, Expected]) -> Work[dict[str, Margin]]:
    """The lid margins that are found: of each eye the rim that is near to where it is expected and like the other's.

    Parameters
    ----------
    surface : the head in template coordinates, normals outward.
    expected : "eye_l", "eye_r": where the template's lids lie now.
    """
    near, found = dict[str, Neighbourhood](), dict[str, list[Margin]]()
    for name, eye in expected.items():
        near[name] = Neighbourhood(surface, eye.margin.mean(axis=0), REACH["eye"])
        found[name] = yield from _candidates(near[name], _view(name, 0.25), "eye", eye, FACINGS["eye"])
    chosen = _pair(found["eye_l"], found["eye_r"])
    eyes = {}
    for name, margin in chosen.items():
        met = _met(margin, expected[name], right=name == "eye_r", left=name == "eye_l")
        eyes[name] = yield from _with_inner_corner(near[name], met, name, expected[name])
    return eyes


def _view(eye: str, outward: float) -> Floats:
    """The direction toward a viewer of an eye who stands to its outer side."""
    return np.array([outward if eye == "eye_l" else -outward, -1.0, 0.0])


def _pair(left: list[Margin], right: list[Margin]) -> dict[str, Margin]:
    """The best pair of rims, or the best one alone."""
    if left and right:
        pairs = [(a.misfit + b.misfit + UNEVEN * _unevenness(a, b), a, b) for a in left for b in right]
        _, a, b = min(pairs, key=lambda pair: pair[0])
        return {"eye_l": a, "eye_r": b}
    alone = [
        (name, min(side, key=lambda margin: margin.misfit))
        for name, side in (("eye_l", left), ("eye_r", right))
        if side
    ]
    return {name: margin for name, margin in alone if margin.misfit < FARTHEST_ALONE}


def _unevenness(left: Margin, right: Margin) -> float:
    """Mean distance between one eye's corners and the other's mirrored ones, metres."""
    flip = np.array([-1.0, 1.0, 1.0])
    ways = [left.corner(sign) - flip * right.corner(-sign) for sign in (1.0, -1.0)]
    return float(np.linalg.norm(ways, axis=1).mean())


def _candidates(
    near: Neighbourhood, view: Floats, kind: str, expected: Expected, facings: tuple[float, ...]
) -> Work[list[Margin]]:
    """The rims that may be an opening's."""
    width = float(np.ptp(expected.margin[:, 0]))
    tree = cKDTree(expected.margin)
    found: list[Margin] = []
    for number, facing in enumerate(facings):
        yield Progress(number / len(facings), SOUGHT)
        for line in near.rims(view, facing, expected.outside):
            places = near.vertices[line]
            if len(line) < 6 or not WIDTHS[kind][0] * width < np.ptp(places[:, 0]) < WIDTHS[kind][1] * width:
                continue
            dense = _dense(places)
            misfit = float(nearest(cKDTree(dense), expected.margin)[0].mean() + 0.7 * nearest(tree, dense)[0].mean())
            if misfit > FARTHEST[kind] or (kind == "eye" and _is_fold(near, line)):
                continue
            misfit += _unlikeness(places, expected.margin) if kind == "eye" else 0.0
            margin = _split(places, expected.margin, misfit + (UNUSUAL if number else 0.0))
            if margin is not None and (kind == "eye" or near.depth_behind(line) > SHALLOW):
                found.append(margin)
    return found


def _is_fold(near: Neighbourhood, line: Ints) -> bool:
    """Whether a closed line of vertices is a fold of one surface; behind lids that are all but shut lies an eye."""
    places = near.vertices[line]
    is_thin = abs(_area(places)) < FOLD * float(np.ptp(places[:, 0])) ** 2
    return is_thin and near.depth_behind(line) < FOLD_DEPTH


def _unlikeness(line: Floats, expected: Floats) -> float:
    """How much a rim's area, seen from the front, differs from what is expected, as a distance."""
    areas = [max(abs(_area(rim)), 1e-7) for rim in (line, expected)]
    return min(UNLIKE * abs(float(np.log(areas[0] / areas[1]))), MOST_UNLIKE)


def _area(line: Floats) -> float:
    """Area within a closed line, seen from the front."""
    x, z = line[:, 0], line[:, 2]
    return float((x * np.roll(z, -1) - np.roll(x, -1) * z).sum() / 2.0)


def _dense(line: Floats, parts: int = 4) -> Floats:
    """Points on a closed line, some on every side."""
    ahead = np.roll(line, -1, axis=0)
    return np.concatenate([line + share * (ahead - line) for share in np.arange(parts) / parts])


def _split(line: Floats, expected: Floats, misfit: float) -> Margin | None:
    """A closed line cut at its ends."""
    along = line @ _way(expected)
    return _cut(line, int(along.argmin()), int(along.argmax()), misfit)


def _way(expected: Floats) -> Floats:
    """(3,) unit vector from an opening's right corner to its left one."""
    across = expected[expected[:, 0].argmax()] - expected[expected[:, 0].argmin()]
    return np.asarray(across / np.linalg.norm(across))


def _cut(line: Floats, right: int, left: int, misfit: float) -> Margin | None:
    """A closed line cut at its corners: what runs to the subject's left is the upper edge."""
    ahead = np.roll(line, -right, axis=0)
    place = (left - right) % len(line)
    upper = ahead[: place + 1]
    lower = np.vstack([ahead[place:], ahead[:1]])[::-1]
    return None if len(upper) < 2 or len(lower) < 2 else Margin(upper, lower, misfit)


def _met(margin: Margin, expected: Expected, *, right: bool, left: bool) -> Margin:
    """A rim with corners where it lies deepest near its ends: there lids, or lips, meet."""
    line = margin.line()
    along = line @ _way(expected.margin)
    ends = []
    for reach, is_met in ((-along, right), (along, left)):
        near_end = np.flatnonzero(reach > reach.max() - (CORNER_END if is_met else 0.0) - 1e-9)
        ends.append(int(near_end[line[near_end, 1].argmax()]))
    return _cut(line, ends[0], ends[1], margin.misfit) or margin


def _with_inner_corner(near: Neighbourhood, margin: Margin, eye: str, expected: Expected) -> Work[Margin]:
    """An eye's rim with its inner corner, which hides behind the nose's root, taken from a view more to the middle."""
    side = 1.0 if eye == "eye_l" else -1.0
    inner = yield from _candidates(near, _view(eye, -0.3), "eye", expected, FACINGS["eye"][:1])
    if not inner:
        return margin
    tree = cKDTree(_dense(margin.line()))
    corner = min(inner, key=lambda other: nearest(tree, other.line())[0].mean()).corner(-side)
    if np.linalg.norm(corner - margin.corner(-side)) > CORNER_REACH:
        return margin
    at = 0 if side > 0.0 else -1
    upper, lower = margin.upper.copy(), margin.lower.copy()
    upper[at] = lower[at] = corner
    return Margin(upper, lower, margin.misfit)


def _levelled(margin: Margin, near: Neighbourhood) -> Margin:
    """A mouth whose lips end at the same depth: one that rolls in farther is cut where the other ends."""
    points = sample(Surface(near.vertices, near.triangles, np.zeros_like(near.vertices)), LIP_POINTS)
    outward = points.positions[near.normals[points.triangles, 1] < 0.0]
    edges = []
    for line, other, up in ((margin.upper, margin.lower, 1.0), (margin.lower, margin.upper, -1.0)):
        order = np.argsort(other[:, 0])
        depth = np.interp(line[:, 0], other[order, 0], other[order, 1])
        edge = line.copy()
        for number in 1 + np.flatnonzero((line[:, 1] > depth + LEVEL)[1:-1]):
            place = line[number]
            away = outward - place
            allowed = (outward[:, 1] <= depth[number]) & (up * away[:, 2] > 0.0) & (np.abs(away[:, 0]) < LEVEL)
            distance = np.where(allowed, np.linalg.norm(away, axis=1), np.inf)
            if distance.min() < LEVEL_REACH:
                edge[number] = outward[distance.argmin()]
        edges.append(edge)
    return Margin(edges[0], edges[1], margin.misfit)
