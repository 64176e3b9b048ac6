"""The sphincter: fibres around an opening, drawing the skin toward a virtual centre."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ...arrays import Floats
from ...errors import ParameterError
from .windows import directions, finite_array, positive

_UNIT = 1e-4
"""How far an axis may be from unit length, and two axes from a right angle: single-precision input passes."""


@dataclass(frozen=True, eq=False)
class SphincterMuscle:
    """A sphincter muscle; Zhang, Sung and Prakash 2001, section 3.2, equations (14)-(17).

    Its zone is an ellipse in its own plane; off the plane it is the cylinder above that ellipse, so a muscle placed
    on a face is to be masked to the skin it lies in. As printed, the force is zero at the centre and largest at
    the rim. A centre set in front of the plane turns the pull into a protrusion.

    Parameters
    ----------
    centre : o (3,) m.
    major_axis, minor_axis : (3,) unit vectors at a right angle that span its plane.
    semi_major, semi_minor : a and b, m.
    scale : alpha_s, N, the force at the rim at contraction 1.

    Raises
    ------
    ParameterError : a figure outside its rule.
    """

    centre: Floats
    major_axis: Floats
    minor_axis: Floats
    semi_major: float = field(kw_only=True)
    semi_minor: float = field(kw_only=True)
    scale: float = field(default=1.0, kw_only=True)

    def __post_init__(self) -> None:
        object.__setattr__(self, "centre", finite_array("centre", self.centre, (3,)))
        for name in ("major_axis", "minor_axis"):
            axis = finite_array(name, getattr(self, name), (3,))
            length = float(np.linalg.norm(axis))
            if abs(length - 1) > _UNIT:
                raise ParameterError(name, "must be a unit vector; divide it by its length", axis.tolist())
            object.__setattr__(self, name, finite_array(name, axis / length, (3,)))
        cosine = float(self.major_axis @ self.minor_axis)
        if abs(cosine) > _UNIT:
            raise ParameterError("minor_axis", "must be perpendicular to major_axis (dot product 0)", cosine)
        positive("semi_major", self.semi_major)
        positive("semi_minor", self.semi_minor)
        positive("scale", self.scale)

    def radius(self, positions: Floats) -> Floats:
        """Elliptic radius d of nodes at `positions` (V, 3) m in the muscle's own axes: (V,), 1 on the rim; eq. (17)."""
        offset = np.asarray(positions, dtype=np.float64) - self.centre
        x, y = offset @ self.major_axis, offset @ self.minor_axis
        a, b = self.semi_major, self.semi_minor
        return np.asarray(np.sqrt(y**2 * a**2 + x**2 * b**2) / (a * b))

    def force(self, positions: Floats) -> Floats:
        """Force at contraction 1 on nodes at `positions` (V, 3) m: (V, 3) N, eq. (14). Zero outside the ellipse."""
        toward = self.centre - np.asarray(positions, dtype=np.float64)
        unit = directions(toward, np.linalg.norm(toward, axis=1))  # (15)
        d = self.radius(positions)
        window = np.where(d <= 1, np.cos((1 - d) * (np.pi / 2)), 0.0)  # (16)
        return np.asarray((self.scale * window)[:, None] * unit)
