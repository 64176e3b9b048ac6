"""How bright a surface is painted: by colours at its corners, by images, or by what lies on it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from ....arrays import Floats, Ints
from .cloud import Surface, sample

#: Points that are looked at round a place.
COUNT = 60_000

#: Brightness (N,), 0 .. 1, at points that lie on triangles (N,) with weights (N, 3) of their corners.
Brightness: TypeAlias = Callable[[Ints, Floats], Floats]


@dataclass(frozen=True, eq=False)
class Paint:
    """A painted surface.

    Attributes
    ----------
    corners : (T, 3, 3) the corners of its triangles, in the mesh's own coordinates.
    brightness : of points on them.
    """

    corners: Floats
    brightness: Brightness

    def within(self, low: Floats, high: Floats, to_box: Callable[[Floats], Floats]) -> tuple[Floats, Floats]:
        """Points (N, 3) of the box's coordinates spread over what lies in a box, and their brightness (N,).

        Parameters
        ----------
        low, high : (3,) the box.
        to_box : turns positions of the mesh (N, 3) into the box's coordinates.
        """
        local = to_box(self.corners.reshape(-1, 3)).reshape(-1, 3, 3)
        touches = np.flatnonzero(((local.max(axis=1) >= low) & (local.min(axis=1) <= high)).all(axis=1))
        flat = local[touches].reshape(-1, 3)
        surface = Surface(flat, np.arange(len(flat)).reshape(-1, 3), np.zeros_like(flat))
        cloud = sample(surface, COUNT) if len(touches) else None
        if cloud is None or len(cloud) == 0:
            return np.zeros((0, 3)), np.zeros(0)
        triangles = touches[cloud.triangles]
        shown = ((cloud.positions >= low) & (cloud.positions <= high)).all(axis=1)
        positions, triangles = cloud.positions[shown], triangles[shown]
        return positions, self.brightness(triangles, weights_in(local[triangles], positions))


def weights_in(corners: Floats, places: Floats) -> Floats:
    """(N, 3) shares of the corners (N, 3, 3) of triangles in places (N, 3) on them."""
    a, b, c = (corners[:, k] for k in range(3))
    normal = np.cross(b - a, c - a)
    square = np.maximum((normal * normal).sum(axis=1), np.finfo(float).tiny)
    second = (np.cross(places - a, c - a) * normal).sum(axis=1) / square
    third = (np.cross(b - a, places - a) * normal).sum(axis=1) / square
    return np.column_stack([1.0 - second - third, second, third])


def of_corners(values: Floats) -> Brightness:
    """Brightness (T, 3) given at the corners of the triangles."""
    return lambda triangles, weights: np.asarray((values[triangles] * weights).sum(axis=1))


def of_image(uv: Floats, image: Floats) -> Brightness:
    """Brightness of an image (rows from below, columns) that repeats; `uv` (T, 3, 2) are the corners' places in it."""

    def looked_up(triangles: Ints, weights: Floats) -> Floats:
        at = (uv[triangles] * weights[:, :, None]).sum(axis=1) % 1.0
        column, row = np.minimum((at * image.shape[::-1]).astype(np.int64), np.array(image.shape[::-1]) - 1).T
        return np.asarray(image[row, column])

    return looked_up
