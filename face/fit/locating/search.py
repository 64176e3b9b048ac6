"""The coarse search: where in a mesh does the front look like a face, for any direction and size?

A picture of depths is taken along many directions that lie in a plane of symmetry, in many sizes; the template's
picture slides over each of them along the plane. Both sides of the plane are folded onto one another.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from ....arrays import Floats
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
    cost: float


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
    for size in _sizes(diagonal, lengths):
        density = len(positions) / area * (PIXEL * size) ** 2
        stride = max(1, int(density / DENSITY))
        count = int(np.searchsorted(aside, COLUMNS * PIXEL * size))
        near, near_aside = positions[:count:stride], aside[:count:stride]
        if len(near) < ROWS * COLUMNS:
            continue
        of_size = [
            view for front in _fronts(plane.normal) for view in _best_windows(near, near_aside, plane, front, size)
        ]
        views += sorted(of_size, key=lambda view: view.cost)[:SHORTLIST]
    return _distinct(_judged(views))


def best_guesses(guesses: list[Guess]) -> list[Guess]:
    """The best distinct guesses of several planes."""
    return _distinct(sorted(guesses, key=lambda guess: guess.cost))


def _sizes(diagonal: float, lengths: tuple[float, float]) -> Floats:
    """Mesh units per metre to try."""
    length = 0.75 * diagonal
    count = int(np.ceil(np.log(lengths[1] / lengths[0]) / np.log(SIZE_STEP))) + 1
    return np.asarray(length / lengths[1] * SIZE_STEP ** np.arange(count), dtype=np.float64)


def _fronts(normal: Floats) -> Iterator[Floats]:
    """Unit vectors round a normal."""
    first = np.cross(normal, np.eye(3)[np.abs(normal).argmin()])
    first /= np.linalg.norm(first)
    second = np.cross(normal, first)
    for angle in 2.0 * np.pi * np.arange(TURNS) / TURNS:
        yield np.cos(angle) * first + np.sin(angle) * second


def _best_windows(
    positions: Floats, aside: Floats, plane: SymmetryPlane, front: Floats, size: float
) -> Iterator[_View]:
    """For both ways up, the windows of one picture that best agree with the template."""
    up = np.cross(plane.normal, front)
    column = np.minimum((aside / (PIXEL * size)).astype(np.int64), COLUMNS - 1)
    height = positions @ up / size
    lowest = float(height.min()) - 6.0 * PIXEL
    row = ((height - lowest) / PIXEL).astype(np.int64)
    rows = max(int(row.max()) + 7, ROWS)
    nearest = np.full(rows * COLUMNS, np.inf)
    np.minimum.at(nearest, row * COLUMNS + column, -(positions @ front) / size)
    picture = nearest.reshape(rows, COLUMNS)
    known = np.isfinite(picture)
    middle = float(picture[known].mean())
    depth = np.where(known, picture - middle, 0.0)
    windows = [
        sliding_window_view(layer, (ROWS, COLUMNS)).reshape(rows - ROWS + 1, ROWS * COLUMNS)
        for layer in (known.astype(np.float64), depth, depth * depth)
    ]
    for sense in (1.0, -1.0):
        costs = _quick_costs(windows, _template_picture(upright=sense > 0.0))
        for first in _lowest_two(costs):
            seen = np.where(known, depth, np.nan)[first : first + ROWS]
            bottom = lowest + first * PIXEL - BOTTOM if sense > 0.0 else lowest + (first + ROWS) * PIXEL + BOTTOM
            axes = np.array([np.cross(-front, sense * up), -front, sense * up])
            yield _View(axes, size, plane, sense * bottom, seen[:: int(sense)] + middle, float(costs[first]))


def _lowest_two(costs: Floats) -> list[int]:
    """Places of the lowest finite cost, and of the lowest that is not beside it."""
    first = int(costs.argmin())
    if not np.isfinite(costs[first]):
        return []
    others = costs.copy()
    others[max(0, first - 3) : first + 4] = np.inf
    second = int(others.argmin())
    return [first, second] if np.isfinite(others[second]) else [first]


def _quick_costs(windows: list[Floats], template: _Picture) -> Floats:
    """Root mean squared difference in depth of every window, its mean offset taken out."""
    known, depth, squared = windows
    weight, model = template.weight.ravel(), template.depth.ravel()
    share = known @ weight
    safe = np.maximum(share, 1e-12)
    offset = (depth @ weight - known @ (weight * model)) / safe
    square = (squared @ weight - 2.0 * depth @ (weight * model) + known @ (weight * model**2)) / safe
    share = share / weight.sum()
    cost = share * np.maximum(square - offset**2, 0.0) + (1.0 - share) * MISSING**2
    return np.where(share >= COVERAGE, np.sqrt(cost), np.inf)


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
