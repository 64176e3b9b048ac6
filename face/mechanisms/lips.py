"""Lips: the raiser of the upper one (AU 10), the depressor of the lower one (AU 16), and what is special about lips.

Anatomy. The levator labii superioris comes from the lower rim of the orbit to the upper lip beside the middle, the
depressor labii inferioris from the mandible to the lower lip. Lips have no bone beneath them, only teeth: skin neither
slides along bone there nor bulges from being squeezed against it.

Rows (presets/anatomy/muscles/lips.toml): levator_labii_superioris, depressor_labii; linear, equations 6-13, each on
its own lip (`separation.py`).

Source: FACS muscle list (docs/sources.md) for the lines of action; own calibration for the figures.
"""

from __future__ import annotations

from dataclasses import dataclass

from ...arrays import Floats
from ..figures import Length, read_figures
from ..skin.outer import OuterSkin, smoothstep


@dataclass(frozen=True)
class LipFigures:
    """Of the bone beside the lips (presets/anatomy/regions.toml)."""

    bone_from: Length
    bone_over: Length


LIPS = read_figures("regions.lips", LipFigures)


def off_lips(skin: OuterSkin) -> Floats:
    """(n,) 0 on the lips, 1 where bone is felt fully."""
    return smoothstep((skin.lip_edge_distance - LIPS.bone_from) / LIPS.bone_over)
