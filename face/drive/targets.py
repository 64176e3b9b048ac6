"""What a plan wants of the feature points of one face, in metres."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ...arrays import Bools, Floats
from ..figures import Length, Share, read_figures
from ..mesh.fap_rows import FapRows
from ..response.actuators import JAW
from .filled import filled
from .lip_middles import lip_middles
from .natural.ranges import possible_shares
from .natural.synergies import load_synergies
from .plan import Plan

#: The middle of the inner lower lip and its sides.
INNER_LOWER_LIP_FAPS = (5, 10, 11)
BROW_FAPS = range(31, 39)


@dataclass(frozen=True)
class NaturalFigures:
    """How far off points may be in the natural drive (presets/anatomy/targets.toml)."""

    asked: Length
    silent: Length
    lower_lip: Length


@dataclass(frozen=True)
class ExactFigures:
    """How far off points of which nothing is asked may be in the other drives (presets/anatomy/targets.toml)."""

    filled: Length
    carried: Length
    beyond: float
    most: Share
    brow: Share


@dataclass(frozen=True)
class JawFigures:
    """Usual motions of the jaw (presets/anatomy/targets.toml)."""

    opening_asked: Length
    opening_silent: Length
    slide_asked: Length
    slide_silent: Length
    times: float


NATURAL = read_figures("targets.natural", NaturalFigures)
EXACT = read_figures("targets.exact", ExactFigures)
USUAL = read_figures("targets.jaw", JawFigures)


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
    believed : (m,) how far muscles are believed about each row at most, 0..1 (`belief`).
    opening, slide : usual size of the jaw's opening (at the chin) and of its slides, metres.
    """

    displacements: Floats
    doubts: Floats
    corrected: Bools
    carried: Bools
    muscles: Mapping[str, float]
    believed: Floats
    opening: float
    slide: float

    def same(self, other: Targets) -> bool:
        """Whether others want exactly the same."""
        mine, theirs = ((t.displacements, t.doubts, t.corrected, t.carried, t.believed) for t in (self, other))
        alike = all(np.array_equal(a, b, equal_nan=a.dtype.kind == "f") for a, b in zip(mine, theirs, strict=True))
        usual = (self.muscles, self.opening, self.slide) == (other.muscles, other.opening, other.slide)
        return alike and usual


def natural_targets(rows: FapRows, plan: Plan) -> Targets:
    """Every planned row, asked ones more firmly; what is asked and has no range, exactly."""
    goal, asked = rows.select(plan.goal), rows.select(plan.meant)
    beyond = np.isnan(goal) & ~np.isnan(asked)
    doubts = np.where(np.isnan(asked), NATURAL.silent, NATURAL.asked)
    doubts = np.where(np.isin(rows.numbers, INNER_LOWER_LIP_FAPS), NATURAL.lower_lip, doubts)
    doubts = np.where(beyond, 0.0, doubts)
    middles, loose = lip_middles(rows, plan.goal)
    return Targets(
        displacements=np.where(rows.unnamed, middles, np.where(beyond, asked, goal)),
        doubts=np.where(rows.unnamed, loose, doubts),
        corrected=np.ones(len(rows), dtype=bool),
        carried=np.zeros(len(rows), dtype=bool),
        muscles=plan.muscles,
        believed=np.ones(len(rows)),
        opening=JAW.usual_opening,
        slide=USUAL.slide_asked if _asks(plan.meant, 14, 15) else USUAL.slide_silent,
    )


def exact_targets(rows: FapRows, plan: Plan) -> Targets:
    """What is asked, exactly; what must go with it, softly and by muscles; the rest where the jaw carries it."""
    faps = plan.goal
    full, silent = filled(faps), np.isnan(rows.select(faps))
    middles, loose = lip_middles(rows, full)
    displacements = np.where(rows.unnamed, middles, rows.select(full))
    carried = np.isnan(displacements) & ~rows.unnamed
    doubts = np.where(carried, EXACT.carried, np.where(silent, EXACT.filled, 0.0))
    return Targets(
        displacements=np.where(carried, 0.0, displacements),
        doubts=np.where(rows.unnamed, loose, doubts),
        corrected=~silent | rows.unnamed,
        carried=carried,
        muscles={},
        believed=np.where(silent, 1.0, _believed(rows, faps)),
        opening=USUAL.opening_asked if _asks(faps, 3) else USUAL.opening_silent,
        slide=_usual_slide(rows, faps),
    )


def _believed(rows: FapRows, faps: Floats) -> Floats:
    """(m,) how far muscles are believed that FAPs (68,) ask something of, 0..1.

    They are less where more is asked than anatomy allows, and at the brows, of which FAPs tell little but the height.
    """
    possible = possible_shares(load_synergies(), faps)[rows.numbers - 1] ** EXACT.beyond
    return np.where(np.isin(rows.numbers, list(BROW_FAPS)), EXACT.brow, EXACT.most) * possible


def _usual_slide(rows: FapRows, faps: Floats) -> float:
    """Usual slide of the jaw, metres: some times what FAPs (68,) ask, so that a jaw that is to stay is left alone."""
    known = np.isin(rows.numbers, (14, 15))
    asked = float(np.abs(np.nan_to_num(rows.select(faps)[known])).max(initial=0.0))
    return float(np.clip(USUAL.times * asked, USUAL.slide_silent, USUAL.slide_asked))


def _asks(faps: Floats, *numbers: int) -> bool:
    """Whether FAPs (68,) say anything of these."""
    return bool(any(not np.isnan(faps[number - 1]) for number in numbers))
