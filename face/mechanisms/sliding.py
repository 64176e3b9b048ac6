"""Skin slides over the bone rather than lifts off it.

Between skin and skull lies loose tissue: it gives way along the bone and holds across it. So of what the elastic sheet
does, part of the motion along the normal is taken away. Lips and nose tip have no bone beneath, and the chin's pad is
thick: there the skin is free, or nearly. The bare sheet of the second paper, tied by springs that are alike in all
directions, lifts off the forehead when a brow is raised.

Source: own calibration on scanned expressions (docs/muscles.md).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arrays import Floats
from ..figures import Share, read_figures
from ..mechanism import Mechanism
from ..skin.outer import OuterSkin
from . import chin, lips, nose


@dataclass(frozen=True)
class SlidingFigures:
    """Of the bone under the skin (presets/anatomy/skin.toml)."""

    share: Share


SLIDING = read_figures("skin.sliding", SlidingFigures)


def sliding(skin: OuterSkin) -> Floats:
    """(n,) share of motion along the normal that the bone takes away, 0 to 1."""
    if not skin.has(Mechanism.SLIDING):
        return np.zeros(skin.vertex_count)
    return SLIDING.share * lips.off_lips(skin) * nose.off_tip(skin) * (1.0 - chin.CHIN.loose * chin.pad(skin))
