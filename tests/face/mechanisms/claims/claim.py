"""A claim about a mechanism, and ways to move a face and see how far it goes."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from risorius.api import Face, Mechanism
from risorius.face.response.pulls import pulls_of

SILENT = np.full(68, np.nan)
MM = 1e-3


@dataclass(frozen=True)
class Claim:
    """What a mechanism is for: a figure that is above a limit with it, and below without it; on one of the heads."""

    mechanism: Mechanism
    figure: Callable[[Face], float]
    limit: float
    head: str = "default"


@dataclass(frozen=True)
class Moved:
    """A posed face: displacement of its outer skin (n, 3) in head space, mm, and of a place on it."""

    face: Face
    skin: np.ndarray

    def at(self, place: str | np.ndarray) -> np.ndarray:
        """Displacement (3,) of a feature point, or of the skin nearest to a place (3,) in head space, metres."""
        sheet = self.face.anatomy.skin
        target = sheet.points[place] if isinstance(place, str) else place
        return self.skin[np.argmin(np.linalg.norm(sheet.positions - target, axis=1))]


def shown(face: Face, positions: np.ndarray) -> Moved:
    """How far positions (V, 3) are from rest."""
    mesh = face.anatomy.mesh
    moved = mesh.head_frame.to_head(positions) - mesh.positions
    return Moved(face, moved[face.anatomy.skin.index] / MM)


def posed(face: Face, faps: Mapping[int, float], drive: str = "muscles") -> Moved:
    """The face posed from some FAPs."""
    frame = SILENT.copy()
    for number, value in faps.items():
        frame[number - 1] = value
    return shown(face, face.pose(frame, drive=drive).positions)


def contracted(face: Face, *prefixes: str) -> Moved:
    """The low-strain response to every muscle whose name begins so, at its amplitude; a face may have none of them."""
    anatomy = face.anatomy
    chosen = [muscle for name, muscle in face.muscles.items() if name.startswith(prefixes)]
    pulls = pulls_of(anatomy.skin, anatomy.sheet, chosen)
    amounts = [muscle.amplitude / MM for muscle in pulls.muscles]
    return Moved(face, np.tensordot(amounts, pulls.fields, axes=1))


def pulled(face: Face, *points: str) -> Moved:
    """What shows when the skin alone is pulled upwards at some feature points."""
    sheet, load = face.anatomy.skin, np.zeros((1, face.anatomy.skin.vertex_count, 3))
    for point in points:
        load[0, np.argmin(np.linalg.norm(sheet.positions - sheet.points[point], axis=1)), 1] = 1.0
    return Moved(face, face.anatomy.sheet.point_responses(load)[0])


def place(face: Face, point: str, x: float, y: float, z: float) -> np.ndarray:
    """A place (3,) in head space so many mm from a feature point."""
    return face.anatomy.skin.points[point] + np.array([x, y, z]) * MM


def upper_margin(face: Face, side: str) -> np.ndarray:
    """The middle half of an upper lid's edge."""
    arc = face.anatomy.skin.eyes[side].upper
    return arc[len(arc) // 4 : -len(arc) // 4]
