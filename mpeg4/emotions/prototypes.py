"""What an emotion shows at an activation: amounts of action units, after the FACS prototypes.

Source of the figures: presets/prototypes.toml for the archetypes, presets/emotions for words that show something of
their own. What an action unit does to a face is the face's matter.
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


@dataclass(frozen=True)
class Prototype:
    """One way of showing an emotion.

    Attributes
    ----------
    emotion, name : whose it is, and what it is called: "anger", "pressed".
    activation : the emotion's own.
    units : action unit -> how it grows; "AU12_l" is its left half alone. still : FAPs that stay at rest.
    """

    emotion: str
    name: str
    activation: float
    units: Mapping[str, Growth]
    still: tuple[int, ...] = ()

    def amounts(self, activation: float) -> dict[str, float]:
        """Action unit -> amount at an activation."""
        return {unit: growth.at(activation, self.activation) for unit, growth in self.units.items()}

    def vector(self, activation: float, unit_names: tuple[str, ...]) -> Floats:
        """(k,) amounts of half units at an activation."""
        of = self.amounts(activation)
        return np.array(
            [of.get(name, 0.0) + of.get(name.partition("_")[0], 0.0) * ("_" in name) for name in unit_names]
        )

    @property
    def one_sided(self) -> bool:
        """Whether it differs from left to right."""
        return any("_" in unit for unit in self.units)


def _growth(entry: KeyedTable, unit: str, activation: float) -> Growth:
    """One action unit of a prototype; activation is the emotion's own."""
    start, own, seven = map(float, entry.numbers(unit, 3))
    if not 0.0 <= start < min(activation, ACTIVATION_MAX) or own < 0.0 or seven < 0.0:
        rule = f"must be the activation of its beginning, from 0 below {activation:g}, and two amounts of 0 or more"
        raise entry.refuse(rule, unit)
    return Growth(start, own, seven)


def read_prototype(entry: KeyedTable, emotion: str, name: str, activation: float) -> Prototype:
    """One prototype of a table, of an emotion with its own activation.

    Raises
    ------
    FormatError : names the file, the key and the rule.
    """
    units = {unit: _growth(entry, unit, activation) for unit in entry if unit not in ("source", "still")}
    still = tuple(int(number) for number in entry.numbers("still")) if "still" in entry else ()
    for number in still:
        if number not in FAPS:
            raise entry.refuse(f"names FAP {number}, which does not exist", "still")
    return Prototype(emotion, name, activation, units, still)


@lru_cache(maxsize=4)
def load_prototypes(path: Path = TABLE) -> Mapping[Archetype, Mapping[str, Prototype]]:
    """Archetype -> name -> prototype; the first of an archetype is its usual one.

    Raises
    ------
    FormatError : names the file, where in it, and the rule; an archetype that has none.

    Examples
    --------
    >>> list(api.load_prototypes()[api.Archetype.ANGER])
    ['bared', 'pressed', 'glaring']
    """
    table = read_toml(path)
    return {
        emotion: {
            name: read_prototype(entry, emotion.value, name, BASE_WORDS[emotion].activation)
            for name, entry in table.tables(emotion.value).items()
        }
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
