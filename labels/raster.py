"""What each pixel of a picture shows, and what hides a place: triangles drawn in plain NumPy.

The same figures on every machine and in every Blender. A pixel shows what the ray through its middle meets first; both
sides of a triangle are drawn. Each triangle is one 3 x 3 matrix that takes the middle of a pixel to its shares of the
triangle's corners over their depth, so that triangles that reach behind the camera need no clipping.
Source: Olano and Greer 1997, "Triangle scan conversion using 2D homogeneous coordinates".
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ..arrays import Bools, Floats, Ints
from .view import View

#: So many pairs of triangle and place are looked at at once.
AT_ONCE = 1 << 20
#: A place that lies on the border of a triangle but for rounding belongs to it.
ROUNDING = 1e-9


@dataclass(frozen=True, eq=False)
class Drawn:
    """What every pixel shows.

    Attributes
    ----------
    triangle : (height, width) number of the triangle that is seen; -1: nothing.
    shares : (height, width, 3) where on it: shares of its corners.
    depth : (height, width) metres along the camera's z axis; infinite where there is nothing.
    """

    triangle: Ints
    shares: Floats
    depth: Floats

    @property
    def there(self) -> Bools:
        """(height, width) where anything is seen."""
        return np.asarray(self.triangle >= 0)


@dataclass(frozen=True, eq=False)
class Triangles:
    """Triangles before a camera.

    Attributes
    ----------
    number : (t,) of each in the mesh; those that are seen from the edge are left out.
    inverse : (t, 3, 3) a pixel (x, y, 1) to the corners' shares over depth; to the shares themselves without
        perspective. depth : (t, 3) of the corners, metres.
    low, high : (t, 2) pixels between which each lies.
    """

    view: View
    number: Ints
    inverse: Floats
    depth: Floats
    low: Floats
    high: Floats

    @classmethod
    def of(cls, view: View, before: Floats, triangles: Ints) -> Triangles:
        """Those (T, 3) between places (V, 3) in the camera's axes, as far as any of them is before it."""
        size = np.array([view.width, view.height], dtype=np.float64)
        number = np.flatnonzero((before[:, 2] > view.near)[triangles].any(axis=1))
        corners = before[triangles[number]]
        columns = np.moveaxis(corners, 1, 2)
        if view.perspective:
            matrices = view.intrinsics @ columns
        else:
            flat = view.intrinsics[:2, :2] @ columns[:, :2] + view.intrinsics[:2, 2, None]
            matrices = np.concatenate([flat, np.ones((len(flat), 1, 3))], axis=1)
        with np.errstate(divide="ignore", invalid="ignore"):
            pixels = matrices[:, :2] / matrices[:, 2:]
        ahead = np.asarray(matrices[:, 2].min(axis=1) > 0.0)
        low = np.where(ahead[:, None], pixels.min(axis=2), 0.0)
        high = np.where(ahead[:, None], pixels.max(axis=2), size)
        inverse, solid = _inverses(matrices)
        kept = np.flatnonzero(solid & (high >= 0.0).all(axis=1) & (low <= size).all(axis=1))
        return cls(view, number[kept], inverse[kept], corners[kept][:, :, 2], low[kept], high[kept])

    def without(self, some: Bools) -> Triangles:
        """Those that are not among some of the mesh's (T,)."""
        kept = ~some[self.number]
        number, inverse, depth = self.number[kept], self.inverse[kept], self.depth[kept]
        return Triangles(self.view, number, inverse, depth, self.low[kept], self.high[kept])

    def met(self, which: Ints, places: Floats) -> tuple[Bools, Floats, Floats]:
        """Which of n pairs of a triangle and a place in pixels (n, 2) meet; shares (m, 3) and depths (m,) of those."""
        x, y = places.T
        found = np.stack([self._row(which, row, x, y) for row in range(3)])
        total = found.sum(axis=0)
        least: Floats = found.min(axis=0)
        inside = np.asarray((least >= -ROUNDING * np.abs(total)) & (total > 0.0))
        shares = (found[:, inside] / total[inside]).T
        depth = 1.0 / total[inside] if self.view.perspective else (shares * self.depth[which[inside]]).sum(axis=1)
        shown = (depth >= self.view.near) & (depth <= self.view.far)
        inside[np.flatnonzero(inside)[~shown]] = False
        return inside, shares[shown], depth[shown]

    def _row(self, which: Ints, row: int, x: Floats, y: Floats) -> Floats:
        """(n,) one corner's share over depth at places."""
        a, b, c = self.inverse[:, row].T
        value: Floats = a[which] * x + b[which] * y + c[which]
        return value


def _inverses(matrices: Floats) -> tuple[Floats, Bools]:
    """Inverses of (t, 3, 3), and which there are."""
    a, b, c = np.moveaxis(matrices, 2, 0)
    rows = np.stack([np.cross(b, c), np.cross(c, a), np.cross(a, b)], axis=1)
    volume = np.einsum("ti,ti->t", a, rows[:, 0])
    scale = np.linalg.norm(a, axis=1) * np.linalg.norm(b, axis=1) * np.linalg.norm(c, axis=1)
    solid = np.abs(volume) > np.finfo(float).eps * scale
    return rows / np.where(solid, volume, 1.0)[:, None, None], np.asarray(solid)


def draw(triangles: Triangles) -> Drawn:
    """Draw triangles into their view's picture."""
    view = triangles.view
    count = view.width * view.height
    number, depth = np.full(count, -1, dtype=np.int64), np.full(count, np.inf)
    shares = np.zeros((count, 3))
    for which, x, y in _pixels(triangles):
        inside, there, far = triangles.met(which, np.stack([x, y], axis=1).astype(np.float64) + 0.5)
        pixel, which = (y * view.width + x)[inside], which[inside]
        order = np.lexsort((which, far, pixel))
        order = order[np.diff(pixel[order], prepend=-1) > 0]
        order = order[far[order] < depth[pixel[order]]]
        chosen = pixel[order]
        number[chosen], depth[chosen], shares[chosen] = triangles.number[which[order]], far[order], there[order]
    shape = view.height, view.width
    return Drawn(number.reshape(shape), shares.reshape(*shape, 3), depth.reshape(shape))


def _pixels(triangles: Triangles) -> Iterator[tuple[Ints, Ints, Ints]]:
    """Triangles and the columns and rows of pixels that may show them, some at a time."""
    last = np.array([triangles.view.width - 1, triangles.view.height - 1])
    first = np.clip(np.ceil(triangles.low - 0.5), 0, last + 1).astype(np.int64)
    size = np.clip(np.floor(triangles.high - 0.5), -1, last).astype(np.int64) - first + 1
    counts = np.where((size > 0).all(axis=1), size.prod(axis=1), 0)
    ends = np.cumsum(counts)
    start = 0
    while start < len(counts):
        done = int(ends[start - 1]) if start else 0
        stop = max(int(np.searchsorted(ends, done + AT_ONCE, side="right")), start + 1)
        some = np.arange(start, stop)
        which = np.repeat(some, counts[some])
        place = np.arange(len(which)) - np.repeat(ends[some] - counts[some] - done, counts[some])
        yield which, first[which, 0] + place % size[which, 0], first[which, 1] + place // size[which, 0]
        start = stop


def nearest(triangles: Triangles, places: Floats) -> Floats:
    """(n,) depth of what is seen first at places in pixels (n, 2), metres; infinite where nothing is."""
    found = np.full(len(places), np.inf)
    known = np.flatnonzero(np.isfinite(places).all(axis=1))
    order = known[np.argsort(places[known, 0], kind="stable")]
    x = places[order, 0]
    first, end = np.searchsorted(x, triangles.low[:, 0]), np.searchsorted(x, triangles.high[:, 0], side="right")
    counts = np.maximum(end - first, 0)
    which = np.repeat(np.arange(len(counts)), counts)
    index = order[np.arange(len(which)) - np.repeat(np.cumsum(counts) - counts - first, counts)]
    y = places[index, 1]
    near = (y >= triangles.low[which, 1]) & (y <= triangles.high[which, 1])
    which, index = which[near], index[near]
    inside, _, depth = triangles.met(which, places[index])
    np.minimum.at(found, index[inside], depth)
    return found
