"""What each way of driving a face asks of the feature points, from one frame of FAPs."""

from __future__ import annotations

from enum import StrEnum

import numpy as np

from ...arrays import Bools, Floats
from ...mpeg4 import LIP_TWINS
from ..mesh.fap_rows import FapRows
from ..mesh.template import MM
from ..response.actuators import JAW
from ..skin.outer import smoothstep
from .inverse import EXACT_NOISE, Wish
from .natural import Plan


class Drive(StrEnum):
    """How a frame of FAPs moves the face.

    natural : requests weighed against anatomy and each other, silence filled by action units (default).
    exact : requests met exactly: muscles, then an elastic correction of the rest.
    muscles : contractions alone, as near as they come.
    points : the skin's elasticity alone, points moved exactly.
    """

    NATURAL = "natural"
    EXACT = "exact"
    MUSCLES = "muscles"
    POINTS = "points"


ASKED_DOUBT, SILENT_DOUBT, LIP_DOUBT = 0.4 * MM, 2.0 * MM, 1.0 * MM
LIP_FAPS = (5, 10, 11)
FILLED_DOUBT, CARRIED_DOUBT = 1.0 * MM, 6.0 * MM
SLIDE_ASKED, SLIDE_SILENT = 16.0 * MM, 2.0 * MM
JAW_ASKED, JAW_SILENT = 60.0 * MM, 3.0 * MM

#: The lips' middles are known as well as this; half way between staying and going along, so many times worse; and not
#: at all where the jaw goes aside this far.
MIDDLE_DOUBT, MIDDLE_BETWEEN, MIDDLE_FREE = 0.5 * MM, 4.0, 3.0 * MM

#: Both corners together this far aside take the middles along in full.
MIDDLE_TAKEN = 6.0 * MM


def lip_middles(rows: FapRows, frame: Floats) -> tuple[Floats, Floats]:
    """Targets and doubts (m,) in metres of the lips' middles, sideways; NaN on other rows and where corners are silent.

    The other half of the orbicularis holds the philtrum: in scanned one-sided actions it does not move aside. Where
    the whole mouth is drawn aside, lips that do not stretch drag the trailing corner after them: the middles go as far
    as it does (scanned: 16 mm of 15, while the leading corner makes 6).
    """
    targets, doubts = np.full(len(rows), np.nan), np.full(len(rows), MIDDLE_DOUBT)
    place = rows.position
    pairs = {"2.2": (6, 7), "2.3": (6, 7), "8.1": (53, 54), "8.2": (53, 54)}
    jaw_aside = abs(float(np.nan_to_num(frame[15 - 1]))) * (rows.units[place[15]] if 15 in place else 0.0)
    for row in np.flatnonzero(rows.numbers == 0).tolist():
        left, right = pairs[rows.names[row]]
        if left not in place or right not in place or np.isnan(frame[[left - 1, right - 1]]).any():
            continue
        if jaw_aside >= MIDDLE_FREE:
            continue
        aside = frame[left - 1] * rows.units[place[left]], -frame[right - 1] * rows.units[place[right]]
        together = min(abs(aside[0]), abs(aside[1])) if aside[0] * aside[1] > 0.0 else 0.0
        taken = float(smoothstep(np.array(together / MIDDLE_TAKEN)))
        trailing = aside[0] if aside[0] < 0.0 else aside[1]
        targets[row] = taken * trailing
        doubts[row] = (
            MIDDLE_DOUBT * (1.0 + 4.0 * MIDDLE_BETWEEN * taken * (1.0 - taken)) / (1.0 - jaw_aside / MIDDLE_FREE)
        )
    return targets, doubts


def natural_wish(rows: FapRows, plan: Plan) -> Wish:
    """The wish of the natural mode: every planned row, asked ones more firmly."""
    targets = rows.select(plan.goal)
    request = rows.select(plan.asked)
    beyond = np.isnan(targets) & ~np.isnan(request)
    targets = np.where(beyond, request, targets)
    doubts = np.where(np.isnan(request), SILENT_DOUBT, ASKED_DOUBT)
    doubts = np.where(np.isin(rows.numbers, LIP_FAPS), LIP_DOUBT, doubts)
    doubts = np.where(beyond, EXACT_NOISE, doubts)
    middles, loose = lip_middles(rows, plan.goal)
    targets, doubts = np.where(rows.numbers > 0, targets, middles), np.where(rows.numbers > 0, doubts, loose)
    slides = SLIDE_ASKED if _asks(plan.asked, 14, 15) else SLIDE_SILENT
    return Wish(targets, doubts, dict(plan.muscles), JAW.usual_opening, slides)


def exact_wish(rows: FapRows, frame: Floats) -> Wish:
    """The wish of the exact mode: requests firmly, what must go with them softly, the rest where the jaw carries it."""
    asked = rows.select(frame)
    full = fill(frame)
    middles, loose = lip_middles(rows, full)
    filled = np.where(rows.numbers > 0, rows.select(full), middles)
    carried: Bools = np.isnan(filled) & (rows.numbers > 0)
    targets = np.where(carried, 0.0, filled)
    doubts = np.where(np.isnan(asked), np.where(rows.numbers > 0, FILLED_DOUBT, loose), EXACT_NOISE)
    doubts = np.where(carried, CARRIED_DOUBT, doubts)
    return Wish(
        targets,
        doubts,
        {},
        JAW_ASKED if _asks(frame, 3) else JAW_SILENT,
        SLIDE_ASKED if _asks(frame, 14, 15) else SLIDE_SILENT,
        carried,
    )


def fill(frame: Floats) -> Floats:
    """A frame (68,) with what MPEG-4 decoders fill in: lip middles from lip centres, outer lips from inner ones.

    Source: filling of missing FAPs in the standard, left-right and inner-outer pairs, extended to lip sides.
    """
    full = frame.copy()

    def give(number: int, value: float) -> None:
        if np.isnan(full[number - 1]) and not np.isnan(value):
            full[number - 1] = value

    for number in (8, 9):
        give(number, frame[3])
    for number in (10, 11):
        give(number, 0.9 * frame[4])
    if not np.isnan(frame[2]):
        lowered = 0.4 * min(float(np.nan_to_num(frame[4])), 0.0)
        for number in (12, 13):
            give(number, lowered)
    for inner, outer in LIP_TWINS:
        give(outer, full[inner - 1])
    return full


def _asks(frame: Floats, *numbers: int) -> bool:
    """Whether a frame says anything of these FAPs."""
    return bool(any(not np.isnan(frame[number - 1]) for number in numbers))
