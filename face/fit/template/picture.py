"""A face seen from the front as a picture of what tells its parts: relief, fine and coarse, and slopes."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.ndimage import map_coordinates

from ....arrays import Bools, Floats, Ints
from ..surface.depth_map import blurred
from .open_mouth import open_template

PIXEL = 3e-3
#: Least and greatest x and z of the picture, metres of the template; its columns and rows.
LOW, HIGH = np.array([-84e-3, -129e-3]), np.array([84e-3, 111e-3])
COLUMNS, ROWS = np.round((HIGH - LOW) / PIXEL).astype(int).tolist()
#: Relief is what lies between two blurs; the third figure counts as much of it as there is; metres.
BANDS = ((3.6e-3, 14e-3, 2.5e-3), (8e-3, 28e-3, 4e-3))
#: Blur of the slopes and of the depth, metres; how much slopes count beside relief.
SLOPE_BLUR, DEPTH_BLUR, SLOPE = 5e-3, 3e-3, 1.6
#: What of the template counts fully lies between these heights and in front of this, metres.
BOTTOM, TOP, FRONT, OUTSIDE = -115e-3, 85e-3, -20e-3, 0.3


@dataclass(frozen=True, eq=False)
class Picture:
    """What is seen from the front; rows upward, columns to the subject's left.

    Attributes
    ----------
    features : (4, ROWS, COLUMNS) fine and coarse relief, slopes along x and z; each about 1 at most.
    depth : (ROWS, COLUMNS) metres.
    known : (ROWS, COLUMNS) where anything is seen.
    """

    features: Floats
    depth: Floats
    known: Bools


def picture(positions: Floats) -> Picture:
    """The picture of points (N, 3) spread over a head, in template coordinates."""
    pixel: Ints = np.floor((positions[:, [0, 2]] - LOW) / PIXEL).astype(np.int64)
    inside = (pixel >= 0).all(axis=1) & (pixel < (COLUMNS, ROWS)).all(axis=1)
    nearest = np.full(ROWS * COLUMNS, np.inf)
    np.minimum.at(nearest, pixel[inside, 1] * COLUMNS + pixel[inside, 0], positions[inside, 1])
    known = np.isfinite(nearest).reshape(ROWS, COLUMNS)
    depth = np.where(known, nearest.reshape(ROWS, COLUMNS), 0.0)
    relief = [
        np.tanh((blurred(depth, known, fine / PIXEL) - blurred(depth, known, coarse / PIXEL)) / most)
        for fine, coarse, most in BANDS
    ]
    up, across = np.gradient(blurred(depth, known, SLOPE_BLUR / PIXEL), PIXEL)
    steep = SLOPE / np.sqrt(1.0 + across**2 + up**2)
    features = np.array([*relief, across * steep, up * steep])
    return Picture(features, blurred(depth, known, DEPTH_BLUR / PIXEL), known)


@lru_cache(maxsize=4)
def template_picture(jaw_degrees: float) -> tuple[Picture, Floats]:
    """The template's own picture, and how much each of its pixels counts."""
    own = picture(open_template(jaw_degrees).cloud.positions)
    height = LOW[1] + (np.arange(ROWS) + 0.5) * PIXEL
    counts = np.where((height > BOTTOM) & (height < TOP), 1.0, OUTSIDE)[:, None]
    return own, np.where(own.known & (own.depth < FRONT), counts, 0.0)


def looked_up(image: Floats, rows: Floats, columns: Floats) -> Floats:
    """An image's values between its pixels; beyond its sides those of the sides."""
    return np.asarray(map_coordinates(image, [rows, columns], order=1, mode="nearest"), dtype=np.float64)
