"""Nose: AU 9 (wrinkled), 38 (nostrils widened) and 39 (narrowed).

Anatomy. The levator labii superioris alaeque nasi runs down beside the nose; one slip lifts the nostril's wing, the
other the upper lip. The transverse nasalis compresses the nostrils, its alar part opens them, the depressor septi
draws the tip down. Skin is tied closely to bone and cartilage of bridge and base; the tip has no bone beneath.

Rows (presets/anatomy/muscles/nose.toml): llsan_wing, llsan_lip, nasalis_transverse, nasalis_alar, depressor_septi;
all linear, equations 6-13.

What the second paper's model lacks and is added here: the insertion's region, between the cheeks and off the lower lip;
firmer skin on bridge and base (`Mechanism.FIRMNESS`); a tip free of sliding and bulging; softer nostrils, so that what
FAPs 61 and 62 still want after the muscles stays there.

Source: FACS muscle list (docs/sources.md) for the lines of action; own calibration for the figures. The nasalis is
moved by no scan at hand: anatomy alone.
"""

from __future__ import annotations

import numpy as np

from ...arrays import Floats
from ..mesh.template import MM
from ..skin.outer import OuterSkin, gaussian, smoothstep
from .separation import upper_lip_side

#: Extra ties to bone and cartilage, 1/m^2, with their radii, metres; the bridge's place from feature point 9.12.
BASE_FIRMNESS, BASE_RADIUS = 0.03 / MM**2, 9 * MM
BRIDGE_FIRMNESS, BRIDGE_RADIUS = 0.008 / MM**2, 16 * MM
BRIDGE_FROM_POINT = np.array([0.0, 8.0, -4.0]) * MM

TIP_RADIUS, NOSTRIL_RADIUS = 16 * MM, 12 * MM


def region(skin: OuterSkin) -> Floats:
    """(n,) 1 on the nose and the lip below it, 0 on the cheeks and the lower lip."""
    return np.asarray(upper_lip_side(skin) * smoothstep((34 * MM - np.abs(skin.positions[:, 0])) / (10 * MM)))


def firmness(skin: OuterSkin) -> Floats:
    """(n,) extra tie to bone and cartilage at the nose's base and bridge, 1/m^2."""
    held = BASE_FIRMNESS * gaussian(skin.positions, skin.points["9.15"], BASE_RADIUS)
    if "9.12" in skin.points:
        bridge = skin.points["9.12"] + BRIDGE_FROM_POINT
        held = held + BRIDGE_FIRMNESS * gaussian(skin.positions, bridge, BRIDGE_RADIUS)
    return held


def off_tip(skin: OuterSkin) -> Floats:
    """(n,) 0 at the tip of the nose, 1 away from it."""
    return 1.0 - gaussian(skin.positions, skin.points["9.3"], TIP_RADIUS)


def nostrils(skin: OuterSkin) -> Floats:
    """(n,) 1 at the nostrils, 0 away from them."""
    near: Floats = np.zeros(skin.vertex_count)
    for name in ("9.1", "9.2"):
        if name in skin.points:
            near = np.maximum(near, gaussian(skin.positions, skin.points[name], NOSTRIL_RADIUS))
    return near
