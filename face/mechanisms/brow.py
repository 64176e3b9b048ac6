"""Brow and forehead: AU 1, 2 and 4.

Anatomy. The frontalis rises from the galea, not from bone, and ends in the skin of the brow: its medial part raises the
inner brow (AU 1), its lateral part the outer one (AU 2), and where nothing holds the galea back the scalp comes down
to meet it. Corrugator (from the bone of the inner brow outwards and up), procerus (from the nose's bridge up) and
depressor supercilii (from the inner orbit up) draw the brow together and down (AU 4); the orbital part of the
orbicularis oculi above the eye lowers all of it. All slide over bone.

Rows (presets/anatomy/muscles/brow.toml): frontalis_med, frontalis_lat (sheets, equations 18-22), corrugator,
depressor_supercilii, procerus (linear, 6-13), orb_oculi_orbital_sup (a sphincter drawn along the skin).

What the second paper's model lacks and is added here: the insertion's region, above the lids; the scalp's reaction,
a pull of the sheet on its own origin (`Mechanism.SCALP`); a scalp that is held more firmly than a cheek
(`Mechanism.FIRMNESS`); sliding over the bone (`sliding.py`).

Source: FACS muscle list (docs/sources.md) for the lines of action; a scan of raised brows (hairline down by 1.6 mm, out
by 2 mm while the brow rises by 6) and own calibration for the figures.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arrays import Floats
from ..figures import Length, read_figures
from ..mechanism import Mechanism
from ..skin.outer import OuterSkin, smoothstep


@dataclass(frozen=True)
class BrowFigures:
    """Of the brow's region and the scalp (presets/anatomy/regions.toml)."""

    above_lid: Length
    over: Length
    scalp_firmness: float
    scalp_over: Length
    reaction_spread: float


BROW = read_figures("regions.brow", BrowFigures)


def region(skin: OuterSkin) -> Floats:
    """(n,) 1 over the brow and above, 0 from the upper lids' edge down."""
    lid = (skin.points["3.1"][1] + skin.points["3.2"][1]) / 2.0
    return smoothstep((skin.positions[:, 1] - lid - BROW.above_lid) / BROW.over)


def scalp_firmness(skin: OuterSkin) -> Floats:
    """(n,) extra tie to the bone above the brows, 1/m^2."""
    brow = (skin.points["4.3"][1] + skin.points["4.4"][1]) / 2.0
    return BROW.scalp_firmness * smoothstep((skin.positions[:, 1] - brow) / BROW.scalp_over)


def scalp_reaction(skin: OuterSkin, along: Floats, reaction: float, reaction_at: float) -> Floats:
    """(n,) pull of a sheet on its own origin, towards its insertion.

    Parameters
    ----------
    along : (n,) place along the sheet, 0 at its origin and 1 at its insertion.
    reaction, reaction_at : strength relative to the pull on the insertion, and the place where it is greatest.
    """
    if not skin.has(Mechanism.SCALP):
        return np.zeros_like(along)
    return reaction * np.exp(-(((along - reaction_at) / BROW.reaction_spread) ** 2))
