"""How firmly each place of the skin is held and how stiffly it bends: fields over the outer skin.

The even part stands here, what regions differ in comes from the mechanisms that know them. Figures in metres of head
space; source: calibration on scanned expressions, see docs/muscles.md.
"""

from __future__ import annotations

import numpy as np

from ...arrays import Floats
from ..mechanism import Mechanism
from ..mechanisms import brow, chin, lids, nose, platysma
from ..mesh.template import MM
from ..skin.outer import OuterSkin

BENDING_LENGTH = 11.67 * MM
ANCHOR_LENGTH = 12.0 * MM
NOSTRIL_BENDING = 0.075


def bending(skin: OuterSkin) -> Floats:
    """(n,) squared bending length, m^2: how far a pull at one point spreads; lids are thin.

    Zhang et al. 2001 have a bare membrane, which resists nothing normal to itself and makes spikes at points.
    """
    if not skin.has(Mechanism.BENDING):
        return np.zeros(skin.vertex_count)
    return BENDING_LENGTH**2 * lids.thickness(skin)


def correction_bending(skin: OuterSkin) -> Floats:
    """(n,) as `bending`, softer still round the nostrils, so that a nostril's correction stays there."""
    return bending(skin) * (1.0 - (1.0 - NOSTRIL_BENDING) * nose.nostrils(skin))


def anchor(skin: OuterSkin) -> Floats:
    """(n,) squared inverse anchor length, 1/m^2: how firmly fat and ligaments tie the skin to the bone.

    Zhang et al. 2001 name the skull as future work; a bare membrane has nothing to hold it, so that an even tie
    belongs to every face.
    """
    tie = np.full(skin.vertex_count, 1.0 / ANCHOR_LENGTH**2)
    if not skin.has(Mechanism.FIRMNESS):
        return tie
    for firmness in (brow.scalp_firmness, lids.firmness, nose.firmness, chin.firmness, platysma.neck_firmness):
        tie += firmness(skin)
    return tie
