"""The template face of the anatomy tables, and the warp from it onto a particular face.

Muscles, windows and axes are written once, on the template, as positions in head space. A smooth warp through the
feature points that both faces have carries them to any other face. Source: thin-plate-like radial basis
interpolation with a linear kernel and an affine part, see the transfer step of `docs/muscles.md`.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ...arrays import Floats
from ...tables import read_csv
from ..figures import ANATOMY

if TYPE_CHECKING:
    from scipy.interpolate import RBFInterpolator

MM = 1e-3

#: Groups of feature points on skin or eyes that carry the warp (the standard's groups 2-5 and 8-11), but not the teeth.
WARP_GROUPS = ("2", "3", "4", "5", "8", "9", "10", "11")
TEETH_POINTS = ("9.8", "9.9", "9.10", "9.11")

#: How much the warp may pass beside feature points, which are placed by hand (scipy's `smoothing`, in millimetres).
WARP_SMOOTHING = 3.0


def _read_points() -> dict[str, Floats]:
    """Rows of presets/anatomy/template_points.csv in metres of head space."""
    rows = read_csv(ANATOMY / "template_points.csv")
    return {row.text("feature_point"): MM * np.array([row.number(axis) for axis in "xyz"]) for row in rows}


#: Feature point -> (3,) position in head space (metres) on the template face.
TEMPLATE_POINTS: Mapping[str, Floats] = _read_points()


class TemplateWarp:
    """Carries positions of the template onto one face, both in head space."""

    def __init__(self, points: Mapping[str, Floats]) -> None:
        """Fit to a face's own feature points: name -> (3,) in head space (metres)."""
        carriers = [n for n in TEMPLATE_POINTS if n.split(".")[0] in WARP_GROUPS and n not in TEETH_POINTS]
        names = [n for n in carriers if n in points]
        self._source = np.array([TEMPLATE_POINTS[n] for n in names]) / MM
        self._target = np.array([points[n] for n in names]) / MM

    @cached_property
    def _offset(self) -> RBFInterpolator:
        """How far places of the template, in millimetres, are from their places on the face."""
        from scipy.interpolate import RBFInterpolator  # tables are read where SciPy is missing too

        way = self._target - self._source
        return RBFInterpolator(self._source, way, kernel="linear", degree=1, smoothing=WARP_SMOOTHING)

    def __call__(self, positions: Floats) -> Floats:
        """Template positions (..., 3) as positions on the face, head space, metres."""
        flat = np.asarray(positions, dtype=np.float64).reshape(-1, 3) / MM
        moved: Floats = (flat + self._offset(flat)) * MM
        return moved.reshape(np.shape(positions))
