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
    force: Floats = row.pull(skin) * region_mask(skin, row.region)[:, None]
    force *= smoothstep((skin.positions[:, 2] - INSERTION.behind) / INSERTION.over)[:, None]
    if row.sides is Sides.HALVES:
        force *= orbicularis_oris.half(skin, row.side)[:, None]
    return force


def region_mask(skin: OuterSkin, region: Region) -> Floats:
    """(n,) 1 where a muscle of the region may pull, falling smoothly to 0."""
    return _REGIONS[region](skin) if region in _REGIONS else np.ones(skin.vertex_count)


#: Regions that are not the whole face.
_REGIONS: Mapping[Region, Callable[[OuterSkin], Floats]] = {
    Region.BROW: brow.region,
    Region.CHEEK: cheek.region,
    Region.NOSE: nose.region,
    Region.UPPER: lambda skin: upper_lip_side(skin) * nose.off_tip(skin),
    Region.LOWER: lambda skin: 1.0 - upper_lip_side(skin),
}
