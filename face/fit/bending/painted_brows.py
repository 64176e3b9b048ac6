"""Brows that are painted on a face, or lie on it as pieces of their own: dark bands above the eyes."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from scipy.ndimage import gaussian_filter, gaussian_filter1d

from ....arrays import Bools, Floats, Ints

#: Points (N, 3) on the face in a box (least and greatest x, y, z), template coordinates, and their brightness (N,).
Look: TypeAlias = Callable[[Floats, Floats], tuple[Floats, Floats]]
#: Where brows are sought: from the inner eye corner, towards the ear and upwards, shares of the eyes' width; the width
#: of a pixel; how far behind the foremost point of its pixel a point still shows, metres of the template.
ASIDE, UP, PIXEL, BEHIND = (-0.2, 0.6), (0.1, 0.44), 0.012, 6e-3
#: Blur of the picture, and of the brow's line, pixels.
BLUR, LINE_BLUR = 1.2, 3.0
#: What a step of the line up or down costs, share of the darkness of the darkest.
STEP_COST = 0.06
#: The skin is as bright as this share of all is at most.
SKIN = 0.7
#: A brow is darker than the skin by this share of it; it ends where it is less than this share of its own darkness.
DARK, END = 0.1, 0.4
#: Shortest, longest and thickest brow; how far that of one side may lie above that of the other; shares of the width.
SHORTEST, LONGEST, THICKEST, UNEVEN = 0.22, 0.7, 0.17, 0.06
#: Where brows usually arch, share of their length, and how firmly that is believed of straight ones.
ARCH, ARCH_COST = 0.6, 0.06
#: Share of a brow's columns whose darkest place is not at the edge of the picture.
INSIDE = 0.8


@dataclass(frozen=True, eq=False)
class _Eye:
    """An eye: its inner corner (x, z) and the direction towards the ear, in the picture; the width of both eyes."""

    inner: Floats
    outward: Floats
    width: float

    def local(self, places: Floats) -> Floats:
        """(N, 2) how far places (N, 2) of the picture lie towards the ear and upwards, shares of the width."""
        up = self.upward()
        return np.column_stack([(places - self.inner) @ self.outward, (places - self.inner) @ up]) / self.width

    def place(self, aside: float, up: float) -> Floats:
        """(2,) the other way."""
        return np.asarray(self.inner + self.width * (aside * self.outward + up * self.upward()))

    def upward(self) -> Floats:
        """(2,) at a right angle to the way outward."""
        x, z = self.outward
        return np.asarray(np.array([-z, x]) * np.sign(x), dtype=np.float64)


def box_of_brows(places: Mapping[str, Floats]) -> tuple[Floats, Floats]:
    """Least and greatest (3,) of the box that brows are sought in, from the eye corners, template coordinates."""
    corners = np.array([places[name] for name in ("3.7", "3.11", "3.8", "3.12")])
    width = float(np.linalg.norm(places["3.7"] - places["3.12"]))
    low = corners.min(axis=0) - width * np.array([0.35, 0.6, 0.0])
    high = corners.max(axis=0) + width * np.array([0.35, 0.4, UP[1] + 0.1])
    return low, high


def find_brows(positions: Floats, brightness: Floats, places: Mapping[str, Floats]) -> dict[str, Floats]:
    """Name -> (x, z) of the brows' feature points in template coordinates; none unless both brows show.

    Parameters
    ----------
    positions : (N, 3) points on the face, template coordinates.
    brightness : (N,) of them.
    places : name -> (3,) the eye corners.
    """
    picture = [0, 2]
    width = float(np.linalg.norm(places["3.7"] - places["3.12"]))
    across = (places["3.7"] - places["3.12"])[picture]
    across /= np.linalg.norm(across)
    found: dict[str, tuple[float, float]] = {}
    brows = []
    for inner, outward, names in (("3.11", across, ("4.1", "4.3", "4.5")), ("3.8", -across, ("4.2", "4.4", "4.6"))):
        eye = _Eye(places[inner][picture], outward, width)
        line = _brow_line(eye, positions, brightness)
        if line is None:
            return {}
        brows.append(line)
        top = line[_uppermost(line)]
        for name, (aside, up) in zip(names, (line[0], top, line[-1]), strict=True):
            found[name] = tuple(eye.place(float(aside), float(up)))
    if abs(brows[0][:, 1].mean() - brows[1][:, 1].mean()) > UNEVEN:
        return {}
    return {name: np.array(place) for name, place in found.items()}


def _uppermost(line: Floats) -> int:
    """The highest place of a brow's line; of a straight one that where brows usually arch."""
    share = np.linspace(0.0, 1.0, len(line))
    return int((line[:, 1] - ARCH_COST * (share - ARCH) ** 2).argmax())


def _brow_line(eye: _Eye, positions: Floats, brightness: Floats) -> Floats | None:
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


def _picture(eye: _Eye, positions: Floats, brightness: Floats) -> Floats | None:
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
