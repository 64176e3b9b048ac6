"""What an emotion shows at an activation: amounts of action units, after the FACS prototypes.

Source of the figures: presets/prototypes.toml. What an action unit does to a face is the face's matter.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np

from ...arrays import Floats
from ...errors import ParameterError
from ...resources import PRESETS
from ...tables import KeyedTable, read_toml
from ..standard import FAPS
from .archetypes import BASE_WORDS
from .profile import ARCHETYPES, Archetype, check_archetype
from .wheel import ACTIVATION_MAX

#: The prototypes that come with Risorius.
TABLE = PRESETS / "prototypes.toml"


@dataclass(frozen=True)
class Growth:
    """How an action unit grows with activation: 0 up to `start`, straight to `own` and on to `seven`."""

    start: float
    own: float
    seven: float

    def at(self, activation: float, own_activation: float) -> float:
        """The amount at an activation; `own_activation` is the archetype's."""
        return float(np.interp(activation, [self.start, own_activation, ACTIVATION_MAX], [0.0, self.own, self.seven]))


@dataclass(frozen=True, eq=False)
class Prototype:
    """One way of showing an emotion.

    Attributes
    ----------
    emotion, name : whose it is, and what it is called: "anger", "pressed".
    units : action unit -> how it grows. still : FAPs that stay at rest.
    """

    emotion: Archetype
    name: str
    units: Mapping[str, Growth]
    still: tuple[int, ...] = ()

    def amounts(self, activation: float) -> dict[str, float]:
        """Action unit -> amount at an activation."""
        own = BASE_WORDS[check_archetype(self.emotion)].activation
        return {unit: growth.at(activation, own) for unit, growth in self.units.items()}

    def vector(self, activation: float, unit_names: tuple[str, ...]) -> Floats:
        """(k,) amounts of half units at an activation."""
        whole = self.amounts(activation)
        return np.array([whole.get(name.partition("_")[0], 0.0) for name in unit_names])


def _growth(entry: KeyedTable, unit: str) -> Growth:
    """One action unit of a prototype."""
    start, own, seven = entry.numbers(unit, 3)
    if not 0.0 <= start < ACTIVATION_MAX or own < 0.0 or seven < 0.0:
        raise entry.refuse(
            "must be the activation of its beginning, from 0 below 7, and two amounts of 0 or more", unit
        )
    return Growth(start, own, seven)


def _prototype(emotion: Archetype, name: str, entry: KeyedTable) -> Prototype:
    """One prototype of the table."""
    units = {unit: _growth(entry, unit) for unit in entry if unit not in ("source", "still")}
    still = tuple(int(number) for number in entry.numbers("still")) if "still" in entry else ()
    for number in still:
        if number not in FAPS:
            raise entry.refuse(f"names FAP {number}, which does not exist", "still")
    return Prototype(emotion, name, units, still)


@lru_cache(maxsize=4)
def load_prototypes(path: Path = TABLE) -> Mapping[Archetype, Mapping[str, Prototype]]:
    """Archetype -> name -> prototype; the first of an archetype is its usual one.

    Raises
    ------
    FormatError : names the file, where in it, and the rule; an archetype that has none.

    Examples
    --------
    >>> list(api.load_prototypes()[api.Archetype.ANGER])
    ['bared', 'pressed']
    """
    table = read_toml(path)
    return {
        emotion: {name: _prototype(emotion, name, entry) for name, entry in table.tables(emotion.value).items()}
        for emotion in ARCHETYPES
    }


def check_prototype(emotion: str, name: str) -> str:
    """The name of a prototype of an archetype.

    Raises
    ------
    ParameterError : lists those there are.
    """
    known = load_prototypes()[check_archetype(emotion)]
    if name not in known:
        raise ParameterError(f"prototype of {emotion}", f"must be one of {', '.join(known)}", name)
    return name
