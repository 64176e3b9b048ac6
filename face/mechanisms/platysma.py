"""Platysma: AU 21, and a share of AU 20.

Anatomy. A thin sheet under the skin of the neck, from the chest over the jaw's edge; most fibres end along the
mandible, the rear ones cross it and are woven into the ring muscle at the mouth's corner. It draws the corner down and
back, tightens the skin of jaw line and neck, and raises ridges there.

Rows (presets/anatomy/muscles/platysma.toml): platysma (a sheet, equations 18-22, from neck to jaw line),
platysma_corner (the rear fibres, linear, equations 6-13). The first moves skin that no FAP measures: it is drawn by
hand, or by a plan that names it; the second shares frown and stretch with the corner's own muscles.

What the second paper's model lacks and is added here: skin that is held more firmly on neck and under the chin than on
the face (`Mechanism.FIRMNESS`).

Source: FACS muscle list (docs/sources.md); R. D. Acland, Video Atlas of Human Anatomy, on its course and action. No
scan at hand shows it: anatomy alone.
"""

from __future__ import annotations

from dataclasses import dataclass

from ...arrays import Floats
from ..figures import Pair, read_figures
from ..skin.outer import OuterSkin, smoothstep


@dataclass(frozen=True)
class NeckFigures:
    """Of the skin of the neck (presets/anatomy/regions.toml)."""

    firmness: float
    face_depth: Pair
    face_height: Pair


NECK = read_figures("regions.platysma", NeckFigures)


def frontness(skin: OuterSkin) -> Floats:
    """(n,) 1 on the face, 0 behind the jaw's angle and below the chin."""
    y, z = skin.positions[:, 1], skin.positions[:, 2]
    (depth, depth_over), (height, height_over) = NECK.face_depth, NECK.face_height
    return smoothstep((z - depth) / depth_over) * smoothstep((y - height) / height_over)


def neck_firmness(skin: OuterSkin) -> Floats:
    """(n,) extra tie of neck and sides of the head, 1/m^2."""
    return NECK.firmness * (1.0 - frontness(skin))
