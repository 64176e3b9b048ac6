"""The coarse search: where in a mesh does the front look like a face, for any direction and size?

A picture of depths is taken along many directions that lie in a plane of symmetry, in many sizes; the template's
picture slides over each of them along the plane. Both sides of the plane are folded onto one another.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from ....arrays import Floats, Ints
from ..surface.cloud import Cloud
from ..surface.symmetry import SymmetryPlane
from ..template.template import fit_template
from .head_pose import HeadPose

#: Pixels of 8 mm; the template's picture is 8 columns beside the plane and 22 rows from this height up.
PIXEL, COLUMNS, ROWS, BOTTOM = 8e-3, 8, 22, -88e-3
#: Only what lies in front of this belongs to the picture.
PICTURE_FRONT = -62e-3
#: Middle of the face, which counts twice: within this of the plane, between these heights.
MIDDLE, MIDDLE_BOTTOM, MIDDLE_TOP = 50e-3, -70e-3, 65e-3
#: Directions round the plane's normal, and the ratio between sizes.
TURNS, SIZE_STEP = 30, 1.15
#: The mesh's diagonal over 0.75 is assumed to measure between these, metres of a real person.
LENGTHS = (0.105, 2.6)
#: Points per pixel that make a picture without holes.
DENSITY = 5.0
#: What a missing pixel costs, and the most that a wrong depth costs, metres; the least coverage.
MISSING, CLIP, COVERAGE = 9e-3, 15e-3, 0.7
#: How much more a guess costs that has nothing of a face's relief, as a share.
SMOOTH_COST = 0.6
#: How many guesses of each size are looked at twice, how many are returned in all.
SHORTLIST, GUESSES = 14, 12
#: Windows that start within so many rows of each other are one.
NEAR_ROWS = 3
#: Guesses that differ by less than these are one: metres, ratio, cosine.
SAME_PLACE, SAME_SIZE, SAME_COSINE = 25e-3, 1.5, 0.7


@dataclass(frozen=True)
class Guess:
    """A place where a face may be: the better, the smaller its `cost` in metres."""

    pose: HeadPose
    cost: float


@dataclass(frozen=True, eq=False)
class _Picture:
    """The template's depths (ROWS, COLUMNS) and weights; weight 0 where it has none."""

    depth: Floats
    weight: Floats


@dataclass(frozen=True, eq=False)
class _View:
    """One window of one picture: axes (3, 3), size, where the template's origin lies across the picture."""

    axes: Floats
    size: float
    plane: SymmetryPlane
    height: float
    depth: Floats


@dataclass(frozen=True, eq=False)
class _Pictures:
    """The pictures of one size along every direction round a plane's normal.

    Attributes
    ----------
    depth : (TURNS, R, COLUMNS) less `middle`; 0 where nothing is seen. Rows past the end of a picture are empty.
    known : the same, 1 where something is seen.
    middle : (TURNS,) mean depth.
    lowest : (TURNS,) height of the lowest row.
    rows : (TURNS,) how many rows each picture has.
    """

    depth: Floats
    known: Floats
    middle: Floats
    lowest: Floats
    rows: Ints


def search_plane(
    cloud: Cloud, area: float, diagonal: float, plane: SymmetryPlane, *, lengths: tuple[float, float] = LENGTHS
) -> list[Guess]:
    """The best guesses with one plane of symmetry, best first.

    Parameters
    ----------
    cloud : points spread over the mesh.
    area : the mesh's area, in square units of the mesh.
    diagonal : of the mesh's bounding box.
    plane : the plane of symmetry, through the face's middle.
    lengths : what 0.75 of the diagonal may measure, metres of a real person.
    """
    aside = np.abs(cloud.positions @ plane.normal - plane.offset)
    order = np.argsort(aside)
    positions, aside = cloud.positions[order], aside[order]
    views: list[_View] = []
    fronts = _fronts(plane.normal)
    for size in _sizes(diagonal, lengths):
        density = len(positions) / area * (PIXEL * size) ** 2
        stride = max(1, int(density / DENSITY))
        count = int(np.searchsorted(aside, COLUMNS * PIXEL * size))
        near, near_aside = positions[:count:stride], aside[:count:stride]
        if len(near) < ROWS * COLUMNS:
            continue
        views += _best_views(near, near_aside, plane, fronts, size)
    return _distinct(_judged(views))


def best_guesses(guesses: list[Guess]) -> list[Guess]:
    """The best distinct guesses of several planes."""
    return _distinct(sorted(guesses, key=lambda guess: guess.cost))


def _sizes(diagonal: float, lengths: tuple[float, float]) -> Floats:
    """Mesh units per metre to try."""
    length = 0.75 * diagonal
    count = int(np.ceil(np.log(lengths[1] / lengths[0]) / np.log(SIZE_STEP))) + 1
    return np.asarray(length / lengths[1] * SIZE_STEP ** np.arange(count), dtype=np.float64)


def _fronts(normal: Floats) -> Floats:
    """(TURNS, 3) unit vectors round a normal."""
    first = np.cross(normal, np.eye(3)[np.abs(normal).argmin()])
    first /= np.linalg.norm(first)
    second = np.cross(normal, first)
    angle = 2.0 * np.pi * np.arange(TURNS)[:, None] / TURNS
    return np.asarray(np.cos(angle) * first + np.sin(angle) * second, dtype=np.float64)


def _best_views(positions: Floats, aside: Floats, plane: SymmetryPlane, fronts: Floats, size: float) -> list[_View]:
    """Of all directions, both ways up, the windows of one size that best agree with the template; at most `SHORTLIST`.

    From each picture at most two are taken, so that one direction does not crowd out the others.
    """
    ups = np.cross(plane.normal, fronts)
    pictures = _pictures(positions, aside, fronts, ups, size)
    costs = np.stack([_quick_costs(pictures, _template_picture(upright=upright)) for upright in (True, False)], axis=1)
    first = costs.argmin(axis=2)
    beside = np.abs(np.arange(costs.shape[2]) - first[:, :, None]) <= NEAR_ROWS
    others = np.where(beside, np.inf, costs)
    starts = np.stack([first, others.argmin(axis=2)], axis=2)
    lowest = np.stack([costs.min(axis=2), others.min(axis=2)], axis=2)
    best = np.argsort(lowest, axis=None, kind="stable")[:SHORTLIST]
    best = best[np.isfinite(lowest.ravel()[best])]
    views = []
    for turn, way, rank in zip(*np.unravel_index(best, lowest.shape), strict=True):
        start, sense = int(starts[turn, way, rank]), 1 - 2 * int(way)
        part = slice(start, start + ROWS)
        seen = np.where(pictures.known[turn, part] > 0.0, pictures.depth[turn, part], np.nan)
        edge = start * PIXEL - BOTTOM if sense > 0 else (start + ROWS) * PIXEL + BOTTOM
        axes = np.array([np.cross(-fronts[turn], sense * ups[turn]), -fronts[turn], sense * ups[turn]])
        height = sense * float(pictures.lowest[turn] + edge)
        views.append(_View(axes, size, plane, height, seen[::sense] + pictures.middle[turn]))
    return views


def _pictures(positions: Floats, aside: Floats, fronts: Floats, ups: Floats, size: float) -> _Pictures:
    """What is seen along each of some directions (TURNS, 3): the nearest depth in each pixel, both sides folded."""
    height = ups @ positions.T / size
    lowest = height.min(axis=1) - 6.0 * PIXEL
    row = ((height - lowest[:, None]) / PIXEL).astype(np.int64)
    rows = np.maximum(row.max(axis=1) + 7, ROWS)
    shape = (len(fronts), int(rows.max()), COLUMNS)
    column = np.minimum((aside / (PIXEL * size)).astype(np.int64), COLUMNS - 1)
    pixel = (np.arange(shape[0])[:, None] * shape[1] + row) * shape[2] + column
    nearest = np.full(np.prod(shape), np.inf)
    np.minimum.at(nearest, pixel.ravel(), (-(fronts @ positions.T) / size).ravel())
    nearest = nearest.reshape(shape)
    known = np.isfinite(nearest)
    middle = np.where(known, nearest, 0.0).sum(axis=(1, 2)) / known.sum(axis=(1, 2))
    depth = np.where(known, nearest - middle[:, None, None], 0.0)
    return _Pictures(depth, known.astype(np.float64), middle, lowest, rows)


def _quick_costs(pictures: _Pictures, template: _Picture) -> Floats:
    """(TURNS, W) root mean squared difference in depth of every window, its mean offset taken out."""
    weight, model = template.weight, template.depth
    known, depth = pictures.known, pictures.depth
    share, seen, seen_squared = (_slid(known, weight * model**power) for power in range(3))
    level, product = (_slid(depth, weight * model**power) for power in range(2))
    safe = np.maximum(share, 1e-12)
    offset = (level - seen) / safe
    square = (_slid(depth * depth, weight) - 2.0 * product + seen_squared) / safe
    share = share / weight.sum()
    cost = share * np.maximum(square - offset**2, 0.0) + (1.0 - share) * MISSING**2
    inside = np.arange(cost.shape[1]) <= (pictures.rows - ROWS)[:, None]
    return np.where(inside & (share >= COVERAGE), np.sqrt(cost), np.inf)


def _slid(pictures: Floats, window: Floats) -> Floats:
    """(TURNS, W) sums of pictures (TURNS, R, COLUMNS) times a window (ROWS, COLUMNS) that slides along their rows."""
    products = pictures @ window.T
    count = pictures.shape[1] - ROWS + 1
    return np.asarray(sum(products[:, row : row + count, row] for row in range(ROWS)))


def _judged(views: list[_View]) -> list[Guess]:
    """The guesses of some windows by mean clipped difference, best first."""
    if not views:
        return []
    template = _template_picture(upright=True)
    weight = template.weight / template.weight.sum()
    difference = np.array([view.depth for view in views]) - template.depth
    difference[:, template.weight == 0.0] = np.nan
    flat = difference.reshape(len(views), -1)
    offset = np.nanmedian(flat, axis=1)
    for _ in range(2):
        near = np.abs(flat - offset[:, None]) < CLIP
        offset = np.where(near, flat, 0.0).sum(axis=1) / np.maximum(near.sum(axis=1), 1)
    cost = np.minimum(np.abs(flat - offset[:, None]), CLIP)
    cost = np.where(np.isnan(cost), MISSING, cost) @ weight.ravel()
    cost = cost * (1.0 + SMOOTH_COST * (1.0 - _likeness(flat, offset, template)))
    guesses = [
        Guess(_pose(view, float(away)), float(price)) for view, away, price in zip(views, offset, cost, strict=True)
    ]
    return sorted((guess for guess in guesses if np.isfinite(guess.cost)), key=lambda guess: guess.cost)


def _likeness(difference: Floats, offset: Floats, template: _Picture) -> Floats:
    """Correlation of each window with the template once both are freed of what is smooth: eyes, nose, mouth remain.

    Parameters
    ----------
    difference : (N, P) depth less the template's; NaN where either is missing.
    offset : (N,) mean of that.
    """
    row, column = np.indices((ROWS, COLUMNS)).reshape(2, -1) / ROWS - 0.5
    column = column + 0.5
    smooth = np.column_stack([np.ones_like(row), row, row**2, column**2, row * column**2])
    used = template.weight.ravel() > 0.0
    basis, _ = np.linalg.qr(smooth[used])
    known = np.isfinite(difference[:, used])
    own = template.depth.ravel()[used]
    seen = np.where(known, difference[:, used] - offset[:, None], 0.0) + own
    own = own - basis @ (basis.T @ own)
    seen = np.where(known, seen - seen @ basis @ basis.T, 0.0)
    size = np.linalg.norm(seen, axis=1) * np.linalg.norm(np.where(known, own, 0.0), axis=1)
    return np.asarray(seen @ own / np.maximum(size, 1e-12), dtype=np.float64)


def _pose(view: _View, away: float) -> HeadPose:
    """The placement of a window whose depths lie `away` behind the template's."""
    normal = view.plane.normal
    local = view.size * (view.height * view.axes[2] + away * view.axes[1])
    return HeadPose(view.axes, local + view.plane.offset * normal, np.full(3, view.size))


def _distinct(guesses: list[Guess]) -> list[Guess]:
    """The first `GUESSES` that differ from one another."""
    kept: list[Guess] = []
    for guess in guesses:
        if len(kept) == GUESSES:
            break
        if not any(_same(guess.pose, other.pose) for other in kept):
            kept.append(guess)
    return kept


def _same(a: HeadPose, b: HeadPose) -> bool:
    """Whether two poses are one guess."""
    ratio = a.size / b.size
    near = np.linalg.norm(a.origin - b.origin) < SAME_PLACE * b.size
    return bool(near and 1.0 / SAME_SIZE < ratio < SAME_SIZE and np.trace(a.axes @ b.axes.T) > 1.0 + 2.0 * SAME_COSINE)


@lru_cache(maxsize=2)
def _template_picture(*, upright: bool) -> _Picture:
    """The template's folded picture; upside down unless `upright`."""
    cloud = fit_template().cloud.positions
    column = (np.abs(cloud[:, 0]) / PIXEL).astype(np.int64)
    row = np.floor((cloud[:, 2] - BOTTOM) / PIXEL).astype(np.int64)
    inside = (column < COLUMNS) & (row >= 0) & (row < ROWS)
    nearest = np.full(ROWS * COLUMNS, np.inf)
    np.minimum.at(nearest, row[inside] * COLUMNS + column[inside], cloud[inside, 1])
    depth = nearest.reshape(ROWS, COLUMNS)
    across = (np.arange(COLUMNS) + 0.5) * PIXEL
    up = (np.arange(ROWS) + 0.5) * PIXEL + BOTTOM
    weight = np.where((across < MIDDLE) & (up > MIDDLE_BOTTOM)[:, None] & (up < MIDDLE_TOP)[:, None], 1.0, 0.5)
    weight[~(depth < PICTURE_FRONT)] = 0.0
    depth = np.where(weight > 0.0, depth, 0.0)
    return _Picture(depth, weight) if upright else _Picture(depth[::-1], weight[::-1])
