"""How Py-Feat writes the head's turn: in which columns, units and signs; it differs between versions.

Up to version 0.6, `Pitch`, `Roll` and `Yaw` are degrees, up, to the left shoulder and to the subject's right: its
convert_to_euler takes the angles of the transposed rotation about x, y and z of the camera (to the right of the image,
down, away), and turns two of them round. Later tables, which have the head's place (`X`, `Y`, `Z`) beside, are in rad,
and of two kinds: first the angles about x, y and z as they are, so that `Roll` is the turn and `Yaw` the tilt
(feat/utils/face_pose_pnp.py calls it a quirk), then `Pitch` up, `Roll` to the right shoulder and `Yaw` to the subject's
right (feat/detector_v2.py). Nothing names the kind. The tilt is seen in the 68 landmarks, too: it is that of the line
through the eyes.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ....arrays import Floats
from .rotation import euler_matrix
from .table_file import TableFile

TURNS, PLACE = ("Pitch", "Roll", "Yaw"), ("X", "Y", "Z")
#: Outer corners of the eyes among the 68 landmarks: of the right eye, to the left of the image, and of the left one.
CORNERS = (36, 45)
#: A way of writing is certain where it is nearer to the line through the eyes than all others by this angle, rad.
NEARER = np.radians(2.0)


@dataclass(frozen=True, eq=False)
class Turns:
    """What a table says of the head's turn.

    Attributes
    ----------
    rotations : (T, 3, 3) in the camera's axes; NaN where unknown. columns : what was read. said : in words for people.
    """

    rotations: Floats
    columns: tuple[str, ...] = ()
    said: tuple[str, ...] = ()


class Way(NamedTuple):
    """A way of writing: pitch, roll and yaw as rotations (T, 3, 3), and as the tilt (T,) to the left shoulder, rad."""

    name: str
    rotations: Callable[[Floats, Floats, Floats], Floats]
    tilt: Callable[[Floats, Floats, Floats], Floats]


OLD = Way(
    "up to 0.6: degrees",
    lambda pitch, roll, yaw: euler_matrix(*np.radians([-pitch, yaw, roll])),
    lambda pitch, roll, yaw: np.radians(roll),
)
AS_AXES = Way(
    "0.7: rad, with the turn in Roll and the tilt in Yaw",
    lambda pitch, roll, yaw: euler_matrix(-pitch, -roll, -yaw).transpose(0, 2, 1),
    lambda pitch, roll, yaw: yaw,
)
AS_NAMED = Way(
    "0.7: rad, Roll to the right shoulder",
    lambda pitch, roll, yaw: euler_matrix(-pitch, yaw, -roll),
    lambda pitch, roll, yaw: -roll,
)
WAYS = (OLD, AS_AXES, AS_NAMED)


def py_feat_turns(table: TableFile) -> Turns:
    """The turns of a table, where it is certain in which way they are written."""
    unknown = np.full((len(table.rows), 3, 3), np.nan)
    if not all(name in table for name in TURNS):
        return Turns(unknown)
    pitch, roll, yaw = (table.numbers(name) for name in TURNS)
    off = _off_the_eyes(table, [way.tilt(pitch, roll, yaw) for way in WAYS])
    best = int(np.argmin(off))
    is_certain = off[best] + NEARER < np.delete(off, best).min()
    if not any(name in table for name in PLACE):
        if is_certain and WAYS[best] is not OLD:
            return Turns(unknown, said=("its head turns contradict its landmarks: not read",))
        return Turns(OLD.rotations(pitch, roll, yaw), TURNS, (f"head turns as of Py-Feat {OLD.name}",))
    if not is_certain or WAYS[best] is OLD:
        return Turns(unknown, said=("head turns of Py-Feat 0.7 in one of two ways, its landmarks do not tell which",))
    way = WAYS[best]
    return Turns(way.rotations(pitch, roll, yaw), TURNS, (f"head turns as of Py-Feat {way.name}, by its landmarks",))


def _off_the_eyes(table: TableFile, tilts: list[Floats]) -> Floats:
    """By how much tilts (T,) usually differ from the line through the eyes, rad; all 0 where there are no landmarks."""
    names = [f"{axis}_{corner}" for axis in "xy" for corner in CORNERS]
    if not all(name in table for name in names):
        return np.zeros(len(tilts))
    right_x, left_x, right_y, left_y = (table.numbers(name) for name in names)
    apart = np.array(tilts) - np.arctan2(left_y - right_y, left_x - right_x)
    known = apart[:, np.isfinite(apart).all(axis=0)]
    return np.asarray(np.sqrt(np.mean(known**2, axis=1))) if known.size else np.zeros(len(tilts))
