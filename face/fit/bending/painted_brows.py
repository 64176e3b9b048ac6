"""Brows that are painted on a face, or lie on it as pieces of their own: dark bands above the eyes."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeAlias

import numpy as np
from scipy.ndimage import gaussian_filter, gaussian_filter1d

from ....arrays import Bools, Floats, Ints
from .brow_lines import ASIDE, LINE_BLUR, LONGEST, PIXEL, SHORTEST, THICKEST, UP, Eye, brow_points

#: Points (N, 3) on the face in a box (least and greatest x, y, z), template coordinates, and their brightness (N,).
Look: TypeAlias = Callable[[Floats, Floats], tuple[Floats, Floats]]
#: How far behind the foremost point of its pixel a point still shows, metres of the template.
BEHIND = 6e-3
#: Blur of the picture, pixels.
BLUR = 1.2
#: What a step of the line up or down costs, share of the darkness of the darkest.
STEP_COST = 0.06
#: The skin is as bright as this share of all is at most.
SKIN = 0.7
#: A brow is darker than the skin by this share of it; it ends where it is less than this share of its own darkness.
DARK, END = 0.1, 0.4
#: Share of a brow's columns whose darkest place is not at the edge of the picture.
INSIDE = 0.8


def find_brows(positions: Floats, brightness: Floats, places: Mapping[str, Floats]) -> dict[str, Floats]:
    """Name -> (x, z) of the brows' feature points in template coordinates; none unless both brows show.

    Parameters
    ----------
    positions : (N, 3) points on the face, template coordinates.
    brightness : (N,) of them.
    places : name -> (3,) the eye corners.
    """
    return brow_points(places, lambda eye: _brow_line(eye, positions, brightness))


def _brow_line(eye: Eye, positions: Floats, brightness: Floats) -> Floats | None:
    """(N, 2) the middle line of a brow from its inner end to its outer one, or None where nothing looks like one."""
    picture = _picture(eye, positions, brightness)
    if picture is None:
        return None
    skin = float(np.quantile(picture, SKIN))
    dark = gaussian_filter(np.maximum(skin - picture, 0.0), BLUR)
    rows = _darkest_way(dark)
    depth = dark[rows, np.arange(dark.shape[1])]
    most = float(np.quantile(depth, 0.8))
    run = _longest_run(depth > END * most)
    chosen = rows[run]
    length = len(chosen) * PIXEL
    inside = ((chosen > 1) & (chosen < len(dark) - 2)).mean() if len(chosen) else 0.0
    if most < DARK * skin or not SHORTEST < length < LONGEST or inside < INSIDE:
        return None
    thick = np.array([_thickness(dark[:, column], row) for column, row in zip(run, chosen, strict=True)])
    if np.median(thick) * PIXEL > THICKEST:
        return None
    line = gaussian_filter1d(chosen.astype(np.float64), LINE_BLUR, mode="nearest")
    return np.column_stack([ASIDE[0] + (run + 0.5) * PIXEL, UP[0] + (line + 0.5) * PIXEL])


def _picture(eye: Eye, positions: Floats, brightness: Floats) -> Floats | None:
    """(rows upward, columns outward) mean brightness above an eye, or None where too little of it is seen."""
    local = eye.local(positions[:, [0, 2]])
    columns, rows = (round((high - low) / PIXEL) for low, high in (ASIDE, UP))
    column = np.floor((local[:, 0] - ASIDE[0]) / PIXEL).astype(np.int64)
    row = np.floor((local[:, 1] - UP[0]) / PIXEL).astype(np.int64)
    inside = (column >= 0) & (column < columns) & (row >= 0) & (row < rows)
    pixel, depth, bright = (row * columns + column)[inside], positions[inside, 1], brightness[inside]
    nearest = np.full(rows * columns, np.inf)
    np.minimum.at(nearest, pixel, depth)
    shown = depth <= nearest[pixel] + BEHIND
    count = np.bincount(pixel[shown], minlength=rows * columns)
    if (count > 0).mean() < INSIDE:
        return None
    total = np.bincount(pixel[shown], bright[shown], minlength=rows * columns)
    known = (count > 0).astype(np.float64).reshape(rows, columns)
    mean = (total / np.maximum(count, 1)).reshape(rows, columns)
    filled = gaussian_filter(mean * known, 2.0) / np.maximum(gaussian_filter(known, 2.0), 1e-9)
    return np.where(known > 0.0, mean, filled)


def _darkest_way(dark: Floats) -> Ints:
    """(columns,) the row in each column of the darkest way from one side to the other that does not jump."""
    cost = STEP_COST * float(dark.max())
    best, came = dark[:, 0], []
    for column in dark.T[1:]:
        options = np.stack([np.append(-np.inf, best[:-1]) - cost, best, np.append(best[1:], -np.inf) - cost])
        choice = options.argmax(axis=0)
        came.append(choice - 1)
        best = options.max(axis=0) + column
    way = [int(best.argmax())]
    for steps in came[::-1]:
        way.append(way[-1] + int(steps[way[-1]]))
    return np.array(way[::-1])


def _longest_run(chosen: Bools) -> Ints:
    """Places of the longest run of true ones."""
    ends = np.flatnonzero(np.diff(np.concatenate([[0], chosen.astype(np.int64), [0]])))
    if len(ends) == 0:
        return np.zeros(0, dtype=np.int64)
    starts, stops = ends[::2], ends[1::2]
    longest = int((stops - starts).argmax())
    return np.arange(starts[longest], stops[longest])


def _thickness(column: Floats, row: int) -> int:
    """How many pixels round a row are half as dark as it is."""
    half = column >= column[row] / 2.0
    below, above = half[: row + 1][::-1], half[row:]
    return int(np.append(~below, True).argmax() + np.append(~above, True).argmax() - 1)
