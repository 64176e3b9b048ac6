"""Lips: the raiser of the upper one (AU 10), the depressor of the lower one (AU 16), and what is special about lips.

Anatomy. The levator labii superioris comes from the lower rim of the orbit to the upper lip beside the middle, the
depressor labii inferioris from the mandible to the lower lip. Lips have no bone beneath them, only teeth: skin neither
slides along bone there nor bulges from being squeezed against it.

Rows (presets/anatomy/muscles/lips.toml): levator_labii_superioris, depressor_labii; linear, equations 6-13, each on
its own lip (`separation.py`).

Source: FACS muscle list (docs/sources.md) for the lines of action; own calibration for the figures.
"""

from __future__ import annotations

from ...arrays import Floats
from ..mesh.template import MM
from ..skin.outer import OuterSkin, smoothstep

#: Distance from the lips' edge at which bone begins to be felt, and over which it comes to be felt fully, metres.
BONE_FROM, BONE_OVER = 4 * MM, 20 * MM


def off_lips(skin: OuterSkin) -> Floats:
    """(n,) 0 on the lips, 1 from 24 mm off their edge."""
    return smoothstep((skin.lip_edge_distance - BONE_FROM) / BONE_OVER)
