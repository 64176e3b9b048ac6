"""What a plan wants of the feature points of one face, in metres."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ...arrays import Bools, Floats
from ..mesh.fap_rows import FapRows
from ..mesh.template import MM
from ..response.actuators import JAW
from .filled import filled
from .lip_middles import lip_middles
from .plan import Plan

ASKED_DOUBT, SILENT_DOUBT, LIP_DOUBT = 0.4 * MM, 2.0 * MM, 1.0 * MM
LIP_FAPS = (5, 10, 11)
FILLED_DOUBT, CARRIED_DOUBT = 1.0 * MM, 6.0 * MM
SLIDE_ASKED, SLIDE_SILENT = 16.0 * MM, 2.0 * MM
JAW_ASKED, JAW_SILENT = 60.0 * MM, 3.0 * MM


@dataclass(frozen=True, eq=False)
class Targets:
    """What a plan wants of the m FAP rows of one face.

    Attributes
    ----------
    displacements : (m,) metres along each row; NaN: nothing is wanted of it.
    doubts : (m,) how far off, in metres, a row may be; 0: as near as may be.
    corrected : (m,) rows that the elastic skin takes the rest of the way, where the drive corrects at all; the others
        are for muscles, lids and jaw alone.
    carried : (m,) rows that only say where muscles move them relative to the jaw.
    muscles : muscle name (with side) -> amount in metres that is expected of it.
    opening, slide : usual size of the jaw's opening (at the chin) and of its slides, metres.
    """

    displacements: Floats
    doubts: Floats
    corrected: Bools
    carried: Bools
    muscles: Mapping[str, float]
    opening: float
    slide: float


def natural_targets(rows: FapRows, plan: Plan) -> Targets:
    """Every planned row, asked ones more firmly; what is asked and has no range, exactly."""
    goal, asked = rows.select(plan.goal), rows.select(plan.evened)
    beyond = np.isnan(goal) & ~np.isnan(asked)
    doubts = np.where(np.isnan(asked), SILENT_DOUBT, ASKED_DOUBT)
    doubts = np.where(np.isin(rows.numbers, LIP_FAPS), LIP_DOUBT, doubts)
    doubts = np.where(beyond, 0.0, doubts)
    middles, loose = lip_middles(rows, plan.goal)
    hidden = rows.numbers == 0
    return Targets(
        displacements=np.where(hidden, middles, np.where(beyond, asked, goal)),
        doubts=np.where(hidden, loose, doubts),
        corrected=np.ones(len(rows), dtype=bool),
        carried=np.zeros(len(rows), dtype=bool),
        muscles=plan.muscles,
        opening=JAW.usual_opening,
        slide=SLIDE_ASKED if _asks(plan.evened, 14, 15) else SLIDE_SILENT,
    )


def exact_targets(rows: FapRows, plan: Plan) -> Targets:
    """What is asked, exactly; what must go with it, softly and by muscles; the rest where the jaw carries it."""
    faps = plan.goal
    full, silent, hidden = filled(faps), np.isnan(rows.select(faps)), rows.numbers == 0
    middles, loose = lip_middles(rows, full)
    displacements = np.where(hidden, middles, rows.select(full))
    carried = np.isnan(displacements) & ~hidden
    doubts = np.where(carried, CARRIED_DOUBT, np.where(silent, FILLED_DOUBT, 0.0))
    return Targets(
        displacements=np.where(carried, 0.0, displacements),
        doubts=np.where(hidden, loose, doubts),
        corrected=~silent | hidden,
        carried=carried,
        muscles={},
        opening=JAW_ASKED if _asks(faps, 3) else JAW_SILENT,
        slide=SLIDE_ASKED if _asks(faps, 14, 15) else SLIDE_SILENT,
    )


def _asks(faps: Floats, *numbers: int) -> bool:
    """Whether FAPs (68,) say anything of these."""
    return bool(any(not np.isnan(faps[number - 1]) for number in numbers))
