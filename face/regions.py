"""How firmly each place of the skin is held, and how it slides and bulges: fields over the outer skin.

Figures in metres of head space; source: calibration on scanned expressions, see docs/muscles.md.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Floats
from .mechanisms import Mechanism
from .outer_skin import OuterSkin, smoothstep

MM = 1e-3

BENDING_LENGTH = 11.67 * MM
ANCHOR_LENGTH = 12.0 * MM
LID_BENDING = 0.25
NOSTRIL_BENDING = 0.075
SLIDE = 0.56
BULGE = 4.0 * MM


def gaussian(positions: Floats, centre: Floats, radii: Floats | float) -> Floats:
    """(n,) exp(-|d/r|^2) round a centre (3,) with radius or radii (3,) in metres."""
    away: Floats = (((positions - centre) / radii) ** 2).sum(axis=1)
    value: Floats = np.exp(-away)
    return value


def near_lids(skin: OuterSkin) -> Floats:
    """(n,) 1 within 6 mm of a lid's edge, 0 beyond 16 mm."""
    return 1.0 - smoothstep((skin.lid_edge_distance - 6 * MM) / (10 * MM))


def off_lips(skin: OuterSkin) -> Floats:
    """(n,) 0 on the lips, 1 from 24 mm off their edge."""
    return smoothstep((skin.lip_edge_distance - 4 * MM) / (20 * MM))


def frontness(skin: OuterSkin) -> Floats:
    """(n,) 1 on the face, 0 behind the jaw's angle and below the chin."""
    y, z = skin.positions[:, 1], skin.positions[:, 2]
    return smoothstep((z + 60 * MM) / (50 * MM)) * smoothstep((y + 75 * MM) / (10 * MM))


def chin_pad(skin: OuterSkin) -> Floats:
    """(n,) the pad of the chin, between boss 2.10 and underside 2.1."""
    centre = 0.75 * skin.points["2.10"] + 0.25 * skin.points["2.1"]
    return gaussian(skin.positions, centre, np.array([18.0, 9.0, 20.0]) * MM)


def bending(skin: OuterSkin) -> Floats:
    """(n,) squared bending length, m^2: how far a pull at one point spreads; lids are thin."""
    if not skin.has(Mechanism.BENDING):
        return np.zeros(skin.vertex_count)
    return BENDING_LENGTH**2 * (1.0 - (1.0 - LID_BENDING) * near_lids(skin))


def correction_bending(skin: OuterSkin) -> Floats:
    """(n,) as `bending`, softer still round the nostrils, so that a nostril's correction stays there."""
    soft: Floats = np.zeros(skin.vertex_count)
    for name in ("9.1", "9.2"):
        if name in skin.points:
            soft = np.maximum(soft, gaussian(skin.positions, skin.points[name], 12 * MM))
    return bending(skin) * (1.0 - (1.0 - NOSTRIL_BENDING) * soft)


def anchor(skin: OuterSkin) -> Floats:
    """(n,) squared inverse anchor length, 1/m^2: how firmly fat and ligaments tie the skin to the bone.

    Zhang et al. 2001 name the skull as future work; a bare membrane has nothing to hold it.
    """
    if not skin.has(Mechanism.FIRMNESS):
        return np.full(skin.vertex_count, 1.0 / ANCHOR_LENGTH**2)
    y = skin.positions[:, 1]
    brow = (skin.points["4.3"][1] + skin.points["4.4"][1]) / 2.0
    held = 0.02 * smoothstep((y - brow) / (20 * MM))
    held = held + 0.03 * gaussian(skin.positions, skin.points["9.15"], 9 * MM)
    if "9.12" in skin.points:
        held = held + 0.008 * gaussian(skin.positions, skin.points["9.12"] + np.array([0.0, 8, -4]) * MM, 16 * MM)
    held = held + 0.075 * chin_pad(skin)
    held = held + 0.003 * (1.0 - frontness(skin))
    return 1.0 / ANCHOR_LENGTH**2 + held / MM**2


def sliding(skin: OuterSkin) -> Floats:
    """(n,) share of motion along the normal that the bone takes away: skin slides over the skull."""
    if not skin.has(Mechanism.SLIDING):
        return np.zeros(skin.vertex_count)
    free = off_lips(skin) * (1.0 - gaussian(skin.positions, skin.points["9.3"], 16 * MM))
    return SLIDE * free * (1.0 - 0.7 * chin_pad(skin))


def bulging(skin: OuterSkin) -> Floats:
    """(n,) bulge height per unit of surface compression, metres: tissue keeps its volume."""
    if not skin.has(Mechanism.BULGE):
        return np.zeros(skin.vertex_count)
    free = off_lips(skin) * (1.0 - gaussian(skin.positions, skin.points["9.3"], 16 * MM))
    return BULGE * free * (1.0 - near_lids(skin))
