"""The six archetypal emotions: printed profiles (Table 5), statistics (Table 4), vocabularies (Table 2).

Source: Raouzaiou et al. 2002, sections 2 and 3. Two sign conventions meet in its tables: Table 4, and with it the
variants 0 of Table 5, give changes of feature distances, in which positive F19 to F22 open the eye and positive F5
lowers the lower lip; variants 1 and up are in MPEG-4's signs. ``signs="paper"`` gives what is printed, the default
``signs="mpeg4"`` turns the FAPs of data/signs.csv round where they are feature distances.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from types import MappingProxyType

from ...errors import ParameterError
from ...resources import STANDARD
from ...tables import read_csv
from ..standard import FAP_COUNT, FAPS
from .profile import ARCHETYPES, AS_PRINTED, Archetype, Profile, Range, Signs, check_archetype, check_signs


class Verified(StrEnum):
    """What Table 4 says of a FAP: figures, a dash (in the vocabulary, no figures) or a star (not in it)."""

    VERIFIED = "verified"
    UNVERIFIED = "unverified"
    ABSENT = "absent"


@dataclass(frozen=True)
class Statistic:
    """One cell of Table 4: mean and standard deviation in FAP units, in feature signs; None without figures."""

    fap: int
    archetype: Archetype
    status: Verified
    mean: float | None
    std: float | None

    def __post_init__(self) -> None:
        """Figures exactly where the status says so."""
        if (self.status is Verified.VERIFIED) != (self.mean is not None and self.std is not None):
            raise ParameterError(f"Table 4, F{self.fap}, {self.archetype}", "must have figures if verified", self.mean)


@dataclass(frozen=True)
class PrintedRange:
    """One range of Table 5 as printed, with what is known to be wrong or odd about it."""

    fap: int
    low: float
    high: float
    erratum: str
    note: str


@dataclass(frozen=True)
class BaseWord:
    """The word of Table 6 whose activation and angle an archetype has."""

    word: str
    activation: float
    angle: float


FEATURE_SIGNED: frozenset[int] = frozenset(row.integer("fap") for row in read_csv(STANDARD / "signs.csv"))
"""FAPs whose sign as a feature distance is opposite to MPEG-4's."""


def _read_profiles() -> dict[tuple[Archetype, int], tuple[PrintedRange, ...]]:
    """Table 5 as printed, by archetype and variant."""
    profiles: dict[tuple[Archetype, int], list[PrintedRange]] = {}
    for row in read_csv(STANDARD / "profiles.csv"):
        fap, low, high = row.integer("fap", least=1, most=FAP_COUNT), row.number("low"), row.number("high")
        entry = PrintedRange(fap, low, high, row.text("erratum", ""), row.text("note", ""))
        profiles.setdefault((row.choice("archetype", Archetype), row.integer("variant")), []).append(entry)
    return {key: tuple(entries) for key, entries in profiles.items()}


def _read_base_words() -> dict[Archetype, BaseWord]:
    """Activation and angle of each archetype from Table 6."""
    table = {row.text("word"): row for row in read_csv(STANDARD / "words.csv")}
    words = {}
    for row in read_csv(STANDARD / "archetypes.csv"):
        word = table[row.choice("word", table)]
        base = BaseWord(word.text("word"), word.number("activation"), word.number("angle"))
        words[row.choice("archetype", Archetype)] = base
    return words


def _read_statistics() -> dict[tuple[Archetype, int], Statistic]:
    """Table 4 by archetype and FAP."""
    return {
        (row.choice("archetype", Archetype), row.integer("fap")): Statistic(
            fap=row.integer("fap", least=1, most=FAP_COUNT),
            archetype=row.choice("archetype", Archetype),
            status=row.choice("status", Verified),
            mean=row.number("mean") if "mean" in row else None,
            std=row.number("std") if "std" in row else None,
        )
        for row in read_csv(STANDARD / "statistics.csv")
    }


PRINTED_PROFILES: Mapping[tuple[Archetype, int], tuple[PrintedRange, ...]] = MappingProxyType(_read_profiles())
"""Table 5 as printed: (archetype, variant) -> ranges."""

VARIANTS: Mapping[Archetype, tuple[int, ...]] = MappingProxyType(
    {name: tuple(sorted(variant for other, variant in PRINTED_PROFILES if other is name)) for name in ARCHETYPES}
)
"""Archetype -> numbers of its variants in Table 5."""

BASE_WORDS: Mapping[Archetype, BaseWord] = MappingProxyType(_read_base_words())
"""Archetype -> the word that carries its activation and angle."""

STATISTICS: Mapping[tuple[Archetype, int], Statistic] = MappingProxyType(_read_statistics())
"""Table 4: (archetype, FAP number) -> cell."""


def _read_vocabularies() -> dict[Archetype, frozenset[int]]:
    """Table 2 by archetype."""
    rows = [(row.choice("archetype", Archetype), row.integer("fap")) for row in read_csv(STANDARD / "vocabularies.csv")]
    return {name: frozenset(fap for owner, fap in rows if owner is name) for name in ARCHETYPES}


VOCABULARIES: Mapping[Archetype, frozenset[int]] = MappingProxyType(_read_vocabularies())
"""Table 2: archetype -> FAP numbers it may use."""

VOCABULARY_EXCEPTIONS: Mapping[tuple[Archetype, int], frozenset[int]] = MappingProxyType(
    {
        (row.choice("archetype", Archetype), row.integer("fap")): frozenset(map(int, row.numbers("variants")))
        for row in read_csv(STANDARD / "vocabulary_exceptions.csv")
    }
)
"""(archetype, FAP number) -> variants of Table 5 that use the FAP although Table 2 does not list it."""


def archetype(name: str, variant: int = 0, *, signs: str = Signs.MPEG4, activation: float | None = None) -> Profile:
    """One of the 25 profiles of Table 5.

    Parameters
    ----------
    name : an archetype, such as "fear".
    variant : its number in the table.
    signs : "mpeg4" (default) or "paper" (as printed, variants 0 in feature signs).
    activation : the activation at which the printed ranges are taken to hold; by default that of the archetype's word
        in Table 6. The paper's worked example (equation 12) takes 3.9 for "sad", whose row says 3.8.

    Raises
    ------
    ParameterError
        When there is no such archetype, variant or sign convention, or the activation is off the scale.

    Examples
    --------
    >>> fear = api.archetype("fear", 8)
    >>> fear.activation
    4.9
    >>> fear.ranges[3]  # open_jaw, in MNS / 1024
    (400.0, 560.0)
    """
    emotion, convention = check_archetype(name), check_signs(signs)
    if variant not in VARIANTS[emotion]:
        allowed = ", ".join(map(str, VARIANTS[emotion]))
        raise ParameterError(f"variant of {emotion}", f"must be one of {allowed}", variant)
    turned = FEATURE_SIGNED if variant == 0 and convention is Signs.MPEG4 else frozenset[int]()
    ranges: dict[int, Range] = {}
    for entry in PRINTED_PROFILES[emotion, variant]:
        low, high = sorted((entry.low, entry.high))  # surprise:3 prints its lids with low and high swapped
        ranges[entry.fap] = _turned(low, high) if entry.fap in turned else (low, high)
    return _profile(emotion, ranges, convention, activation, {emotion: int(variant)})


def initial_profile(name: str, *, signs: str = Signs.MPEG4, activation: float | None = None) -> Profile:
    """The initial profile of an archetype, out of the statistics of Table 4 by equations (1) to (3).

    (1) [m - s, m + s] for bidirectional FAPs; for unidirectional ones (2) cut at 0 from below where the mean is
    positive, or (3) from above where it is negative. FAPs without figures are left out.

    Parameters
    ----------
    name : an archetype.
    signs : "mpeg4" (default) or "paper" (feature distances, as Table 4 prints them).
    activation : as in `archetype`.

    Raises
    ------
    ParameterError
        When there is no such archetype or sign convention, or the activation is off the scale.

    Examples
    --------
    >>> low, high = api.initial_profile("joy").ranges[19]  # close_t_l_eyelid
    >>> low < high
    True
    """
    emotion, convention = check_archetype(name), check_signs(signs)
    ranges: dict[int, Range] = {}
    for (owner, number), cell in STATISTICS.items():
        if owner is not emotion or cell.mean is None or cell.std is None:
            continue
        low, high = _variation(cell.mean, cell.std, bidirectional=FAPS[number].bidirectional)
        turned = convention is Signs.MPEG4 and number in FEATURE_SIGNED
        ranges[number] = _turned(low, high) if turned else (low, high)
    return _profile(emotion, ranges, convention, activation, {})


def _variation(mean: float, std: float, *, bidirectional: bool) -> Range:
    """Equations (1) to (3)."""
    if bidirectional:
        return mean - std, mean + std
    return (max(0.0, mean - std), mean + std) if mean >= 0.0 else (mean - std, min(0.0, mean + std))


def _turned(low: float, high: float) -> Range:
    """The range with the other sign; 0.0 - x so that no -0.0 appears."""
    return 0.0 - high, 0.0 - low


def _profile(
    emotion: Archetype,
    ranges: dict[int, Range],
    signs: Signs,
    activation: float | None,
    variants: dict[Archetype, int],
) -> Profile:
    base = BASE_WORDS[emotion]
    return Profile(
        ranges=ranges,
        activation=base.activation if activation is None else activation,
        angle=base.angle,
        weights={emotion: 1.0},
        category=emotion,
        word=None,
        variants=variants,
        signs=signs,
        prototypes={emotion: AS_PRINTED},
    )
