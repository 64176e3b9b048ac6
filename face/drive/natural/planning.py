"""The plan of the natural drive: what a face does when it is asked for a few FAPs.

A profile names few FAPs, some beyond anatomy, some against one another, and is silent about the rest. Requests are
weighed against each FAP's range and against one another; what the profile does not say comes from a sparse,
non-negative mixture of action units that explains what it does say, with the emotion word's own mixture preferred.
Reasons: docs/muscles.md. Lengths are metres on the template face.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from ....arrays import Floats
from ....mpeg4 import FAP_COUNT
from ...figures import Length, read_figures
from ..plan import Plan
from ..request import Request
from .conflicts import doubts, smiling_eyes_spared
from .meaning import Meaning
from .mixture import Mixture, Weighed
from .ranges import carried_by_jaw, held
from .recognition import Shown
from .symmetry import evened
from .synergies import Synergies, load_synergies

LID_FAPS = (19, 20, 21, 22)
BROW_CHEEK_FAPS = (*range(31, 43), 61, 62, 63, 64)


@dataclass(frozen=True)
class SpreadFigures:
    """How far action units may miss what is asked, by part of the face (presets/anatomy/natural.toml)."""

    mouth: Length
    brow: Length
    lid: Length


SPREAD = read_figures("natural.spread", SpreadFigures)

#: A unit of which a plan holds no more than this is not named in it.
LEAST_TOLD = 0.01


class Natural:
    """Plans requests; the same for every face."""

    def __init__(self, data: Synergies | None = None) -> None:
        self.data = load_synergies() if data is None else data
        self._mixture = Mixture(self.data)
        self._meaning = Meaning(self.data)
        numbers = self.data.numbers
        brow = np.where(np.isin(numbers, BROW_CHEEK_FAPS), SPREAD.brow, SPREAD.mouth)
        self._spread = np.where(np.isin(numbers, LID_FAPS), SPREAD.lid, brow)

    def plan(self, request: Request) -> Plan:
        """The plan for a request; where no emotion is given, it is recognised. No shares: none is shown."""
        data, spread = self.data, self._spread
        emotion = request.emotion
        even, asymmetric = evened(request.faps)
        faps = even if emotion is None else self._meaning.meant(even, emotion)
        asked = ~np.isnan(faps[data.numbers - 1])
        wanted = np.nan_to_num(faps[data.numbers - 1] * data.per_fap)
        carried = carried_by_jaw(data, wanted)
        within = held(data, wanted, carried)
        doubt = doubts(data, spread, wanted, within, asked)
        limited = smiling_eyes_spared(data, within)
        shown = Shown.by_sight(faps) if emotion is None else Shown.by_word(emotion)
        weight = 1.0 / np.sqrt(spread**2 + doubt**2)
        one_sided = asymmetric or (emotion is not None and emotion.shows is not None and emotion.shows.one_sided)
        amounts = self._mixture.amounts(Weighed(limited, asked, weight, one_sided), shown)
        explained = data.units @ amounts
        trust = spread**2 / (spread**2 + doubt**2)
        goal = np.where(asked, explained + trust * (limited - explained), explained)
        least, most = (np.minimum(data.low, carried), np.maximum(data.high, carried))
        return Plan(
            request,
            goal=self._faps(np.clip(goal, np.minimum(least, limited), np.maximum(most, limited))),
            evened=even,
            meant=faps,
            limited=self._faps(np.where(asked, limited, np.nan)),
            muscles=self._hidden(amounts),
            units={n: float(a) for n, a in zip(data.unit_names, amounts, strict=True) if a > LEAST_TOLD},
        )

    def _faps(self, way: Floats) -> Floats:
        """(68,) FAP units from rows (m,) in metres."""
        faps = np.full(FAP_COUNT, np.nan)
        faps[self.data.numbers - 1] = way / self.data.per_fap
        return faps

    def _hidden(self, amounts: Floats) -> dict[str, float]:
        """Muscle name -> amount in metres that is expected of it, for what no FAP sees."""
        expected: dict[str, float] = {}
        for name, amount in zip(self.data.unit_names, amounts, strict=True):
            unit, _, side = name.partition("_")
            for muscle, per_unit in self.data.hidden.get(unit, {}).items():
                key = f"{muscle}_{side}"
                expected[key] = expected.get(key, 0.0) + per_unit * float(amount)
        return expected


@lru_cache(maxsize=1)
def natural() -> Natural:
    """The planner over the tables that come with Risorius."""
    return Natural()


def plan_naturally(request: Request) -> Plan:
    """The natural plan for a request."""
    return natural().plan(request)
