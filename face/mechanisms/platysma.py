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

from ...arrays import Floats
from ..mesh.template import MM
from ..skin.outer import OuterSkin, smoothstep

#: Extra tie of the skin behind the jaw's angle and below the chin, 1/m^2.
NECK_FIRMNESS = 0.003 / MM**2


def frontness(skin: OuterSkin) -> Floats:
    """(n,) 1 on the face, 0 behind the jaw's angle and below the chin."""
    y, z = skin.positions[:, 1], skin.positions[:, 2]
    return smoothstep((z + 60 * MM) / (50 * MM)) * smoothstep((y + 75 * MM) / (10 * MM))


def neck_firmness(skin: OuterSkin) -> Floats:
    """(n,) extra tie of neck and sides of the head, 1/m^2."""
    return NECK_FIRMNESS * (1.0 - frontness(skin))
