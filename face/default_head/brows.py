"""The eyebrows: low strips of hair; their steep border starts just below the skin, so no gap and no flicker shows."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import CubicSpline

from ...arrays import Bools, Floats, Ints
from ...errors import ModelError
from ..mesh.parts import Part
from .figures import BrowFigures
from .piece import Piece
from .skin import HeadSkin

TUFTS = 56  # of hair along a brow; each has a crest between two furrows
PROFILE = np.array([-1.0, -0.97, -0.7, -0.35, 0.0, 0.35, 0.7, 0.97, 1.0])  # places across, shares of the half width
RIM = 0.5  # height of the border's upper edge, as a share of the lift
ROUNDING = 0.12  # share of the length over which each end is rounded
UNEVEN = 0.6180339887  # turns from one tuft's length to the next: never the same twice


def build_brow(figures: BrowFigures, skin: HeadSkin) -> Piece:
    """Left brow on the finished skin: tufts that lean outwards, each reaching farther than the furrows beside it.

    Raises
    ------
    ModelError : where the centre line leaves the front of the head.
    """
    along = (0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, 2 * TUFTS + 1))).astype(np.float64)
    crest = np.arange(len(along)) % 2 == 1
    end = np.clip(np.minimum(along, 1.0 - along) / ROUNDING, 0.0, 1.0)
    rounded = np.maximum(np.sqrt(1.0 - (1.0 - end) ** 2), 0.05)
    across = PROFILE * _reach(figures.fringe, crest)[:, np.where(PROFILE < 0.0, 0, 1)]
    lean = figures.lean * (along * (1.0 - along))[:, None] * across
    line, half_width, up = _centre_line(figures, along[:, None] + lean)
    plan = line + up * (half_width * rounded[:, None] * across)[..., None]
    foot, normal = front_surface(skin, plan.reshape(-1, 2))
    thick = figures.lift * np.clip(1.3 * rounded, 0.4, 1.0) * np.where(crest, 1.0, figures.furrow)
    lift = thick[:, None] * (RIM + (1.0 - RIM) * (1.0 - PROFILE**2))
    lift[:, [0, -1]] = -figures.sink
    lift[[0, -1]] = -figures.sink
    vertices = foot + normal * lift.reshape(-1, 1)
    k = np.arange(len(along) * len(PROFILE)).reshape(len(along), len(PROFILE))
    quads = np.stack([k[:-1, :-1], k[1:, :-1], k[1:, 1:], k[:-1, 1:]], axis=-1).reshape(-1, 4)
    tuft = np.repeat(np.arange(TUFTS), len(quads) // TUFTS)
    light = (tuft * UNEVEN) % 1.0 < figures.light
    return Piece(vertices, quads.astype(np.int64), Part.OTHER, tuple(np.where(light, "brow_light", "brow").tolist()))


def _reach(fringe: float, crest: Bools) -> Floats:
    """(N, 2) how far the lower and the upper border reach at each section, shares of the half width."""
    tuft = np.arange(len(crest)) // 2
    unlike = np.stack([(tuft * UNEVEN) % 1.0, (tuft * UNEVEN + 0.5) % 1.0], axis=1)
    return np.asarray(1.0 - fringe * np.where(crest[:, None], 0.6 * unlike, 1.0), dtype=np.float64)


def front_surface(skin: HeadSkin, places: Floats) -> tuple[Floats, Floats]:
    """Where lines along +Y first meet the skin.

    Parameters
    ----------
    places : (N, 2) float64, x and z in metres.

    Returns
    -------
    points (N, 3) and smooth unit normals (N, 3).

    Raises
    ------
    ModelError : a place where there is no skin.
    """
    triangles = np.concatenate([skin.quads[:, [0, 1, 2]], skin.quads[:, [0, 2, 3]]])
    flat = skin.vertices[:, [0, 2]][triangles]
    near = (flat.min(axis=1) <= places.max(axis=0)).all(axis=1) & (flat.max(axis=1) >= places.min(axis=0)).all(axis=1)
    triangles, flat = triangles[near], flat[near]
    a, b, c = flat[:, 0], flat[:, 1] - flat[:, 0], flat[:, 2] - flat[:, 0]
    area = b[:, 0] * c[:, 1] - b[:, 1] * c[:, 0]
    sound = np.abs(area) > 1e-14
    triangles, a, b, c, area = triangles[sound], a[sound], b[sound], c[sound], area[sound]
    offset = places[:, None, :] - a
    v = (offset[..., 0] * c[:, 1] - offset[..., 1] * c[:, 0]) / area
    w = (b[:, 0] * offset[..., 1] - b[:, 1] * offset[..., 0]) / area
    weights = np.stack([1.0 - v - w, v, w], axis=-1)
    depth = np.sum(weights * skin.vertices[triangles, 1], axis=-1)
    depth[(weights < -1e-9).any(axis=-1)] = np.inf
    hit = np.argmin(depth, axis=1)
    rows = np.arange(len(places))
    if not np.isfinite(depth[rows, hit]).all():
        raise ModelError("the default head's brow leaves its face: check brow.line in the head's figures")
    weight, corners = weights[rows, hit], triangles[hit]
    normals = vertex_normals(skin.vertices, skin.quads)
    points = np.einsum("nk,nkd->nd", weight, skin.vertices[corners])
    directions = np.einsum("nk,nkd->nd", weight, normals[corners])
    return points, directions / np.linalg.norm(directions, axis=1)[:, None]


def vertex_normals(vertices: Floats, quads: Ints) -> Floats:
    """Area-weighted unit normals (V, 3) of a quad mesh."""
    corners = vertices[quads]
    face = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    normals = np.zeros_like(vertices)
    for k in range(4):
        np.add.at(normals, quads[:, k], face)
    length = np.linalg.norm(normals, axis=1)[:, None]
    return np.asarray(normals / np.where(length > 0.0, length, 1.0), dtype=np.float64)


def _centre_line(figures: BrowFigures, along: Floats) -> tuple[Floats, Floats, Floats]:
    """Points (..., 2), half widths (...) and upward unit normals (..., 2) at shares of the brow's length."""
    steps = np.linalg.norm(np.diff(figures.line, axis=0), axis=1)
    share = np.concatenate([[0.0], np.cumsum(steps)]) / np.sum(steps)
    spline = CubicSpline(share, figures.line)
    inside = np.clip(along, 0.0, 1.0)
    tangent = spline(inside, 1)
    tangent /= np.linalg.norm(tangent, axis=-1)[..., None]
    up = np.stack([-tangent[..., 1], tangent[..., 0]], axis=-1)
    return np.asarray(spline(inside), dtype=np.float64), np.interp(inside, share, figures.half_widths), up
