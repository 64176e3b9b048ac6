"""How firmly each place of the skin is held and how stiffly it bends: fields over the outer skin.

The even part is that of a tissue (presets/tissue.toml): of the default one in balance, of the chosen one in motion.
What regions differ in comes from the mechanisms that know them.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arrays import Floats
from ...physics.tissue import Tissue, tissue
from ..figures import Share, read_figures
from ..mechanism import Mechanism
from ..mechanisms import brow, chin, lids, nose, platysma
from ..skin.outer import OuterSkin


@dataclass(frozen=True)
class NostrilFigures:
    """Of the skin round the nostrils (presets/anatomy/skin.toml)."""

    bending: Share


NOSTRILS = read_figures("skin.nostrils", NostrilFigures)


def bending(skin: OuterSkin, figures: Tissue | None = None) -> Floats:
    """(n,) squared bending length of a tissue, m^2: how far a pull at one point spreads; lids are thin.

    Zhang et al. 2001 have a bare membrane, which resists nothing normal to itself and makes spikes at points.
    """
    if not skin.has(Mechanism.BENDING):
        return np.zeros(skin.vertex_count)
    return (figures or tissue()).bending_length ** 2 * lids.thickness(skin)


def correction_bending(skin: OuterSkin) -> Floats:
    """(n,) as `bending`, softer still round the nostrils, so that a nostril's correction stays there."""
    return bending(skin) * (1.0 - (1.0 - NOSTRILS.bending) * nose.nostrils(skin))


def anchor(skin: OuterSkin, figures: Tissue | None = None) -> Floats:
    """(n,) squared inverse anchor length of a tissue, 1/m^2: how firmly fat and ligaments tie the skin to the bone.

    Zhang et al. 2001 name the skull as future work; a bare membrane has nothing to hold it, so that an even tie
    belongs to every face.
    """
    tie = np.full(skin.vertex_count, 1.0 / (figures or tissue()).anchor_length ** 2)
    if not skin.has(Mechanism.FIRMNESS):
        return tie
    for firmness in (brow.scalp_firmness, lids.firmness, nose.firmness, chin.firmness, platysma.neck_firmness):
        tie += firmness(skin)
    return tie
