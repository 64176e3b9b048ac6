"""Brows, lips and irises for heads that bring no paint: where they lie, told by feature points and eyeballs."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from risorius.api import EyeballPlace
from risorius.arrays import Floats
from scipy.interpolate import CubicHermiteSpline

#: Brows along these points, from the inner to the outer end.
BROW_LEFT, BROW_RIGHT = ("4.1", "4.3", "4.5"), ("4.2", "4.4", "4.6")

#: The red of the lips, all the way round.
LIPS = ("8.3", "8.5", "8.9", "8.1", "8.10", "8.6", "8.4", "8.8", "8.2", "8.7")

#: Skin shows between the hairs: so much of the brow's colour covers it.
BROW_COVER = 0.96

#: (place along the brow, half of its width as a share of the distance between the eyes): blunt inside, then a point.
BROW_SHAPE = ((-0.06, 0.0), (0.0, 0.05), (0.1, 0.062), (0.4, 0.062), (0.8, 0.035), (1.05, 0.0))

#: An iris is 11.7 mm wide where eyes are 63 mm apart: its radius as a share of the distance between the eyes.
IRIS = 0.093

#: (distance from the middle of an iris in its radii, linear grey): pupil, iris with a dark rim, then the white.
EYE_GREYS = ((0.0, 0.005), (0.34, 0.005), (0.38, 0.1), (0.78, 0.16), (0.9, 0.03), (1.0, 0.03), (1.06, 0.55))

#: What lies behind an eyeball is white: so many radii of an iris away.
BEHIND = 9.0


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
        arch = brow_line(along, np.array([points[name][2] for name in names]))
        mine = side * (vertices[:, 0] - middle) >= 0.0
        out = side * (vertices[mine, 0] - middle)
        places[mine, 0] = (out - inner) / (outer - inner)
        places[mine, 1] = (vertices[mine, 2] - arch(out)) / between
    return places


def brow_line(along: Floats, heights: Floats) -> CubicHermiteSpline:
    """The middle of a brow through its inner, middle and outer point (3,), each at a height (3,); straight beyond them.

    It sets out straight towards the middle point, as hair does, rather than on a bow that dives at the inner end, and
    has its highest place at the middle point where that is the highest of the three.
    """
    rise = np.diff(heights) / np.diff(along)
    top = 0.0 if rise[0] * rise[1] <= 0.0 else 2.0 / (1.0 / rise).sum()
    slopes = np.array([rise[0], top, rise[1]])
    far = 10.0 * (along[2] - along[0])
    ends = np.array([along[0] - far, *along, along[2] + far])
    there = np.array([heights[0] - far * slopes[0], *heights, heights[2] + far * slopes[2]])
    return CubicHermiteSpline(ends, there, slopes[[0, 0, 1, 2, 2]])


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


def iris_places(vertices: Floats, ball: EyeballPlace, forward: Floats, up: Floats, between: float) -> Floats:
    """(n, 2) where vertices (n, 3) of an eyeball lie beside and above the middle of its iris, in radii of the iris.

    The eye looks straight ahead (`forward`, `up`: unit axes of the face), however coarse the ball or far off the vertex
    that is its pupil; `between`: the distance between the eyes.
    """
    away = vertices - ball.centre
    reach = np.linalg.norm(away, axis=1)
    places = np.stack([away @ np.cross(forward, up), away @ up], axis=1) / (IRIS * between)
    places *= (np.median(reach) / np.maximum(reach, 1e-12))[:, None]
    shown: Floats = np.where((away @ forward > 0.0)[:, None], places, BEHIND)
    return shown


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
