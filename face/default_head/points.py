"""Feature points of the default head (ISO/IEC 14496-2): on the skin from the figures, the rest from the other parts."""

from __future__ import annotations

import numpy as np

from ...arrays import Floats
from .figures import HeadFigures, PointFigures
from .skin import HeadSkin


def skin_points(figures: HeadFigures, skin: HeadSkin) -> dict[str, int | Floats]:
    """Feature points on the skin: a vertex where there is one, else a position (3,), metres; both sides.

    Raises
    ------
    ModelError : a point that names no vertex of the head.
    """
    points: dict[str, int | Floats] = {}
    for name, place in figures.points.items():
        point = _place(skin, place)
        points[name] = point
        if name in figures.point_pairs:
            other = int(skin.mirror[point]) if isinstance(point, int) else point * np.array([-1.0, 1.0, 1.0])
            points[figures.point_pairs[name]] = other
    return points


def _place(skin: HeadSkin, place: PointFigures) -> int | Floats:
    """A vertex, or a position inside a cage quad, bilinear in the one of its four children that it falls in."""
    if place.uv is None:
        return skin.vertex(*place.nodes)
    a, b, c, d = place.nodes
    middle = skin.vertex(a, b, c, d)
    grid = np.array(
        [
            [skin.vertex(a), skin.vertex(a, d), skin.vertex(d)],
            [skin.vertex(a, b), middle, skin.vertex(c, d)],
            [skin.vertex(b), skin.vertex(b, c), skin.vertex(c)],
        ]
    )
    u, v = 2.0 * place.uv[0], 2.0 * place.uv[1]
    i, j = min(int(u), 1), min(int(v), 1)
    u, v = u - i, v - j
    corners = skin.vertices[grid[i : i + 2, j : j + 2]]
    low, high = (1.0 - v) * corners[0, 0] + v * corners[0, 1], (1.0 - v) * corners[1, 0] + v * corners[1, 1]
    return np.asarray((1.0 - u) * low + u * high, dtype=np.float64)
