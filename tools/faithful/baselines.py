"""Ways of moving a face that know its feature points and nothing else, to measure the muscles and the skin against.

Each is given its best chance: points that no FAP moves hold still where that helps, and the zones have the radius
that serves these very scans best.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from risorius.api import Drive, Face
from risorius.arrays import Floats
from risorius.face.mesh.template import MM
from scipy.interpolate import RBFInterpolator

from .scans import Shape, posed

Model = Callable[[Shape], Floats]

#: Radius of a point's zone; 25 to 30 mm serve the scans best (20 mm: 0.03 less, 40 mm: 0.06 less).
ZONE_RADIUS = 25 * MM

#: Groups of feature points on the skin; the rest are eyes, tongue, teeth, the spine's pivot.
_SKIN_GROUPS = ("2", "3", "4", "5", "8", "9", "10", "11")


def baselines(face: Face) -> Mapping[str, Model]:
    """Name -> model, on one face."""
    return {"zones": zones(face), "spline": spline(face), "points": posed(face, Drive.POINTS)}


def zones(face: Face, radius: float = ZONE_RADIUS) -> Model:
    """Raised-cosine zones round each point, as players of FAP streams have them; where zones overlap they share."""
    names, centres = _moving_points(face)

    def model(shape: Shape) -> Floats:
        at_rest = face.anatomy.mesh.positions[shape.skin]
        distance = np.linalg.norm(at_rest[:, None] - centres, axis=2)
        weight = 0.5 + 0.5 * np.cos(np.pi * np.minimum(distance / radius, 1.0))
        weight /= np.maximum(weight.sum(axis=1, keepdims=True), 1.0)
        moved: Floats = weight @ _wanted(face, names, shape.frame)
        return moved

    return model


def spline(face: Face) -> Model:
    """The thin-plate spline in space (the biharmonic kernel, a distance) through all points; those without FAP rest."""
    names, centres = _moving_points(face)
    landmarks = face.anatomy.mesh.landmarks
    still = np.array([p for n, p in landmarks.items() if n not in names and n.split(".")[0] in _SKIN_GROUPS])
    places = np.concatenate([centres, np.unique(still, axis=0)])  # the crown may be two points at one place

    def model(shape: Shape) -> Floats:
        wanted = np.zeros_like(places)
        wanted[: len(names)] = _wanted(face, names, shape.frame)
        through = RBFInterpolator(places, wanted, kernel="linear", degree=1)
        moved: Floats = through(face.anatomy.mesh.positions[shape.skin])
        return moved

    return model


def _moving_points(face: Face) -> tuple[list[str], Floats]:
    """The points of the skin that FAPs move, and their places (p, 3) in head space."""
    names = sorted(set(face.anatomy.skin_rows.names))
    return names, np.array([face.anatomy.mesh.landmarks[name] for name in names])


def _wanted(face: Face, names: list[str], frame: Floats) -> Floats:
    """(p, 3) displacement of these points that a frame (68,) asks for, in head space."""
    rows = face.anatomy.skin_rows
    wanted = np.zeros((len(names), 3))
    for name, direction, way in zip(rows.names, rows.directions, np.nan_to_num(rows.select(frame)), strict=True):
        wanted[names.index(name)] += direction * way
    return wanted
