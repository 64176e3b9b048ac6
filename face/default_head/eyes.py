"""The eyeballs: spheres whose rings follow pupil, iris and limbus."""

from __future__ import annotations

import numpy as np

from ...arrays import Floats
from ..mesh.parts import Part
from .figures import EyeballFigures
from .piece import Piece, fan_quads, tube_quads

SEGMENTS = 32
PUPIL_VERTEX = 0  # the front pole comes first: feature points 3.5 and 3.6


def build_eyeball(figures: EyeballFigures) -> Piece:
    """Left eyeball, looking along -Y; vertex 0 is the centre of the pupil."""
    angles, bands = _rings(figures)
    around = 2.0 * np.pi * np.arange(SEGMENTS) / SEGMENTS
    across, back = np.sin(angles)[:, None], np.cos(angles)[:, None]
    y = np.broadcast_to(-back, (len(angles), SEGMENTS))
    ring = np.stack([across * np.cos(around), y, across * np.sin(around)], axis=-1)
    poles = np.array([[0.0, -1.0, 0.0], [0.0, 1.0, 0.0]])
    sphere = np.concatenate([poles[:1], ring.reshape(-1, 3), poles[1:]])
    first, last = np.arange(SEGMENTS) + 1, np.arange(SEGMENTS) + 1 + SEGMENTS * (len(angles) - 1)
    quads = np.concatenate(
        [fan_quads(0, first), tube_quads(len(angles), SEGMENTS) + 1, fan_quads(len(sphere) - 1, last)[:, ::-1]]
    )
    materials = ("pupil",) * (SEGMENTS // 2)
    materials += tuple(band for band in bands for _ in range(SEGMENTS)) + ("sclera",) * (SEGMENTS // 2)
    return Piece(figures.centre + figures.radius * sphere, quads, Part.EYEBALL_L, materials)


def _rings(figures: EyeballFigures) -> tuple[Floats, list[str]]:
    """Polar angles of the rings from the pupil backwards, and the material between consecutive rings."""
    pupil, iris = figures.pupil_radius, figures.iris_radius
    limbus = iris * (1.0 - figures.limbus)
    radii = np.array([0.5 * pupil, pupil, *np.linspace(pupil, limbus, 4)[1:], iris])
    front = np.arcsin(radii / figures.radius)
    behind = np.linspace(front[-1], np.pi, 15)[1:-1]
    bands = ["pupil", "iris_inner", *("iris",) * 2, "limbus", *("sclera",) * len(behind)]
    return np.concatenate([front, behind]), bands
