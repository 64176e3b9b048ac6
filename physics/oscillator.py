"""A damped second-order response: how a rigid thing on springs, such as the mandible, follows what is asked of it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import expm

from ..arrays import Floats
from ..errors import ParameterError


@dataclass(frozen=True)
class Oscillator:
    """y'' = w^2 (target - y) - 2 r w y', with w = 2 pi frequency; exact for a target that changes evenly over a step.

    Parameters
    ----------
    frequency : Hz, undamped, above 0.
    damping_ratio : r, relative to critical damping, >= 0.

    Raises
    ------
    ParameterError : a figure outside its rule.
    """

    frequency: float
    damping_ratio: float

    def __post_init__(self) -> None:
        if not (np.isfinite(self.frequency) and self.frequency > 0):
            raise ParameterError("frequency", "must be above 0 Hz", self.frequency)
        if not (np.isfinite(self.damping_ratio) and self.damping_ratio >= 0):
            raise ParameterError("damping_ratio", "must be 0 or more", self.damping_ratio)

    def propagator(self, step: float) -> Floats:
        """(2, 4) what a step (s) makes of (y, y', target, target'): y and y' at its end."""
        omega = 2.0 * np.pi * self.frequency
        rates = np.zeros((4, 4))
        rates[0, 1] = rates[2, 3] = 1.0
        rates[1, :3] = -(omega**2), -2.0 * self.damping_ratio * omega, omega**2
        after: Floats = expm(step * rates)[:2]
        return after
