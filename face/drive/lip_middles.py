"""The lips' middles, sideways: four rows that no FAP names, told by the corners of the mouth.

The other half of the orbicularis holds the philtrum: in scanned one-sided actions it does not move aside. Where the
whole mouth is drawn aside, lips that do not stretch drag the trailing corner after them: the middles go as far as it
does (scanned: 16 mm of 15, while the leading corner makes 6).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arrays import Floats
from ..figures import Length, read_figures
from ..mesh.fap_rows import FapRows
from ..skin.outer import smoothstep


@dataclass(frozen=True)
class LipMiddleFigures:
    """How well the lips' middles are known, and when they go along (presets/anatomy/targets.toml)."""

    doubt: Length
    between: float
    taken: Length
    free: Length


FIGURES = read_figures("targets.lip_middles", LipMiddleFigures)

#: Lip middle -> FAPs of the left and right corner of the same contour.
CORNERS = {"2.2": (6, 7), "2.3": (6, 7), "8.1": (53, 54), "8.2": (53, 54)}
JAW_ASIDE_FAP = 15


def lip_middles(rows: FapRows, faps: Floats) -> tuple[Floats, Floats]:
    """Targets and doubts (m,) in metres of the lips' middles, sideways, for FAPs (68,) that the mouth's corners do.

    NaN on other rows, and where the corners are silent.
    """
    targets, doubts = np.full(len(rows), np.nan), np.full(len(rows), FIGURES.doubt)
    place = rows.row_of
    jaw_unit = rows.units[place[JAW_ASIDE_FAP]] if JAW_ASIDE_FAP in place else 0.0
    jaw_aside = abs(float(np.nan_to_num(faps[JAW_ASIDE_FAP - 1]))) * jaw_unit
    if jaw_aside >= FIGURES.free:
        return targets, doubts
    for row in np.flatnonzero(rows.unnamed).tolist():
        left, right = CORNERS[rows.names[row]]
        if left not in place or right not in place or np.isnan(faps[[left - 1, right - 1]]).any():
            continue
        aside = faps[left - 1] * rows.units[place[left]], -faps[right - 1] * rows.units[place[right]]
        together = min(abs(aside[0]), abs(aside[1])) if aside[0] * aside[1] > 0.0 else 0.0
        taken = float(smoothstep(np.array(together / FIGURES.taken)))
        trailing = aside[0] if aside[0] < 0.0 else aside[1]
        between = 1.0 + 4.0 * FIGURES.between * taken * (1.0 - taken)
        targets[row] = taken * trailing
        doubts[row] = FIGURES.doubt * between / (1.0 - jaw_aside / FIGURES.free)
    return targets, doubts
