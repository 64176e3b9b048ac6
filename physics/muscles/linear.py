"""The linear muscle: fibres from one point of bone, pulling the skin around its insertion toward that point."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ...arrays import Floats
from ...errors import ParameterError
from .windows import angular, directions, finite_array, longitudinal, positive


@dataclass(frozen=True, eq=False)
class LinearMuscle:
    """A linear muscle; Zhang, Sung and Prakash 2001, section 3.1, equations (6)-(13).

    Parameters
    ----------
    attachment : m^A (3,) m, on the skull.
    insertion : m^I (3,) m, in the skin.
    radius : R_j, m, from the attachment to the end of its zone; longer than the muscle (delta > 1).
    angle : phi_j, rad, largest angle from the muscle's line, in (0, pi/2].
    exponent : eta_j > 0; smaller spreads the influence along the muscle.
    scale : alpha_L, N, the force at the insertion at contraction 1.

    Raises
    ------
    ParameterError : a figure outside its rule.
    """

    attachment: Floats
    insertion: Floats
    radius: float = field(kw_only=True)
    angle: float = field(kw_only=True)
    exponent: float = field(kw_only=True)
    scale: float = field(default=1.0, kw_only=True)

    def __post_init__(self) -> None:
        object.__setattr__(self, "attachment", finite_array("attachment", self.attachment, (3,)))
        object.__setattr__(self, "insertion", finite_array("insertion", self.insertion, (3,)))
        if not self.length > 0:
            raise ParameterError("insertion", "must differ from the attachment", self.insertion.tolist())
        if not (np.isfinite(self.radius) and self.radius > self.length):
            raise ParameterError(
                "radius", f"must exceed the muscle's length {self.length:.4g} m (delta > 1, eq. 11)", self.radius
            )
        if not 0 < self.angle <= np.pi / 2:
            raise ParameterError("angle", "must be in (0, pi/2] rad", self.angle)
        positive("exponent", self.exponent)
        positive("scale", self.scale)

    @property
    def length(self) -> float:
        """From attachment to insertion, m."""
        return float(np.linalg.norm(self.attachment - self.insertion))

    def force(self, positions: Floats) -> Floats:
        """Force at contraction 1 on nodes at `positions` (V, 3) m: (V, 3) N, equation (9).

        Zero outside the zone: beyond the radius, outside the angle, behind and at the attachment.
        """
        force = np.zeros((len(positions), 3))
        toward = self.attachment - np.asarray(positions, dtype=np.float64)
        squared = np.einsum("vi,vi->v", toward, toward)
        near = np.flatnonzero(squared <= self.radius**2)  # most skin is beyond the zone
        force[near] = self._within(toward[near], np.sqrt(squared[near]))
        return force

    def _within(self, toward: Floats, distance: Floats) -> Floats:
        """Force on nodes by their way to the attachment (k, 3) and its length (k,) (6), no longer than the radius."""
        unit = directions(toward, distance)  # (10)
        axis = (self.attachment - self.insertion) / self.length
        # The angle from its tangent keeps its digits near the axis, where arccos loses half of them.
        node_angle = np.arctan2(np.linalg.norm(np.cross(unit, axis), axis=1), unit @ axis)
        along = longitudinal(distance / self.length, self.radius / self.length, self.exponent)  # (7), (11), (12)
        across = angular(node_angle / self.angle, self.angle)  # (8), (13)
        return np.asarray((self.scale * along * across)[:, None] * unit)
