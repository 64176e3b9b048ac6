"""Telling skin, eyeballs, teeth and tongue apart when nobody has: by connected pieces, their place and their shape."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy import sparse
from scipy.sparse.csgraph import connected_components

from ...arrays import Floats, Ints
from ..figures import Length, Pair, Share, read_figures
from .mouth_parts import in_mouth, mouth_part, split_gums, split_tongue
from .parts import Part
from .sphere import fit_sphere


@dataclass(frozen=True)
class EyeballFigures:
    """What an eyeball may be (presets/anatomy/parts.toml)."""

    reach: Length
    box: Length
    radius: Pair
    roundness: Share
    centred: Share
    within: float


EYEBALL = read_figures("parts.eyeball", EyeballFigures)


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
        if np.abs(piece - middle).max() > EYEBALL.box or np.linalg.norm(piece.mean(axis=0) - middle) > EYEBALL.reach:
            continue
        centre, radius = fit_sphere(piece)
        off = np.abs(np.linalg.norm(piece - centre, axis=1) - radius)
        if (
            EYEBALL.radius[0] < radius < EYEBALL.radius[1]
            and np.median(off) < EYEBALL.roundness * radius
            and np.linalg.norm(piece.mean(axis=0) - centre) < EYEBALL.centred * radius
        ):
            return part
    return None


def _add_inner_pieces(parts: Ints, labels: Ints, positions: Floats) -> None:
    """Give pieces that lie wholly in an eyeball to it, in place."""
    for part in (Part.EYEBALL_L, Part.EYEBALL_R):
        ball = positions[parts == part]
        if len(ball) == 0:
            continue
        centre, radius = fit_sphere(ball)
        inside = np.linalg.norm(positions - centre, axis=1) < EYEBALL.within * radius
        for label in np.unique(labels[(parts == Part.OTHER) & inside]):
            member = labels == label
            if inside[member].all():
                parts[member] = int(part)


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
    gums = np.zeros(len(positions), dtype=bool)
    lips = (points["2.2"] + points["2.3"]) / 2.0
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
        if in_mouth(piece, lips):
            found = mouth_part(piece, lips)
            parts[member] = int(Part.OTHER if found is None else found)
            gums[member] = found is None
    _add_inner_pieces(parts, labels, positions)
    split_gums(parts, gums, positions, polygons)
    split_tongue(parts, labels, positions, polygons, points)
    return parts
