"""Telling skin, eyeballs, teeth and tongue apart when nobody has: by connected pieces, their place and their shape."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from scipy import sparse
from scipy.sparse.csgraph import connected_components

from ..arrays import Floats, Ints
from .eyes import fit_sphere
from .parts import Part
from .template import MM, TEMPLATE_POINTS

#: A piece is an eyeball when it fills this box round the eye corners' middle and is round to this share of its radius.
EYE_REACH = 26 * MM
ROUNDNESS = 0.12

#: Pieces within this box (head space) lie in the mouth.
MOUTH_HALF_WIDTH = 40 * MM
MOUTH_DEPTH = 90 * MM


def pieces(polygons: Sequence[Ints], vertex_count: int) -> Ints:
    """(V,) number of the connected piece of each vertex."""
    first = np.concatenate([np.repeat(p[:1], len(p) - 1) for p in polygons])
    second = np.concatenate([p[1:] for p in polygons])
    graph = sparse.coo_array((np.ones(len(first)), (first, second)), shape=(vertex_count, vertex_count))
    return np.asarray(connected_components(graph, directed=False)[1], dtype=np.int64)


def _eye(piece: Floats, points: Mapping[str, Floats]) -> Part | None:
    """The eyeball that a piece (k, 3) is, if it is one: round, behind the lids."""
    for part, names in ((Part.EYEBALL_L, ("3.7", "3.11")), (Part.EYEBALL_R, ("3.8", "3.12"))):
        middle = (points[names[0]] + points[names[1]]) / 2.0
        if np.abs(piece - middle).max() > EYE_REACH + 8 * MM or np.linalg.norm(piece.mean(axis=0) - middle) > EYE_REACH:
            continue
        centre, radius = fit_sphere(piece)
        off = np.abs(np.linalg.norm(piece - centre, axis=1) - radius)
        if (
            6 * MM < radius < 22 * MM
            and np.median(off) < ROUNDNESS * radius
            and np.ptp(piece, axis=0).min() > 0.4 * radius
        ):
            return part
    return None


def derive_parts(positions: Floats, polygons: Sequence[Ints], points: Mapping[str, Floats], skin_vertex: int) -> Ints:
    """Part of every vertex of a mesh.

    Parameters
    ----------
    positions : (V, 3) neutral mesh in head space, metres.
    polygons : sequence of vertex index arrays.
    points : feature point -> (3,) in head space.
    skin_vertex : a vertex that is certainly skin (the nose tip).

    Returns
    -------
    (V,) numbers of `Part`.
    """
    labels = pieces(polygons, len(positions))
    parts = np.full(len(positions), int(Part.OTHER), dtype=np.int64)
    lips = (points["2.2"] + points["2.3"]) / 2.0
    span = TEMPLATE_POINTS["8.3"][0] - TEMPLATE_POINTS["8.4"][0]
    reach = (points["8.3"][0] - points["8.4"][0]) / span
    for label in range(labels.max() + 1):
        member = np.flatnonzero(labels == label)
        piece = positions[member]
        if labels[skin_vertex] == label:
            parts[member] = int(Part.SKIN)
            continue
        if len(member) < 4:
            continue
        eye = _eye(piece, points)
        if eye is not None:
            parts[member] = int(eye)
            continue
        middle = piece.mean(axis=0) - lips
        inside = np.abs(piece[:, 0] - lips[0]).max() < MOUTH_HALF_WIDTH * reach and -MOUTH_DEPTH < middle[2] < 4 * MM
        if inside and abs(middle[1]) < 30 * MM:
            parts[member] = int(_mouth_part(piece, lips))
    return parts


def _mouth_part(piece: Floats, lips: Floats) -> Part:
    """Teeth above or below the lips' line, or the tongue: a low, long body in the middle."""
    low, high = piece[:, 1].min() - lips[1], piece[:, 1].max() - lips[1]
    width, depth = np.ptp(piece[:, 0]), np.ptp(piece[:, 2])
    hollow = np.linalg.norm(piece[:, [0, 2]] - piece[:, [0, 2]].mean(axis=0), axis=1).min() > 0.25 * width
    if width > 20 * MM and depth > 25 * MM and not hollow and (low + high) / 2.0 < 0.0:
        return Part.TONGUE
    return Part.TEETH_UPPER if low + high > 0.0 else Part.TEETH_LOWER
