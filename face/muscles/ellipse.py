"""Muscles that lie in the skin, in an ellipse as seen from the front."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arrays import Floats
from ..figures import read_figures
from .figures import Place, Radii
from .row import MuscleRow


@dataclass(frozen=True)
class EllipseFigures:
    """Of every ellipse (presets/anatomy/skin.toml)."""

    depth: float


ELLIPSE = read_figures("skin.ellipse", EllipseFigures)

#: Points of half a ring to look at.
AROUND = 13


@dataclass(frozen=True, kw_only=True, eq=False)
class EllipseRow(MuscleRow):
    """A muscle round a centre (3,), with the radii to the side and up."""

    centre: Place
    radii: Radii

    def elliptic_radius(self, positions: Floats) -> tuple[Floats, Floats]:
        """Of positions (n, 3): elliptic radius (n,) in the frontal plane, and depth from the centre, in radii."""
        away = positions - self.centre
        wide, high = self.radii
        return np.hypot(away[:, 0] / wide, away[:, 1] / high), away[:, 2] / (ELLIPSE.depth * max(wide, high))

    def strands(self) -> tuple[Floats, Floats]:
        """The half of a ring on the muscle's own side, as wide and high as it reaches; all of it goes with the skin."""
        wide, high = self.radii
        angle = np.linspace(-np.pi / 2.0, np.pi / 2.0, AROUND)
        out = np.stack([self.side * wide * np.cos(angle), high * np.sin(angle), np.zeros(AROUND)], axis=1)
        return (self.centre + out)[None], np.ones(AROUND)
