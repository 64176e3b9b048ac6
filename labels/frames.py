"""One frame seen: what of it goes into each table, and its pictures of areas, objects, depth and normals."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.spatial.transform import Rotation

from ..arrays import Floats
from ..face.face import Face
from ..face.products.head_motion import head_motion
from ..face.products.landmarks import face_landmarks
from .areas import Areas
from .geometry import Shown
from .marks import Marks
from .pictures import pictures_of
from .png import Pixels
from .raster import Drawn, Triangles, draw
from .tables import Column, Kind, Values
from .view import View

#: Axes of a picture to the subject's left, up and towards the viewer, for a head that looks into the camera.
FACING = np.diag([1.0, -1.0, -1.0])

#: Middles of the upper and the lower lid, and both pupils.
LIDS, PUPILS = {"left": ("3.1", "3.3"), "right": ("3.2", "3.4")}, ("3.5", "3.6")
#: FAPs that turn each eyeball: yaw and pitch; and a degree in units of theirs.
EYES = {"left": (23, 25), "right": (24, 26)}
DEGREE = 180.0 / np.pi * 1e-5

COLUMNS = (
    Column(
        "eye_opening_left",
        Kind.NUMBER,
        "height of the gap between the left lids as a share of the resting one: 1 at rest, 0 shut",
    ),
    Column(
        "eye_opening_right",
        Kind.NUMBER,
        "height of the gap between the right lids as a share of the resting one: 1 at rest, 0 shut",
    ),
    Column("eye_yaw_left", Kind.NUMBER, "turn of the left eye in its socket, to the left (FAP 23)", "degree", 4),
    Column("eye_yaw_right", Kind.NUMBER, "turn of the right eye in its socket, to the left (FAP 24)", "degree", 4),
    Column("eye_pitch_left", Kind.NUMBER, "turn of the left eye in its socket, down (FAP 25)", "degree", 4),
    Column("eye_pitch_right", Kind.NUMBER, "turn of the right eye in its socket, down (FAP 26)", "degree", 4),
    Column("head_yaw", Kind.NUMBER, "turn of the head to the subject's left from looking into the camera", "degree", 4),
    Column("head_pitch", Kind.NUMBER, "turn of the head down from looking into the camera", "degree", 4),
    Column("head_roll", Kind.NUMBER, "turn of the head to its right shoulder in the picture", "degree", 4),
    Column("head_x", Kind.NUMBER, "middle between the eyeballs, in the camera's axes: to the right", "m", 6),
    Column("head_y", Kind.NUMBER, "middle between the eyeballs, in the camera's axes: down", "m", 6),
    Column("head_z", Kind.NUMBER, "middle between the eyeballs, in the camera's axes: away from the camera", "m", 6),
    Column("eye_distance", Kind.NUMBER, "between the pupils (3.5, 3.6) in the picture", "pixel", 3),
)
CAMERA_COLUMNS = (
    Column("frame", Kind.INTEGER, "frame of the timeline, as in the table frames"),
    Column("width", Kind.INTEGER, "of the picture", "pixel"),
    Column("height", Kind.INTEGER, "of the picture", "pixel"),
    Column("perspective", Kind.FLAG, "false: an orthographic camera; fx, fy are then pixels per metre"),
    Column("fx", Kind.NUMBER, "K[0, 0]: focal length", "pixel", 6),
    Column("fy", Kind.NUMBER, "K[1, 1]: focal length", "pixel", 6),
    Column("cx", Kind.NUMBER, "K[0, 2]: principal point, from the left edge", "pixel", 6),
    Column("cy", Kind.NUMBER, "K[1, 2]: principal point, from the upper edge", "pixel", 6),
    *(
        Column(f"r{row}{column}", Kind.NUMBER, f"rotation from world to camera, row {row}, column {column}", "", 9)
        for row in (1, 2, 3)
        for column in (1, 2, 3)
    ),
    *(Column(f"t{axis}", Kind.NUMBER, f"shift from world to camera along {axis}", "m", 6) for axis in "xyz"),
    Column("lens", Kind.NUMBER, "focal length of the lens", "mm", 4),
    Column("sensor_width", Kind.NUMBER, "of the sensor", "mm", 4),
    Column("sensor_height", Kind.NUMBER, "of the sensor", "mm", 4),
)


@dataclass(frozen=True, eq=False)
class Subject:
    """A face whose frames are labelled: what is worked out once."""

    face: Face
    marks: Marks
    areas: Areas

    @classmethod
    def of(cls, face: Face) -> Subject:
        """A face with all landmarks and areas there are."""
        marks = face_landmarks(face)
        border = np.asarray(marks.matrix[marks.lip_border] @ face.vertices)
        return cls(face, Marks.of(face, marks), Areas(face, border))


@dataclass(frozen=True, eq=False)
class Frame:
    """One frame.

    Attributes
    ----------
    positions : (V, 3) of the face's vertices, in the world, metres.
    measured : (68,) FAPs measured on it. shown : all that stands before the camera.
    """

    subject: Subject
    view: View
    positions: Floats
    measured: Floats
    shown: Shown

    @cached_property
    def _motion(self) -> tuple[Floats, Floats]:
        return head_motion(self.subject.face, self.positions)

    @cached_property
    def _triangles(self) -> Triangles:
        return Triangles.of(self.view, self.view.before(self.shown.vertices), self.shown.triangles)

    @cached_property
    def drawn(self) -> Drawn:
        """What every pixel shows."""
        return draw(self._triangles)

    def landmarks(self) -> Mapping[str, Values]:
        """Rows of landmarks, but for the frame."""
        marks, face = self.subject.marks, self.subject.face
        places = marks.places(self.positions, *self._motion)
        hiding = self._triangles.without(self.subject.areas.is_hair(self.shown))
        lids = hiding.without(self.subject.areas.is_eyeball(self.shown))
        return marks.rows(face, self.positions, places, self.view, hiding, lids, face.units.es0)

    def row(self) -> Mapping[str, float]:
        """What the table of frames says of eyes and head."""
        face, (turn, shift) = self.subject.face, self._motion
        row: dict[str, float] = {}
        for side, lids in LIDS.items():
            now, rest = self._gap(lids, self.positions, turn), self._gap(lids, face.vertices, np.eye(3))
            row[f"eye_opening_{side}"] = max(now, 0.0) / rest if rest > 0.0 else np.nan
        for side, numbers in EYES.items():
            for name, number in zip(("yaw", "pitch"), numbers, strict=True):
                row[f"eye_{name}_{side}"] = DEGREE * float(self.measured[number - 1])
        yaw, pitch, roll = np.degrees(self._facing(turn).as_euler("yxz"))
        middle = np.mean([face.points[name].position for name in PUPILS], axis=0)
        head = self.view.before((turn @ middle + shift)[None])[0]
        pupils = self.view.pixels(self.view.before(np.asarray(face.points.matrix(PUPILS) @ self.positions)))
        row |= {"head_yaw": yaw, "head_pitch": pitch, "head_roll": roll}
        row |= {f"head_{axis}": float(value) for axis, value in zip("xyz", head, strict=True)}
        return row | {"eye_distance": float(np.linalg.norm(pupils[0] - pupils[1]))}

    def _gap(self, lids: tuple[str, str], positions: Floats, turn: Floats) -> float:
        """Height of the middle of a lid over that of the other, in a head that is turned: shut lids lie one before
        the other."""
        upper, lower = np.asarray(self.subject.face.points.matrix(lids) @ positions)
        return float((upper - lower) @ turn @ self.subject.face.axes[1])

    def _facing(self, turn: Floats) -> Rotation:
        """The head's turn from looking into the camera, along the subject's left, up and forward."""
        in_picture = FACING @ self.view.rotation @ turn @ self.subject.face.axes.T
        return Rotation.from_matrix(in_picture)

    def camera(self) -> Mapping[str, float]:
        """What the table of cameras says."""
        view = self.view
        (fx, _, cx), (_, fy, cy) = view.intrinsics[:2]
        return {
            "width": view.width,
            "height": view.height,
            "perspective": view.perspective,
            "fx": fx,
            "fy": fy,
            "cx": cx,
            "cy": cy,
            **{f"r{row + 1}{column + 1}": view.rotation[row, column] for row in range(3) for column in range(3)},
            **{f"t{axis}": view.shift[i] for i, axis in enumerate("xyz")},
            "lens": view.lens,
            "sensor_width": view.sensor[0],
            "sensor_height": view.sensor[1],
        }

    def pictures(self) -> Iterator[tuple[str, Pixels]]:
        """Kind and figures of each picture."""
        yield from pictures_of(self.view, self.shown, self.drawn, self.subject.areas)
