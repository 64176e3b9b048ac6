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

import numpy as np

from ...arrays import Floats
from ...physics.muscles import Muscle, SphincterMuscle
from ..mechanism import Mechanism
from ..mesh.template import MM
from ..muscles.placement import PlacedMuscle
from ..skin.outer import OuterSkin, smoothstep

#: Width over which one half of a midline muscle hands over to the other, metres to each side.
HALVES_BLEND = 14 * MM


def ring(skin: OuterSkin, muscle: PlacedMuscle) -> Floats:
    """(n, 3) equations (14)-(17) inside the rim; beyond it the pull fades instead of ending at its maximum.

    It fades in depth too: seen from the front the neck lies within the ring, but no fibre reaches it.
    """
    wide, high = muscle.row.radii
    paper: Muscle = SphincterMuscle(
        muscle.middle, np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0]), semi_major=wide, semi_minor=high
    )
    if not skin.has(Mechanism.FADING):
        return paper.force(skin.positions)
    radius, depth = muscle.elliptic_radius(skin.positions)
    toward = muscle.middle - skin.positions
    toward = toward / np.maximum(np.linalg.norm(toward, axis=1, keepdims=True), 1e-9)
    outside = np.where(radius > 1.0, np.exp(-(((radius - 1.0) / muscle.row.fall) ** 2)), 0.0)
    pull = paper.force(skin.positions) * (radius <= 1.0)[:, None] + outside[:, None] * toward
    return np.asarray(np.exp(-((depth / 2.0) ** 4))[:, None] * pull)


def band(skin: OuterSkin, muscle: PlacedMuscle) -> Floats:
    """(n, 3) a band of the lip's margin with a fixed line of pull."""
    radius, depth = muscle.elliptic_radius(skin.positions)
    return np.asarray(np.exp(-(radius**2) - depth**4)[:, None] * muscle.pull)


def half(skin: OuterSkin, side: int) -> Floats:
    """(n,) 1 on the subject's left (side 1) or right (side -1), 0 on the other: one half of a midline muscle."""
    return smoothstep((side * skin.positions[:, 0] / HALVES_BLEND + 1.0) / 2.0)
