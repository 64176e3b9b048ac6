"""A face seen from the front as a picture of depths."""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
from scipy.ndimage import gaussian_filter

from ....arrays import Bools, Floats

#: The oval in which faces are compared: half axes and the height of its middle, metres of the template.
OVAL = (52e-3, 66e-3)
OVAL_MIDDLE = -7e-3
PIXEL = 3e-3
#: Relief is what is finer than the second and coarser than the first blur, metres.
BLURS = (3.6e-3, 14e-3)
RELIEF_CLIP, DEPTH_CLIP = 8e-3, 15e-3


def depth_map(positions: Floats) -> Floats:
    """Depth (rows upward, columns to the left) of the nearest of points (N, 3) round the oval; NaN where none is."""
    half = np.array(OVAL) + 4.0 * BLURS[0]
    columns, rows = _size()
    across = np.floor((positions[:, 0] + half[0]) / PIXEL).astype(np.int64)
    up = np.floor((positions[:, 2] - OVAL_MIDDLE + half[1]) / PIXEL).astype(np.int64)
    inside = (across >= 0) & (across < columns) & (up >= 0) & (up < rows)
    depth = np.full(rows * columns, np.inf)
    np.minimum.at(depth, up[inside] * columns + across[inside], positions[inside, 1])
    depth[~np.isfinite(depth)] = np.nan
    return depth.reshape(rows, columns)


def _size() -> tuple[int, int]:
    """Columns and rows of a depth map."""
    columns, rows = (math.ceil(2.0 * (half + 4.0 * BLURS[0]) / PIXEL) for half in OVAL)
    return columns, rows


@lru_cache(maxsize=1)
def in_oval() -> Bools:
    """Which pixels of a depth map lie in the oval."""
    columns, rows = _size()
    across = (np.arange(columns) + 0.5) * PIXEL - OVAL[0] - 4.0 * BLURS[0]
    up = (np.arange(rows) + 0.5) * PIXEL - OVAL[1] - 4.0 * BLURS[0]
    inside: Bools = (across / OVAL[0]) ** 2 + (up[:, None] / OVAL[1]) ** 2 <= 1.0
    return inside


def relief(depth: Floats, known: Bools) -> Floats:
    """The finer shape of a depth map: eyes, nose and mouth without the head's roundness."""
    fine, coarse = (blurred(depth, known, width / PIXEL) for width in BLURS)
    return np.clip(fine - coarse, -RELIEF_CLIP, RELIEF_CLIP)


def blurred(depth: Floats, known: Bools, width: float) -> Floats:
    """Gaussian mean over the known pixels."""
    share = gaussian_filter(known.astype(np.float64), width, mode="constant")
    mean = gaussian_filter(np.where(known, depth, 0.0), width, mode="constant")
    return np.asarray(mean / np.maximum(share, 1e-6))
