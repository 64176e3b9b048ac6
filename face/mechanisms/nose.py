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

from dataclasses import dataclass

import numpy as np

from ...arrays import Floats
from ..figures import Length, Place, read_figures
from ..skin.outer import OuterSkin, gaussian, smoothstep
from .separation import upper_lip_side


@dataclass(frozen=True, eq=False)
class NoseFigures:
    """Of the nose's region and of what holds its skin (presets/anatomy/regions.toml)."""

    half_width: Length
    over: Length
    base_firmness: float
    base_radius: Length
    bridge_firmness: float
    bridge_radius: Length
    bridge_from_point: Place
    tip_radius: Length
    nostril_radius: Length


NOSE = read_figures("regions.nose", NoseFigures)


def region(skin: OuterSkin) -> Floats:
    """(n,) 1 on the nose and the lip below it, 0 on the cheeks and the lower lip."""
    inside = smoothstep((NOSE.half_width - np.abs(skin.positions[:, 0])) / NOSE.over)
    return np.asarray(upper_lip_side(skin) * inside)


def firmness(skin: OuterSkin) -> Floats:
    """(n,) extra tie to bone and cartilage at the nose's base and bridge, 1/m^2."""
    held = NOSE.base_firmness * gaussian(skin.positions, skin.points["9.15"], NOSE.base_radius)
    if "9.12" in skin.points:
        bridge = skin.points["9.12"] + NOSE.bridge_from_point
        held = held + NOSE.bridge_firmness * gaussian(skin.positions, bridge, NOSE.bridge_radius)
    return held


def off_tip(skin: OuterSkin) -> Floats:
    """(n,) 0 at the tip of the nose, 1 away from it."""
    return 1.0 - gaussian(skin.positions, skin.points["9.3"], NOSE.tip_radius)


def nostrils(skin: OuterSkin) -> Floats:
    """(n,) 1 at the nostrils, 0 away from them."""
    near: Floats = np.zeros(skin.vertex_count)
    for name in ("9.1", "9.2"):
        if name in skin.points:
            near = np.maximum(near, gaussian(skin.positions, skin.points[name], NOSE.nostril_radius))
    return near
