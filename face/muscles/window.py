"""A short sheet with a fixed line of pull in an elliptic window: the bone that turns its pull is not in the model."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...arrays import Floats
from ..skin.outer import OuterSkin
from .ellipse import EllipseRow
from .figures import Direction


@dataclass(frozen=True, kw_only=True, eq=False)
class WindowRow(EllipseRow):
    """A window.

    Attributes
    ----------
    power : of the pull's fall to the rim, cos(r^power pi / 2). direction : (3,) line of pull.
    """

    kind: ClassVar[str] = "window"

    power: float
    direction: Direction

    def pull(self, skin: OuterSkin) -> Floats:
        """See `MuscleRow`."""
        radius, depth = self.elliptic_radius(skin.positions)
        reach = np.minimum(np.hypot(radius, depth), 1.0)
        weight = np.cos(reach**self.power * np.pi / 2.0)
        return np.asarray(weight[:, None] * self.direction)
