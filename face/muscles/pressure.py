"""Air pressure in the cheek's pouch, which is no muscle."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...arrays import Floats
from ..mechanisms.lips import off_lips
from ..mechanisms.sliding import sliding
from ..skin.outer import OuterSkin
from .ellipse import EllipseRow


@dataclass(frozen=True, kw_only=True, eq=False)
class PressureRow(EllipseRow):
    """Pressure along the skin's normal.

    Attributes
    ----------
    bulge : 1 outwards, -1 inwards.
    """

    kind: ClassVar[str] = "pressure"

    bulge: float

    def pull(self, skin: OuterSkin) -> Floats:
        """See `MuscleRow`.

        No bone lies under the pouch, so the pressure makes up for what the skull takes from motion along the normal
        elsewhere, and closed lips hold the mouth's corner; otherwise the corner would swell more than the cheek.
        """
        radius, depth = self.elliptic_radius(skin.positions)
        strength = self.bulge * np.exp(-(radius**2) - depth**4) * off_lips(skin) / (1.0 - sliding(skin))
        return np.asarray(strength[:, None] * skin.normals)
