"""The second paper's linear muscle (equations 6-13): from a point of the bone to a point of the skin."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...arrays import Floats
from ...physics.muscles import LinearMuscle
from ..mechanism import Mechanism
from ..skin.outer import OuterSkin
from .figures import Angle, Place
from .span import SpanRow


@dataclass(frozen=True, kw_only=True, eq=False)
class LinearRow(SpanRow):
    """Figures of the equations: phi, eta and delta = R / |A - I|.

    Attributes
    ----------
    along_skin : share of the pull that follows the skin: superficial muscles (depressors, risorius) pull along the skin
        that they lie in, not along a chord through it.
    """

    kind: ClassVar[str] = "linear"
    of_paper: ClassVar[bool] = True

    attachment: Place
    insertion: Place
    angle: Angle
    exponent: float
    reach: float
    along_skin: float = 0.0

    def pull(self, skin: OuterSkin) -> Floats:
        """See `MuscleRow`."""
        length = float(np.linalg.norm(self.insertion - self.attachment))
        paper = LinearMuscle(
            self.attachment, self.insertion, radius=self.reach * length, angle=self.angle, exponent=self.exponent
        )
        force = paper.force(skin.positions)
        if self.along_skin == 0.0 or not skin.has(Mechanism.SUPERFICIAL):
            return force
        return np.asarray(force + self.along_skin * (skin.tangential(force) - force))
