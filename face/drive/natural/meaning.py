"""What a face is to show for an emotion word: the profile beside what its action units do.

The first paper's profiles name few FAPs, and some that people do not show (brows that rise in joy). So each FAP that an
action unit of the emotion moves in the main is asked as the units move it: where the profile asks the same way, as far
as the profile says between once and twice what the units do; where it is silent or asks the other way, as the units do.
All else is asked as the profile asks; or, where a word has action units of its own (presets/emotions), not at all.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ....arrays import Bools, Floats
from ....errors import FormatError
from ....mpeg4 import (
    ACTIVATION_MAX,
    ARCHETYPES,
    AS_PRINTED,
    BASE_WORDS,
    FAP_COUNT,
    Archetype,
    Feeling,
    Prototype,
    check_prototype,
    load_prototypes,
)
from ...figures import Length, Share, read_figures
from ...skin.outer import smoothstep
from .synergies import Synergies


@dataclass(frozen=True)
class MeaningFigures:
    """Which FAPs an emotion has a say in (presets/anatomy/natural.toml)."""

    main: Share
    said: Length
    most: float


MEANING = read_figures("natural.meaning", MeaningFigures)


class Meaning:
    """What emotions show, over some tables of units."""

    def __init__(self, data: Synergies) -> None:
        self.data = data
        self.prototypes = load_prototypes()
        for ways in self.prototypes.values():
            for way in ways.values():
                _refuse_unknown(way, data.unit_names)
        largest = np.abs(data.shown).max(axis=0)
        self._main = np.abs(data.shown) >= MEANING.main * largest

    def meant(self, faps: Floats, feeling: Feeling) -> Floats:
        """(68,) what is asked of a face for FAPs (68,) of an emotion; NaN where neither says anything."""
        shown, full, still = self._units(feeling)
        rows = self.data.numbers - 1
        asked = faps[rows] * self.data.per_fap
        there = np.nan_to_num(asked)
        held = np.sign(shown) * np.clip(np.abs(there), np.abs(shown), MEANING.most * np.abs(shown))
        agreed = np.where(there * shown > 0.0, held, shown)
        say = smoothstep(full / MEANING.said)
        mixed = agreed if feeling.shows is not None else say * agreed + (1.0 - say) * there
        mixed = np.where(still > 0.0, (1.0 - still) * mixed, mixed)
        known: Bools = ~np.isnan(asked) | (say > 0.5) | (still > 0.5)
        result = np.full(FAP_COUNT, np.nan)
        result[rows] = np.where(known, mixed / self.data.per_fap, np.nan)
        others = np.ones(FAP_COUNT, dtype=bool)
        others[rows] = False
        result[others] = faps[others]
        return result

    def _units(self, feeling: Feeling) -> tuple[Floats, Floats, Floats]:
        """(m,) each: metres that units move a FAP; the same at 7 of units it is a main one of; share that stills it."""
        data = self.data
        if feeling.shows is not None:
            return self._units_of_word(feeling, feeling.shows)
        shown, full, still = (np.zeros(len(data.numbers)) for _ in range(3))
        for emotion, share in feeling.items():
            way = feeling.prototypes.get(str(emotion))
            if share <= 0.0 or way == AS_PRINTED:
                continue
            own = self._prototype(emotion, way)
            activation = BASE_WORDS[emotion].activation if feeling.activation is None else feeling.activation
            shown += share * feeling.strength * (data.shown @ own.vector(activation, data.unit_names))
            most = own.vector(ACTIVATION_MAX, data.unit_names)
            full += share * (np.abs(data.shown) * self._main) @ most
            still += share * np.isin(data.numbers, own.still)
        return shown, full, still

    def _units_of_word(self, feeling: Feeling, own: Prototype) -> tuple[Floats, Floats, Floats]:
        """The same of a word with units of its own."""
        data = self.data
        _refuse_unknown(own, data.unit_names)
        activation = own.activation if feeling.activation is None else feeling.activation
        shown = feeling.strength * (data.shown @ own.vector(activation, data.unit_names))
        most = own.vector(ACTIVATION_MAX, data.unit_names)
        full = (np.abs(data.shown) * self._main) @ most
        return shown, full, np.zeros(len(data.numbers))

    def _prototype(self, emotion: Archetype, way: str | None) -> Prototype:
        """The prototype of a name, or an archetype's usual one."""
        own = self.prototypes[emotion]
        return next(iter(own.values())) if way is None else own[check_prototype(emotion, way)]


def _refuse_unknown(way: Prototype, unit_names: tuple[str, ...]) -> None:
    """Refuse a prototype of action units that no table has."""
    known = {*unit_names, *(name.partition("_")[0] for name in unit_names)}
    if missing := set(way.units) - known:
        problem = f"[{way.emotion}.{way.name}] names {', '.join(sorted(missing))}, which synergies.toml has not"
        raise FormatError("prototypes.toml" if way.emotion in ARCHETYPES else "emotion presets", problem)
