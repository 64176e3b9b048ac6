"""A band of the lip's margin with a fixed line of pull, which no contraction towards a centre gives."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...arrays import Floats
from ..skin.outer import OuterSkin
from .ellipse import EllipseRow
from .figures import Direction


@dataclass(frozen=True, kw_only=True, eq=False)
class BandRow(EllipseRow):
    """A band.

    Attributes
    ----------
    direction : (3,) line of pull.
    """

    kind: ClassVar[str] = "band"

    direction: Direction

    def pull(self, skin: OuterSkin) -> Floats:
        """See `MuscleRow`."""
        radius, depth = self.elliptic_radius(skin.positions)
        return np.asarray(np.exp(-(radius**2) - depth**4)[:, None] * self.direction)
