"""Buccinator: dimples (AU 14) and lips drawn to one side.

Anatomy. It comes from both jaws behind the cheek to the mouth's corner. Fibres that end there draw the corner in and
back against the teeth: the dimple. Fibres that cross into the lips draw both lips to the side, and lips lie on teeth:
they go round the dental arch, so that the side that leads goes back and the side that follows comes forward.

Rows (presets/anatomy/muscles/buccinator.toml): buccinator (linear, equations 6-13), buccinator_lips (arch). As one
row, any wider corner dragged the lips' middle along.

What the second paper's model lacks and is added here: a pull along the arch, which no straight line gives.

Source: FACS muscle list (docs/sources.md) for the lines of action; own calibration on a scanned mouth drawn aside. No
scan at hand shows a dimple: anatomy alone.
"""

from __future__ import annotations

import numpy as np

from ...arrays import Floats
from ..muscles.placement import PlacedMuscle
from ..skin.outer import OuterSkin


def arch(skin: OuterSkin, muscle: PlacedMuscle) -> Floats:
    """(n, 3) a band drawn to the muscle's own side along the dental arch, a circle about an upright axis."""
    radius, depth = muscle.elliptic_radius(skin.positions)
    turn = (skin.positions[:, 0] - skin.points["8.1"][0]) / muscle.row.arch
    along = np.stack([np.ones_like(turn), np.zeros_like(turn), -turn], axis=1)
    along *= muscle.side / np.linalg.norm(along, axis=1, keepdims=True)
    return np.asarray(np.exp(-(radius**2) - depth**4)[:, None] * along)
