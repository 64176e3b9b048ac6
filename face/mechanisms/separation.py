"""Upper and lower lip, upper and lower lid, told apart by distance along the skin.

At rest the lips touch: through the air a muscle of one lip is as near to the other. The skin itself is open there, so
that the way along it from one lip to the other leads round the mouth's corner. What the second paper's zones (spheres,
cones, rectangles) lack is this: each muscle pulls only on the side that it inserts in. Without it distances are taken
through the air, and each muscle pulls on both.

Source: anatomy of the insertions after the FACS muscle list (docs/sources.md).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arrays import Floats
from ..figures import Length, read_figures
from ..skin.outer import OuterSkin, nearer_side


@dataclass(frozen=True)
class SeparationFigures:
    """Widths along the skin of the change from side to side beside the corners (presets/anatomy/skin.toml)."""

    lips: Length
    lids: Length


SEPARATION = read_figures("skin.separation", SeparationFigures)


def upper_lip_side(skin: OuterSkin, width: float = SEPARATION.lips) -> Floats:
    """(n,) 1 on the upper lip's side of the skin, 0 on the lower lip's; beside the corners it changes over `width`."""
    upper, lower = skin.lip_distances
    return nearer_side(lower - upper, width)


def lower_lid_side(skin: OuterSkin) -> Floats:
    """(n,) 1 on the lower lids' side of both eyes, 0 on an upper lid's."""
    by = np.min([upper - lower for upper, lower in (skin.lid_distances(side) for side in "lr")], axis=0)
    return nearer_side(by, SEPARATION.lids)
