"""A band drawn to the muscle's own side along the dental arch, which no straight line of pull gives."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...arrays import Floats
from ..skin.outer import OuterSkin
from .ellipse import EllipseRow
from .figures import Length


@dataclass(frozen=True, kw_only=True, eq=False)
class ArchRow(EllipseRow):
    """A band on the teeth.

    Attributes
    ----------
    arch : radius of the dental arch, a circle about an upright axis.
    """

    kind: ClassVar[str] = "arch"

    arch: Length

    def pull(self, skin: OuterSkin) -> Floats:
        """See `MuscleRow`."""
        radius, depth = self.elliptic_radius(skin.positions)
        turn = (skin.positions[:, 0] - skin.points["8.1"][0]) / self.arch
        along = np.stack([np.ones_like(turn), np.zeros_like(turn), -turn], axis=1)
        along *= self.side / np.linalg.norm(along, axis=1, keepdims=True)
        return np.asarray(np.exp(-(radius**2) - depth**4)[:, None] * along)
