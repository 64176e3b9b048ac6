"""Expressions that the robust rule knows beside the 25 profiles of Table 5.

Source: presets/profiles_beside.csv says for each where its figures are from.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from types import MappingProxyType

from ...resources import PRESETS
from ...tables import read_csv
from ..standard import FAP_COUNT
from .archetypes import BASE_WORDS, VARIANTS, archetype
from .fuzzy import FuzzyClass, archetype_classes
from .profile import AS_PRINTED, Archetype, Profile, Range

TABLE = PRESETS / "profiles_beside.csv"


@cache
def beside() -> Mapping[tuple[Archetype, int], Profile]:
    """Profiles beside Table 5, by emotion and variant; variants go on where the table ends."""
    ranges: dict[tuple[Archetype, int], dict[int, Range]] = {}
    for row in read_csv(TABLE):
        key = row.choice("archetype", Archetype), row.integer("variant", least=1)
        if key[1] in VARIANTS[key[0]]:
            raise row.refuse(f"is a variant that {key[0]} has in Table 5 already: {key[1]}", "variant")
        number = row.integer("fap", least=1, most=FAP_COUNT)
        ranges.setdefault(key, {})[number] = (row.number("low"), row.number("high"))
    return MappingProxyType({key: _profile(*key, of_fap) for key, of_fap in ranges.items()})


def known_profile(name: Archetype, variant: int) -> Profile:
    """A profile of Table 5 or beside it, in MPEG-4 signs."""
    return beside()[name, variant] if (name, variant) in beside() else archetype(name, variant)


@cache
def known_classes() -> Mapping[tuple[Archetype, int], FuzzyClass]:
    """The fuzzy classes of Table 5 (`archetype_classes`) and those beside it."""
    return MappingProxyType({**archetype_classes(), **{key: FuzzyClass.of(each) for key, each in beside().items()}})


def _profile(name: Archetype, variant: int, ranges: dict[int, Range]) -> Profile:
    """A profile with the emotion's own activation and angle."""
    base = BASE_WORDS[name]
    return Profile(
        ranges=ranges,
        activation=base.activation,
        angle=base.angle,
        weights={name: 1.0},
        category=name,
        word=None,
        variants={name: variant},
        prototypes={name: AS_PRINTED},
    )
