"""Brows and lips for heads that bring no paint: where they lie on the skin, told by feature points."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from risorius.arrays import Floats

#: Brows along these points, from the inner to the outer end.
BROW_LEFT, BROW_RIGHT = ("4.1", "4.3", "4.5"), ("4.2", "4.4", "4.6")

#: The red of the lips, all the way round.
LIPS = ("8.3", "8.5", "8.9", "8.1", "8.10", "8.6", "8.4", "8.8", "8.2", "8.7")

#: Skin shows between the hairs: so much of the brow's colour covers it.
BROW_COVER = 0.8

#: (place along the brow, half of its width as a share of the distance between the eyes): thick inside, then a point.
BROW_SHAPE = ((-0.05, 0.0), (0.0, 0.05), (0.3, 0.06), (0.75, 0.045), (1.12, 0.0))


def brow_places(vertices: Floats, points: Mapping[str, Floats]) -> Floats:
    """(V, 2) how far along its brow a vertex lies, 0 at the inner and 1 at the outer point, and how far above it.

    Above as a share of the distance between the eyes (3.5 to 3.6), straight up. `vertices` (V, 3) and `points` look
    along -y, with x to the subject's left and z up.
    """
    between = float(np.linalg.norm(points["3.5"] - points["3.6"]))
    middle = 0.5 * (points["3.5"][0] + points["3.6"][0])
    places = np.empty((len(vertices), 2))
    for side, names in ((1.0, BROW_LEFT), (-1.0, BROW_RIGHT)):
        inner, _, outer = along = np.array([side * (points[name][0] - middle) for name in names])
        arch = np.polyfit(along, [points[name][2] for name in names], 2)
        mine = side * (vertices[:, 0] - middle) >= 0.0
        out = side * (vertices[mine, 0] - middle)
        places[mine, 0] = (out - inner) / (outer - inner)
        places[mine, 1] = (vertices[mine, 2] - np.polyval(arch, out)) / between
    return places


def lip_depths(vertices: Floats, points: Mapping[str, Floats]) -> Floats:
    """(V,) how deep a vertex lies within the red of the lips, seen from the front, in the points' unit; < 0 outside."""
    outline = rounded(np.array([points[name][[0, 2]] for name in LIPS]))
    seen = vertices[:, [0, 2]]
    start, way = outline, np.roll(outline, -1, axis=0) - outline
    share = np.einsum("vek,ek->ve", seen[:, None] - start, way) / np.maximum((way**2).sum(axis=1), 1e-18)
    foot = start + np.clip(share, 0.0, 1.0)[..., None] * way
    away = np.linalg.norm(seen[:, None] - foot, axis=2).min(axis=1)
    ends = start + way
    crossed = (start[:, 1] > seen[:, None, 1]) != (ends[:, 1] > seen[:, None, 1])
    rise = np.where(np.abs(way[:, 1]) < 1e-18, 1.0, way[:, 1])
    beside = start[:, 0] + (seen[:, None, 1] - start[:, 1]) / rise * way[:, 0]
    inside = (crossed & (seen[:, None, 0] < beside)).sum(axis=1) % 2 == 1
    depths: Floats = np.where(inside, away, -away)
    return depths


def exposed(pixels: Floats, stops: float) -> Floats:
    """A picture (..., 3) as stored (sRGB, 0..1), as if exposed longer by so many stops; what is too bright is white."""
    linear = np.where(pixels <= 0.04045, pixels / 12.92, ((pixels + 0.055) / 1.055) ** 2.4) * 2.0**stops
    stored = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * np.maximum(linear, 1e-9) ** (1 / 2.4) - 0.055)
    brighter: Floats = np.clip(stored, 0.0, 1.0)
    return brighter


def rounded(outline: Floats, steps: int = 4) -> Floats:
    """(n * steps, 2) points of a closed line through an outline (n, 2) (Catmull and Rom 1974)."""
    last, following, beyond = (np.roll(outline, shift, axis=0) for shift in (1, -1, -2))
    share = np.linspace(0.0, 1.0, steps, endpoint=False)[:, None, None]
    line: Floats = 0.5 * (
        2.0 * outline
        + (following - last) * share
        + (2.0 * last - 5.0 * outline + 4.0 * following - beyond) * share**2
        + (3.0 * outline - last - 3.0 * following + beyond) * share**3
    )
    return line.transpose(1, 0, 2).reshape(-1, 2)
