"""Brows that are modelled: strips, boxes or cards of hair that lie on the face as pieces of their own."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from scipy import sparse
from scipy.ndimage import gaussian_filter1d
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from ....arrays import Bools, Floats, Ints
from ..surface.cloud import Surface, sample
from .brow_lines import ASIDE, LINE_BLUR, LONGEST, PIXEL, SHORTEST, THICKEST, UP, Eye, box_of_brows, brow_points

#: Points that are looked at; a column of the picture with fewer is empty.
COUNT, FEWEST = 20_000, 3
#: Pieces whose middle lies farther off the skin than this hang before it, as glasses and a fringe do; metres.
OFF_SKIN = 10e-3
#: Share of the points that are left out at each end of a brow, and above and below it.
ENDS, EDGES = 0.02, 0.05
#: Modelled brows reach down to this over the inner eye corner, where lashes do not begin, share of the eyes' width.
LOWEST = 0.07
#: Share of a brow's columns that are not empty.
FILLED = 0.8


def find_modelled_brows(pieces: Surface, skin: Floats, places: Mapping[str, Floats]) -> dict[str, Floats]:
    """Name -> (x, z) of the brows' feature points in template coordinates; none unless both brows are there.

    Parameters
    ----------
    pieces : the head and what lies on it, template coordinates.
    skin : (N, 3) points of its skin.
    places : name -> (3,) the eye corners.
    """
    brows = pieces.part(_within(pieces, *box_of_brows(places)))
    if len(brows.triangles) == 0:
        return {}
    label = _pieces(brows)
    cloud = sample(brows, COUNT)
    if len(cloud) == 0:
        return {}
    piece = label[cloud.triangles]
    off, _ = cKDTree(skin).query(cloud.positions)
    count = np.maximum(np.bincount(piece), 1)
    near = np.bincount(piece, off) / count < OFF_SKIN

    def line_of(eye: Eye) -> Floats | None:
        local = eye.local(cloud.positions[:, [0, 2]])
        outside = (local[:, 0] < ASIDE[0]) | (local[:, 0] > ASIDE[1]) | (local[:, 1] < LOWEST) | (local[:, 1] > UP[1])
        own = near & (np.bincount(piece, outside, minlength=len(near)) == 0)
        return _middle_line(local[own[piece]])

    return brow_points(places, line_of)


def _within(surface: Surface, low: Floats, high: Floats) -> Bools:
    """(T,) triangles of the pieces that lie wholly in a box."""
    inside: Bools = np.all((surface.vertices >= low) & (surface.vertices <= high), axis=1)
    if not inside.any():
        return np.zeros(len(surface.triangles), dtype=bool)
    label = _labels(surface)
    beyond = np.zeros(len(inside), dtype=bool)
    beyond[label[~inside]] = True
    return np.asarray(~beyond[label[surface.triangles[:, 0]]])


def _pieces(surface: Surface) -> Ints:
    """(T,) number of the piece that each triangle belongs to; pieces are joined at vertices."""
    return _labels(surface)[surface.triangles[:, 0]]


def _labels(surface: Surface) -> Ints:
    """(V,) number of the piece that each vertex belongs to."""
    a, b, c = surface.triangles.T
    ends = np.concatenate([a, b]), np.concatenate([b, c])
    size = len(surface.vertices)
    joins = sparse.coo_array((np.ones(len(ends[0]), dtype=bool), ends), shape=(size, size))
    return np.asarray(connected_components(joins, directed=False)[1], dtype=np.int64)


def _middle_line(points: Floats) -> Floats | None:
    """(N, 2) the middle line of a brow that covers points (M, 2) of the picture, or None where it is none."""
    if len(points) < FEWEST / PIXEL:
        return None
    start, end = np.quantile(points[:, 0], [ENDS, 1.0 - ENDS])
    count = round((end - start) / PIXEL)
    if not SHORTEST < count * PIXEL < LONGEST:
        return None
    column = np.floor((points[:, 0] - start) / (end - start) * count).astype(np.int64)
    edges = np.full((count, 2), np.nan)
    for number in range(count):
        heights = points[column == number, 1]
        if len(heights) >= FEWEST:
            edges[number] = np.quantile(heights, [EDGES, 1.0 - EDGES])
    known = np.flatnonzero(np.isfinite(edges[:, 0]))
    if len(known) < FILLED * count or np.median(np.ptp(edges[known], axis=1)) > THICKEST:
        return None
    middle = np.interp(np.arange(count), known, edges[known].mean(axis=1))
    line = gaussian_filter1d(middle, LINE_BLUR, mode="nearest")
    return np.column_stack([start + (np.arange(count) + 0.5) * (end - start) / count, line])
