"""Nasolabial fold: a line that the skin is tied to, and the fat above it that heaps up when a raised lip pushes it.

Anatomy. Beside the nose and above the mouth's corner lie the deep pads of the cheek's fat; at the nasolabial fold they
end, since there the fibres of the lip's raisers go through to the skin and hold it. A lip or a wing that is raised
slides under that edge: what is above the fold has nowhere to go but forward, and the fold deepens.

What the second paper's model lacks and is added here: how much more the skin above the fold comes forward than other
skin when it is drawn together (`bulge.py`). Below the fold, on the lip's side, it does so no more than elsewhere.

Source: anatomy of the fold (docs/sources.md); figures: own calibration on scanned raised lips, wrinkled noses, smiles
(docs/muscles.md).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arrays import Floats
from ..figures import Length, Place, Share, read_figures
from ..skin.outer import OuterSkin, smoothstep

#: Wing of the nose and corner of the mouth of each side, and the sign of its x.
SIDES = (("9.1", "8.3", 1.0), ("9.2", "8.4", -1.0))


@dataclass(frozen=True, eq=False)
class NasolabialFigures:
    """Where the fold runs and what lies above it (presets/anatomy/regions.toml)."""

    from_wing: Place
    from_corner: Place
    height: Length
    over: Length
    reach: Length
    before: Length
    past: Length
    thin: Share


NASOLABIAL = read_figures("regions.nasolabial", NasolabialFigures)


def heaping(skin: OuterSkin) -> Floats:
    """(n,) height by which fat above the folds heaps up per unit of surface compression, metres, beside all skin's."""
    height: Floats = np.zeros(skin.vertex_count)
    for wing, corner, side in SIDES:
        if wing not in skin.points:
            continue
        turn = np.array([side, 1.0, 1.0])
        top = skin.points[wing] + turn * NASOLABIAL.from_wing
        end = skin.points[corner] + turn * NASOLABIAL.from_corner
        along, outwards, length = _beside(skin.positions, top, end, side)
        beyond = np.maximum(outwards - NASOLABIAL.over, 0.0) / NASOLABIAL.reach
        fat = smoothstep(outwards / NASOLABIAL.over) * np.exp(-(beyond**2))
        within = smoothstep(1.0 + along / NASOLABIAL.before) * smoothstep(1.0 + (length - along) / NASOLABIAL.past)
        within *= 1.0 - (1.0 - NASOLABIAL.thin) * smoothstep(along / length)
        height += NASOLABIAL.height * fat * within
    return height


def _beside(positions: Floats, top: Floats, end: Floats, side: float) -> tuple[Floats, Floats, float]:
    """Where skin (n, 3) lies about a fold's line, seen from the front: (n,) along it, (n,) outside it; its length."""
    length = float(np.linalg.norm((end - top)[:2]))
    down = (end - top)[:2] / length
    away = positions[:, :2] - top[:2]
    return away @ down, away @ (side * np.array([-down[1], down[0]])), length
