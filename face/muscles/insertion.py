"""Which skin a placed muscle may pull on, and how hard it pulls there: force densities before the skin answers."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from ...arrays import Floats
from ..figures import Length, read_figures
from ..mechanisms import brow, cheek, nose, orbicularis_oris
from ..mechanisms.separation import upper_lip_side
from ..skin.outer import OuterSkin, smoothstep
from .placement import PlacedMuscle
from .row import Region, Sides


@dataclass(frozen=True)
class InsertionFigures:
    """Where muscles of expression insert at all (presets/anatomy/skin.toml)."""

    behind: float
    over: Length


INSERTION = read_figures("skin.insertion", InsertionFigures)


def force_density(skin: OuterSkin, muscle: PlacedMuscle) -> Floats:
    """(n, 3) pull per area of skin at full contraction, up to a factor; 0 outside the muscle's zone and region."""
    row = muscle.row
    side = row.side if row.sides is Sides.HALVES else 0
    share = skin.once(f"insertion {row.region} {side}", lambda: insertion(skin, row.region, side))
    return np.asarray(row.pull(skin) * share[:, None])


def insertion(skin: OuterSkin, region: Region, side: int = 0) -> Floats:
    """(n,) 1 where muscles of a region may pull, falling smoothly to 0; of one half, +1 left or -1 right."""
    front = smoothstep((skin.positions[:, 2] - INSERTION.behind) / INSERTION.over)
    share = _REGIONS[region](skin) * front if region in _REGIONS else front
    return share * orbicularis_oris.half(skin, side) if side else share


#: Regions that are not the whole face.
_REGIONS: Mapping[Region, Callable[[OuterSkin], Floats]] = {
    Region.BROW: brow.region,
    Region.CHEEK: cheek.region,
    Region.NOSE: nose.region,
    Region.UPPER: lambda skin: upper_lip_side(skin) * nose.off_tip(skin),
    Region.LOWER: lambda skin: 1.0 - upper_lip_side(skin),
}
