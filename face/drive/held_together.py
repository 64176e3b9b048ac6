"""What a sewn mouth and shut lids can do of what is wanted: lips go together, the jaw drops a little, lids rest.

Lips that are one surface (`mesh.sewn`) would be pulled out into a web between them. So the wish to part is left out,
half by each lip, and what is left of it when the jaw drops is shared by all the skin round the mouth.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from ...arrays import Floats, Ints
from ..figures import Length, read_figures
from ..mesh.fap_rows import FapRows
from ..response.actuators import JAW
from .targets import Targets


@dataclass(frozen=True)
class SewnFigures:
    """How far sewn lips give way (presets/anatomy/targets.toml)."""

    drop: Length


SEWN = read_figures("targets.sewn", SewnFigures)

#: FAPs that move the upper lip down, with those that move the lower lip up at the same place.
LIP_FAPS = ((4, 5), (8, 10), (9, 11), (51, 52), (55, 57), (56, 58))
#: The jaw's opening; and what goes with it: corners of the mouth up and down, jaw and lips forward, the chin.
JAW_FAP, WITH_THE_JAW = 3, (12, 13, 14, 16, 17, 18, 59, 60)
#: FAPs of each eye's lids.
LID_FAPS = {"l": (19, 21), "r": (20, 22)}

#: Why a FAP is not met, by what is sewn.
LIPS_SEWN = "the lips are sewn together"
LIDS_SEWN = "the lids are shut and one surface"

#: Targets that differ by less are the same, metres.
SAME = 1e-9


def held_together(rows: FapRows, targets: Targets, sewn: frozenset[str]) -> Targets:
    """Targets that a face can follow whose openings `sewn` ("mouth", "l", "r") are none."""
    if not sewn:
        return targets
    wanted, place = targets.displacements.copy(), rows.row_of
    if "mouth" in sewn:
        for above, below in LIP_FAPS:
            _together(wanted, place.get(above), place.get(below))
        _drop_less(wanted, place)
    for side in sewn & LID_FAPS.keys():
        known = np.array([place[number] for number in LID_FAPS[side] if number in place], dtype=np.int64)
        wanted[known] = np.where(np.isnan(wanted[known]), np.nan, 0.0)
    return replace(targets, displacements=wanted)


def _drop_less(wanted: Floats, place: Mapping[int, int]) -> None:
    """Let the jaw drop as far as sewn lips let it, and what goes with it go along in the same measure, in place."""
    jaw = place.get(JAW_FAP)
    if jaw is None or not wanted[jaw] > JAW.sewn_opening:
        return
    along = [place[number] for number in (JAW_FAP, *WITH_THE_JAW) if number in place]
    wanted[along] *= JAW.sewn_opening / wanted[jaw]


def _together(wanted: Floats, above: int | None, below: int | None) -> None:
    """Let the rows of an upper lip's way down and a lower lip's way up not part, in place; metres, NaN where silent."""
    down = 0.0 if above is None or np.isnan(wanted[above]) else float(wanted[above])
    up = 0.0 if below is None or np.isnan(wanted[below]) else float(wanted[below])
    if down + up >= 0.0:
        return  # they meet
    both = max((up - down) / 2.0, -SEWN.drop)
    for row, value in ((above, -both), (below, both)):
        if row is not None and not np.isnan(wanted[row]):
            wanted[row] = value


def held_reasons(rows: FapRows, before: Targets, after: Targets) -> dict[int, str]:
    """FAP number -> why, of every row that `held_together` has changed."""
    changed: Ints = np.flatnonzero(np.abs(before.displacements - after.displacements) > SAME)
    lids = {number for numbers in LID_FAPS.values() for number in numbers}
    return {n: LIDS_SEWN if n in lids else LIPS_SEWN for n in rows.numbers[changed].tolist() if n}
