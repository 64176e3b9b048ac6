"""What goes with the FAPs that are asked for, where nothing else is said of it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arrays import Floats
from ...mpeg4 import LIP_TWINS
from ..figures import Share, read_figures


@dataclass(frozen=True)
class FilledFigures:
    """How far the lips' sides go with their middles (presets/anatomy/targets.toml)."""

    lower_lip: Share
    corners: Share


FILLED = read_figures("targets.filled", FilledFigures)


def filled(faps: Floats) -> Floats:
    """FAPs (68,) with what MPEG-4 decoders fill in: lip middles from lip centres, outer lips from inner ones.

    Source: filling of missing FAPs in the standard, left-right and inner-outer pairs, extended to lip sides.
    """
    full = faps.copy()

    def give(number: int, value: float) -> None:
        if np.isnan(full[number - 1]) and not np.isnan(value):
            full[number - 1] = value

    for number in (8, 9):
        give(number, faps[3])
    for number in (10, 11):
        give(number, FILLED.lower_lip * faps[4])
    if not np.isnan(faps[2]):
        lowered = FILLED.corners * min(float(np.nan_to_num(faps[4])), 0.0)
        for number in (12, 13):
            give(number, lowered)
    for inner, outer in LIP_TWINS:
        give(outer, full[inner - 1])
    return full
