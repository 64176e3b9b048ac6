"""Chin: the mentalis (AU 17).

Anatomy. It comes from the mandible under the lower teeth down and forward to the skin of the chin's pad: contracting it
pushes pad and lower lip up and the lip forward, and the pad balls. The pad is thick and tied to the bone by many
strands.

Rows (presets/anatomy/muscles/chin.toml): mentalis, a flat window with a fixed line of pull up and forward. As the
paper's linear muscle it would draw the pad into the lip: its fibres end all over the pad, and the bone that turns
their pull forward is not in the model.

What the second paper's model lacks and is added here: that line of pull; a pad that is held firmly
(`Mechanism.FIRMNESS`), and that comes off the bone more readily than other skin (`sliding.py`).

Source: FACS muscle list (docs/sources.md) for the line of action; own calibration on scanned pressed lips for the
figures.
"""

from __future__ import annotations

from dataclasses import dataclass

from ...arrays import Floats
from ..figures import Extent, Share, read_figures
from ..skin.outer import OuterSkin, gaussian


@dataclass(frozen=True, eq=False)
class ChinFigures:
    """Of the chin's pad (presets/anatomy/regions.toml)."""

    firmness: float
    underside: Share
    extent: Extent
    loose: Share


CHIN = read_figures("regions.chin", ChinFigures)


def pad(skin: OuterSkin) -> Floats:
    """(n,) 1 at the pad of the chin, between boss 2.10 and underside 2.1, 0 away from it."""
    centre = (1.0 - CHIN.underside) * skin.points["2.10"] + CHIN.underside * skin.points["2.1"]
    return gaussian(skin.positions, centre, CHIN.extent)


def firmness(skin: OuterSkin) -> Floats:
    """(n,) extra tie of the pad to the bone, 1/m^2."""
    return CHIN.firmness * pad(skin)
