"""Landmarks of a face in each frame: where they are in the world and in the picture, and whether they are seen."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy import sparse

from ..arrays import Bools, Floats
from ..face.face import Face
from ..face.products.landmarks import Landmarks
from ..face.tracked.mediapipe_landmarks import landmark_numbers
from ..mpeg4 import FEATURE_POINTS
from ..physics.mesh import Sparse, vertex_normals
from .raster import Triangles, nearest
from .tables import Column, Kind, Values
from .view import View

#: A landmark is hidden by what lies before it by more than this share of the distance of the pupils: 1 mm on a
#: life-size head. A mark is the mean of several vertices and may lie that far under a curved skin. Lids lie closer
#: before an eyeball: what is on one is hidden by all that lies before it and is no eyeball.
HIDDEN_BY = 1.0 / 63.0

MPEG4, IBUG68, MEDIAPIPE478 = "mpeg4", "ibug68", "mediapipe478"

COLUMNS = (
    Column("frame", Kind.INTEGER, "frame of the timeline, as in the table frames"),
    Column("set", Kind.TEXT, "which landmarks: mpeg4 (feature points), ibug68 or mediapipe478"),
    Column("index", Kind.INTEGER, "number within its set, from 0, as the set counts"),
    Column(
        "name",
        Kind.TEXT,
        "feature point that it is, if any; of ibug68, part of the face",
    ),
    Column("x", Kind.NUMBER, "to the right from the left edge of the picture", "pixel", 3),
    Column("y", Kind.NUMBER, "down from the upper edge of the picture", "pixel", 3),
    Column("visible", Kind.FLAG, "in the picture and not hidden"),
    Column("in_picture", Kind.FLAG, "within the borders of the picture, before the camera"),
    Column(
        "hidden",
        Kind.FLAG,
        "something but brows, lashes, beard lies before it, by over 1/63 of the eyes' distance; before what is on an "
        "eyeball, anything but an eyeball",
    ),
    Column("facing", Kind.FLAG, "its surface faces the camera"),
    Column("camera_x", Kind.NUMBER, "in the camera's axes: to the right of the picture", "m", 6),
    Column("camera_y", Kind.NUMBER, "in the camera's axes: down the picture", "m", 6),
    Column("camera_z", Kind.NUMBER, "in the camera's axes: away from the camera", "m", 6),
    Column("world_x", Kind.NUMBER, "in the world of the scene", "m", 6),
    Column("world_y", Kind.NUMBER, "in the world of the scene", "m", 6),
    Column("world_z", Kind.NUMBER, "in the world of the scene", "m", 6),
)
KEY = ("frame", "set", "index")


@dataclass(frozen=True, eq=False)
class Marks:
    """Landmarks of one face.

    Attributes
    ----------
    sets : set, index and name of each.
    matrix : (n, V) reads them off the face's vertices; a row of nothing where the face has no such one.
    rest : (n, 3) on the resting face, in its coordinates; NaN where it has no such one.
    on_eye : (n,) which lie on an eyeball.
    """

    sets: Sequence[tuple[str, int, str]]
    matrix: Sparse
    rest: Floats
    on_eye: Bools

    @classmethod
    def of(cls, face: Face, marks: Landmarks) -> Marks:
        """All landmarks there are of a face: MPEG-4's feature points, iBUG's, MediaPipe's."""
        named = {number: name for name, number in landmark_numbers().items()}
        ibug = [(IBUG68, index, part) for index, part in enumerate(marks.parts)]
        mediapipe = [(MEDIAPIPE478, index, named.get(index, "")) for index in range(marks.matrix.shape[0])]
        points = cls.feature_points(face)
        matrix = sparse.vstack([points.matrix, marks.matrix[marks.ibug68], marks.matrix], format="csr")
        nowhere = np.full((len(ibug) + len(mediapipe), 3), np.nan)
        rest = np.concatenate([points.rest, nowhere])
        return cls([*points.sets, *ibug, *mediapipe], matrix, rest, _on_eye(face, matrix))

    @classmethod
    def feature_points(cls, face: Face) -> Marks:
        """The feature points of MPEG-4, all of them; those off the surface go with the skull."""
        names = list(FEATURE_POINTS)
        have = face.points
        rows = [row for row, name in enumerate(names) if name in have]
        held = sparse.coo_array(have.matrix([names[row] for row in rows]))
        matrix = sparse.coo_array(
            (held.data, (np.array(rows)[held.row], held.col)), shape=(len(names), len(face.vertices))
        ).tocsr()
        rest = np.array([have[name].position if name in have else np.full(3, np.nan) for name in names])
        return cls([(MPEG4, index, name) for index, name in enumerate(names)], matrix, rest, _on_eye(face, matrix))

    def places(self, positions: Floats, turn: Floats, shift: Floats) -> Floats:
        """(n, 3) where they are on deformed vertices (V, 3) whose skull has gone so; NaN where there is no such one."""
        held: Floats = np.asarray(self.matrix @ np.ones((len(positions), 1)))
        return np.where(held > 0.0, np.asarray(self.matrix @ positions), self.rest @ turn.T + shift)

    def rows(
        self, face: Face, positions: Floats, places: Floats, view: View, hiding: Triangles, lids: Triangles, size: float
    ) -> Mapping[str, Values]:
        """What a table says of them in one frame, but for the frame.

        Parameters
        ----------
        positions : (V, 3) of the face's vertices, places (n, 3) of the landmarks, in the world, metres.
        hiding : triangles that hide what lies behind them; lids : those but for eyeballs.
        size : distance of the pupils, metres.
        """
        before = view.before(places)
        pixels = view.pixels(before)
        inside = view.within(pixels) & (before[:, 2] > view.near) & (before[:, 2] < view.far)
        hidden = nearest(hiding, np.where(inside[:, None], pixels, np.nan)) < before[:, 2] - HIDDEN_BY * size
        behind_lids = nearest(lids, np.where((inside & self.on_eye)[:, None], pixels, np.nan)) < before[:, 2]
        normals = np.asarray(self.matrix @ vertex_normals(positions, face.polygons))
        away = (normals @ view.rotation.T * view.toward(before)).sum(axis=1)
        return {
            "set": [name for name, _, _ in self.sets],
            "index": np.array([index for _, index, _ in self.sets]),
            "name": [name for _, _, name in self.sets],
            "x": pixels[:, 0],
            "y": pixels[:, 1],
            "visible": inside & ~hidden & ~behind_lids,
            "in_picture": inside,
            "hidden": hidden | behind_lids,
            "facing": away < 0.0,
            **{f"camera_{axis}": before[:, i] for i, axis in enumerate("xyz")},
            **{f"world_{axis}": places[:, i] for i, axis in enumerate("xyz")},
        }


def _on_eye(face: Face, matrix: Sparse) -> Bools:
    """(n,) which landmarks, rows of a matrix (n, V), lie on an eyeball."""
    of_eyes = np.zeros(len(face.vertices))
    for ball in face.eyeballs:
        of_eyes[ball.vertices] = 1.0
    return np.asarray(matrix @ of_eyes > 0.5)
