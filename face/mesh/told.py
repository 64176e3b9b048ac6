"""From what is told of a mesh's vertices to their parts: objects that hold both eyes, or both rows of teeth.

Whoever models a character keeps what is alike in one object, so that an object is known to hold eyes or teeth, but not
which of its vertices are left or right, upper or lower. Its connected pieces are told apart as those of a whole head
are; what shape does not tell goes to the side where it lies.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from scipy.spatial import cKDTree

from ...arrays import Bools, Floats, Ints
from ...polygons import PolygonTable
from .eye_parts import EYEBALL, EYES
from .parts import Part, Told
from .segmentation import derive_parts, pieces
from .sphere import fit_sphere

IN_MOUTH = (Part.TEETH_UPPER, Part.TEETH_LOWER, Part.TONGUE)


def parts_of_told(
    told: Ints, positions: Floats, polygons: PolygonTable, points: Mapping[str, Floats], skin_vertex: int
) -> Ints:
    """(V,) parts of every vertex.

    Parameters
    ----------
    told : (V,) numbers of `Part`, which stay, and of `Told`.
    positions, polygons, points, skin_vertex : as for `derive_parts`.
    """
    open_, parts = told < 0, told.copy()
    index = np.flatnonzero(open_)
    local = np.full(len(told), -1, dtype=np.int64)
    local[index] = np.arange(len(index))
    own = polygons.kept(polygons.within(open_)).numbered(local)
    if not len(own):
        parts[index] = int(Part.OTHER)
    else:
        nose = int(local[skin_vertex]) if open_[skin_vertex] else None
        parts[index] = derive_parts(positions[index], own, _without_tongue(points, told), nose)
    labels = np.full(len(told), -1, dtype=np.int64)
    labels[index] = pieces(own, len(index)) if len(own) else np.arange(len(index))
    _settle_eyes(parts, told == Told.EYES, labels, positions, points)
    _settle_teeth(parts, told == Told.TEETH, labels, positions, points)
    return parts


def _without_tongue(points: Mapping[str, Floats], told: Ints) -> Mapping[str, Floats]:
    """The points, without those that would find a tongue in the gums where the tongue is told."""
    if not (told == Part.TONGUE).any():
        return points
    return {name: place for name, place in points.items() if not name.startswith("6.")}


def _settle_eyes(parts: Ints, eyes: Bools, labels: Ints, positions: Floats, points: Mapping[str, Floats]) -> None:
    """Give what is told to be eyes (V,) to the left or right one, in place; what lies off the balls to the skin."""
    middles = np.array([(points[inner] + points[outer]) / 2.0 for inner, outer, *_ in EYES.values()])
    balls = [fit_sphere(positions[eyes & (parts == part)]) if (eyes & (parts == part)).any() else None for part in EYES]
    for label in np.unique(labels[eyes]):
        member = np.flatnonzero(eyes & (labels == label))
        if np.isin(parts[member[0]], list(EYES)):
            continue
        side = _nearest(positions[member], middles)
        for own, (part, ball) in enumerate(zip(EYES, balls, strict=True)):
            mine = member[side == own]
            off = ball is not None and len(mine) > 0 and _farthest(positions[mine], ball[0]) > EYEBALL.shell * ball[1]
            parts[mine] = int(Part.OTHER if off else part)


def _nearest(piece: Floats, middles: Floats) -> Ints:
    """(k,) which of two middles (2, 3) each vertex of a piece (k, 3) is nearer to; of a piece at one of them, all."""
    low, high = piece[:, 0].min(), piece[:, 0].max()
    across = (low < middles[:, 0]).all() and (middles[:, 0] < high).all()
    places = piece if across else piece.mean(axis=0, keepdims=True)
    side = np.linalg.norm(places[:, None] - middles, axis=2).argmin(axis=1)
    return np.asarray(np.broadcast_to(side, len(piece)), dtype=np.int64)


def _farthest(piece: Floats, centre: Floats) -> float:
    """Largest distance of a piece (k, 3) from a centre."""
    return float(np.linalg.norm(piece - centre, axis=1).max())


def _settle_teeth(parts: Ints, teeth: Bools, labels: Ints, positions: Floats, points: Mapping[str, Floats]) -> None:
    """Give what is told to be teeth (V,) to a row, in place: by shape, by what is nearest, by the lips' height."""
    lips = (points["2.2"] + points["2.3"]) / 2.0
    open_ = []
    for label in np.unique(labels[teeth]):
        member = np.flatnonzero(teeth & (labels == label))
        if not np.isin(parts[member[0]], IN_MOUTH):
            open_.append(member)
    known = np.flatnonzero(teeth & np.isin(parts, (Part.TEETH_UPPER, Part.TEETH_LOWER)))
    for member in open_:
        if len(known):
            distance, nearest = (np.asarray(each) for each in cKDTree(positions[known]).query(positions[member]))
            parts[member] = parts[known[nearest[distance.argmin()]]]
        else:
            high = positions[member, 1].min() + positions[member, 1].max() > 2.0 * lips[1]
            parts[member] = int(Part.TEETH_UPPER if high else Part.TEETH_LOWER)
