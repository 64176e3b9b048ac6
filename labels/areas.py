"""What of a face each pixel shows: lips, teeth, irises and all else, told on the resting face.

An area is told at the very place that a pixel shows, not by whole polygons: borders of lips and irises are as smooth on
a coarse mesh as on a fine one, and move with the skin.
"""

from __future__ import annotations

from enum import IntEnum
from functools import cached_property

import numpy as np

from ..arrays import Bools, Floats, Ints
from ..face.face import Face
from ..face.mesh.own_lip import own_lips
from ..face.mesh.parts import Part
from ..physics.mesh import triangulate
from .geometry import Shown
from .raster import Drawn


class Area(IntEnum):
    """What a pixel shows; the numbers stand in files and are never changed."""

    BACKGROUND = 0
    SKIN = 1
    LIP_UPPER = 2
    LIP_LOWER = 3
    MOUTH = 4
    TEETH_UPPER = 5
    TEETH_LOWER = 6
    TONGUE = 7
    SCLERA_L = 8
    IRIS_L = 9
    PUPIL_L = 10
    SCLERA_R = 11
    IRIS_R = 12
    PUPIL_R = 13
    ON_SKIN = 14
    ON_SKULL = 15
    OTHER = 16


#: What each number means, for people.
ABOUT = {
    Area.BACKGROUND: "nothing of the scene",
    Area.SKIN: "skin",
    Area.LIP_UPPER: "vermilion of the upper lip",
    Area.LIP_LOWER: "vermilion of the lower lip",
    Area.MOUTH: "inside of lips and cheeks, seen through the open mouth",
    Area.TEETH_UPPER: "upper teeth and gums",
    Area.TEETH_LOWER: "lower teeth and gums",
    Area.TONGUE: "tongue",
    Area.SCLERA_L: "eyeball of the subject's left eye without its iris",
    Area.IRIS_L: "left iris",
    Area.PUPIL_L: "left pupil",
    Area.SCLERA_R: "eyeball of the subject's right eye without its iris",
    Area.IRIS_R: "right iris",
    Area.PUPIL_R: "right pupil",
    Area.ON_SKIN: "what grows out of the skin: brows, lashes, beard",
    Area.ON_SKULL: "what goes with the skull alone: hair, glasses, hat",
    Area.OTHER: "other objects of the scene",
}

_OF_PART = {
    Part.SKIN: Area.SKIN,
    Part.EYEBALL_L: Area.SCLERA_L,
    Part.EYEBALL_R: Area.SCLERA_R,
    Part.TEETH_UPPER: Area.TEETH_UPPER,
    Part.TEETH_LOWER: Area.TEETH_LOWER,
    Part.TONGUE: Area.TONGUE,
    Part.OTHER: Area.ON_SKIN,
    Part.SKULL: Area.ON_SKULL,
}


class Areas:
    """Tells the areas of one face."""

    def __init__(self, face: Face, border: Floats) -> None:
        """`border` (n, 3): the border of the lips at rest, in order, in the face's coordinates."""
        self._face = face
        self._border = np.asarray(border, dtype=np.float64) @ face.axes[:2].T

    @cached_property
    def _of_vertex(self) -> Ints:
        """(V,) areas by part."""
        table = np.array([_OF_PART[Part(number)] for number in range(len(Part))])
        return np.asarray(table[self._face.parts])

    @cached_property
    def _outer(self) -> Bools:
        """(V,) the skin up to the margins of lips and lids."""
        outer = np.zeros(len(self._face.vertices), dtype=bool)
        outer[self._face.outer_skin] = True
        return outer

    @cached_property
    def _lower(self) -> Floats:
        """(V,) 1 on the lower lip, along the surface."""
        face = self._face
        nearest = face.points.nearest
        skin = triangulate(face.polygons)
        skin = skin[(np.asarray(face.parts) == Part.SKIN)[skin].all(axis=1)]
        size = float(np.linalg.norm(face.points["8.3"].position - face.points["8.4"].position))
        _, below = own_lips(face.vertices, skin, nearest["8.1"], nearest["8.2"], size)
        return below.astype(np.float64)

    @cached_property
    def _mouth_side(self) -> Bools:
        """(V,) nearer to the mouth than to either eye."""
        place = {name: point.position for name, point in self._face.points.items()}
        lips, *eyes = (
            np.linalg.norm(self._face.vertices - np.mean([place[name] for name in names], axis=0), axis=1)
            for names in (("2.2", "2.3"), ("3.7", "3.11"), ("3.8", "3.12"))
        )
        return np.asarray(lips < np.minimum(*eyes))

    def is_hair(self, shown: Shown) -> Bools:
        """(T,) which triangles grow out of the face's skin: brows, lashes, a beard."""
        corners = shown.source[shown.triangles[:, 0]]
        return np.asarray((corners >= 0) & (self._of_vertex[corners] == Area.ON_SKIN))

    def is_eyeball(self, shown: Shown) -> Bools:
        """(T,) which triangles are of the face's eyeballs."""
        corners = shown.source[shown.triangles[:, 0]]
        return np.asarray((corners >= 0) & np.isin(self._of_vertex[corners], (Area.SCLERA_L, Area.SCLERA_R)))

    def of(self, shown: Shown, drawn: Drawn) -> Ints:
        """(height, width) numbers of `Area`."""
        areas = np.full(drawn.triangle.shape, int(Area.BACKGROUND), dtype=np.int64)
        areas[drawn.there] = Area.OTHER
        seen = drawn.there & shown.is_face[drawn.triangle]
        corners = shown.source[shown.triangles[drawn.triangle[seen]]]
        areas[seen] = self._told(corners, drawn.shares[seen])
        return areas

    def _told(self, corners: Ints, shares: Floats) -> Ints:
        """(p,) areas of places: the face's vertices (p, 3) about them and their shares."""
        areas = self._of_vertex[corners[:, 0]].copy()
        rest = np.einsum("pk,pki->pi", shares, self._face.vertices[corners])
        skin = np.flatnonzero(areas == Area.SKIN)
        outer = self._outer[corners[skin]].all(axis=1)
        inside = skin[~outer & self._mouth_side[corners[skin]].all(axis=1)]
        areas[inside] = Area.MOUTH
        lips = skin[outer]
        lips = lips[_within(rest[lips] @ self._face.axes[:2].T, self._border)]
        lower = (shares[lips] * self._lower[corners[lips]]).sum(axis=1) > 0.5
        areas[lips] = np.where(lower, Area.LIP_LOWER, Area.LIP_UPPER)
        for ball in self._face.eyeballs:
            mine = np.flatnonzero(
                np.isin(corners[:, 0], ball.vertices) & np.isin(areas, (Area.SCLERA_L, Area.SCLERA_R))
            )
            away = rest[mine] - ball.centre
            away /= np.maximum(np.linalg.norm(away, axis=1, keepdims=True), np.finfo(float).tiny)
            angle = np.arccos(np.clip(away @ ball.gaze, -1.0, 1.0))
            areas[mine] += (angle < ball.iris).astype(np.int64) + (angle < ball.pupil)
        return areas


def _within(places: Floats, border: Floats) -> Bools:
    """(p,) which places (p, 2) lie within a closed line (n, 2), by how often a ray to the right crosses it."""
    inside = np.zeros(len(places), dtype=bool)
    for (x0, y0), (x1, y1) in zip(border, np.roll(border, -1, axis=0), strict=True):
        crosses = (y0 > places[:, 1]) != (y1 > places[:, 1])
        if y0 != y1:
            inside ^= crosses & (places[:, 0] < (x1 - x0) * (places[:, 1] - y0) / (y1 - y0) + x0)
    return inside
