"""Cheek: the raiser under the eye (AU 6), air blown into the cheek and sucked out of it (AU 34, 35).

Anatomy. The lower orbital part of the orbicularis oculi lifts the whole cheek towards the eye and forward: the pad
under the lower lid bulges and the eye narrows. The cheek's pouch between teeth and buccinator fills with air behind
closed lips, which hold the mouth's corner.

Rows (presets/anatomy/muscles/cheek.toml): orb_oculi_orbital_inf (a flat window with a fixed line of pull: as a
sphincter it would draw the cheek's sides together), cheek_puff and cheek_suck (pressure along the normal).

What the second paper's model lacks and is added here: the insertion's region, below the lower lid's edge and not on the
upper one; pressure, which is no muscle (`muscles/pressure.py`). The heap under the eye is `bulge.py`.

Source: FACS muscle list (docs/sources.md); window of the raiser: own calibration on a scanned squint of the cheek
(it rises by 5.5 mm and comes forward by 2); extent of the pouch: anatomy alone, no scan at hand shows it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arrays import Floats
from ..figures import Length, read_figures
from ..skin.outer import OuterSkin, smoothstep
from .separation import lower_lid_side


@dataclass(frozen=True)
class CheekFigures:
    """Of the cheek's region (presets/anatomy/regions.toml)."""

    below_lid: Length
    over: Length
    beside_lid: Length


CHEEK = read_figures("regions.cheek", CheekFigures)


def region(skin: OuterSkin) -> Floats:
    """(n,) 1 on cheek and lower lid, 0 on upper lid, brow and nose bridge."""
    y = skin.positions[:, 1]
    lid = (skin.points["3.3"][1] + skin.points["3.4"][1]) / 2.0
    below = smoothstep((lid + CHEEK.below_lid - y) / CHEEK.over)
    return np.asarray(below * np.where(y > lid - CHEEK.beside_lid, lower_lid_side(skin), 1.0))
