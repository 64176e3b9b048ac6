"""The second paper's sphincter (equations 14-17), and one that is drawn along the skin."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...arrays import Floats
from ...physics.muscles import SphincterMuscle
from ..mechanism import Mechanism
from ..skin.outer import OuterSkin
from .ellipse import EllipseRow


@dataclass(frozen=True, kw_only=True, eq=False)
class SphincterRow(EllipseRow):
    """A ring that draws to its centre.

    Attributes
    ----------
    fall : share of its radius over which the pull fades beyond the rim.
    """

    kind: ClassVar[str] = "sphincter"
    of_paper: ClassVar[bool] = True

    fall: float

    def pull(self, skin: OuterSkin) -> Floats:
        """See `MuscleRow`: the equations inside the rim; beyond it the pull fades instead of ending at its maximum.

        It fades in depth too: seen from the front the neck lies within the mouth's ring, but no fibre reaches it.
        """
        wide, high = self.radii
        paper = SphincterMuscle(
            self.centre, np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0]), semi_major=wide, semi_minor=high
        )
        if not skin.has(Mechanism.FADING):
            return paper.force(skin.positions)
        radius, depth = self.elliptic_radius(skin.positions)
        toward = self.centre - skin.positions
        toward = toward / np.maximum(np.linalg.norm(toward, axis=1, keepdims=True), 1e-9)
        outside = np.where(radius > 1.0, np.exp(-(((radius - 1.0) / self.fall) ** 2)), 0.0)
        pull = paper.force(skin.positions) * (radius <= 1.0)[:, None] + outside[:, None] * toward
        return np.asarray(np.exp(-((depth / 2.0) ** 4))[:, None] * pull)


@dataclass(frozen=True, kw_only=True, eq=False)
class SphincterSkinRow(SphincterRow):
    """A sphincter drawn along the skin, heaping it up a little.

    Attributes
    ----------
    bulge : pull along the normal, as a share of that along the skin.
    """

    kind: ClassVar[str] = "sphincter_skin"
    of_paper: ClassVar[bool] = False

    bulge: float

    def pull(self, skin: OuterSkin) -> Floats:
        """See `MuscleRow`."""
        along = skin.tangential(super().pull(skin))
        _, depth = self.elliptic_radius(skin.positions)
        near = np.exp(-(depth**4))[:, None]
        strength = np.linalg.norm(along, axis=1, keepdims=True)
        return np.asarray(near * (along + self.bulge * strength * skin.normals))
