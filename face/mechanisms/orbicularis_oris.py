"""Orbicularis oris, the ring muscle of the mouth, in parts: pucker (AU 18), funnel (22), tightening and press (23, 24).

Anatomy. It has no bone of its own. Its peripheral ring, under the skin up to nose and chin, draws the lips together
and, since they lie on a curve of teeth, forward: pucker. Its marginal fibres, in the red of the lips, turn them out
(funnel) or roll and press them against each other. The knot beside the corner (modiolus), into which the ring and eight
other muscles are woven, goes in and forward with it. Upper, lower, left and right parts contract on their own.

Rows (presets/anatomy/muscles/orbicularis_oris.toml): oris_upper_outer and oris_lower_outer (sphincters, equations
14-17), oris_*_evert and oris_*_press (bands with a fixed line of pull), oris_modiolus (a flat window).

What the second paper's model lacks and is added here: an epicentre before the lips, so that drawing together
protrudes; beyond the sphincter's rim a pull that fades instead of ending at its maximum (`Mechanism.FADING`); the
marginal bands, which no contraction towards a centre gives; halves.

Source: FACS muscle list (docs/sources.md) for the parts; own calibration on scanned pucker, funnel and press.
"""

from __future__ import annotations

from dataclasses import dataclass

from ...arrays import Floats
from ..figures import Length, read_figures
from ..skin.outer import OuterSkin, smoothstep


@dataclass(frozen=True)
class RingFigures:
    """Of the halves of midline muscles (presets/anatomy/regions.toml)."""

    halves_over: Length


RING = read_figures("regions.orbicularis_oris", RingFigures)


def half(skin: OuterSkin, side: int) -> Floats:
    """(n,) 1 on the subject's left (side 1) or right (side -1), 0 on the other: one half of a midline muscle."""
    return smoothstep((side * skin.positions[:, 0] / RING.halves_over + 1.0) / 2.0)
