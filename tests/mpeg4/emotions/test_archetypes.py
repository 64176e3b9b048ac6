"""Tables 2, 4 and 5 of the first paper, in both sign conventions."""

from __future__ import annotations

import pytest
from risorius.errors import ParameterError
from risorius.mpeg4 import (
    ARCHETYPES,
    BASE_WORDS,
    FAPS,
    FEATURE_SIGNED,
    PRINTED_PROFILES,
    STATISTICS,
    TABLE_WORDS,
    VARIANTS,
    VOCABULARIES,
    VOCABULARY_EXCEPTIONS,
    Archetype,
    archetype,
    initial_profile,
)

ALL = [(name, variant) for name in ARCHETYPES for variant in VARIANTS[name]]
EYES_AND_LIP = {5, 19, 20, 21, 22}


def test_table_5_has_25_profiles() -> None:
    assert {name.value: len(numbers) for name, numbers in VARIANTS.items()} == {
        "joy": 4, "sadness": 1, "anger": 5, "fear": 10, "disgust": 1, "surprise": 4,
    }  # fmt: skip
    assert all(numbers == tuple(range(len(numbers))) for numbers in VARIANTS.values())


@pytest.mark.parametrize(("name", "variant"), ALL)
def test_paper_signs_give_table_5_as_printed(name: Archetype, variant: int) -> None:
    printed = {entry.fap: tuple(sorted((entry.low, entry.high))) for entry in PRINTED_PROFILES[name, variant]}
    assert archetype(name, variant, signs="paper").ranges == printed


@pytest.mark.parametrize(("name", "variant"), ALL)
def test_mpeg4_signs_turn_five_faps_of_variants_0_and_nothing_else(name: Archetype, variant: int) -> None:
    paper, mpeg4 = archetype(name, variant, signs="paper").ranges, archetype(name, variant).ranges
    assert paper.keys() == mpeg4.keys()
    for number, (low, high) in paper.items():
        turned = variant == 0 and number in EYES_AND_LIP
        assert mpeg4[number] == ((-high, -low) if turned else (low, high))


def test_a_few_ranges_read_off_the_page() -> None:
    assert archetype("anger", 4).ranges[16] == (-355.0, -245.0)
    assert archetype("joy", 3).ranges[22] == (38.0, 162.0)
    assert archetype("fear", 6).ranges[10] == (-120.0, -80.0)
    assert archetype("fear", 5).ranges[37] == (0.0, 0.0)
    assert archetype("surprise", 3).ranges[19] == (-184.0, -158.0)
    assert archetype("sadness", 0, signs="paper").ranges[19] == (-265.0, -41.0)
    assert archetype("sadness", 0).ranges[19] == (41.0, 265.0)


@pytest.mark.parametrize("name", ["fear", "surprise"])
def test_mpeg4_signs_open_the_eyes_and_drop_the_lip_with_the_jaw(name: str) -> None:
    frame = archetype(name, 0).frame()
    assert frame[3 - 1] > 0.0
    assert frame[5 - 1] < 0.0
    assert all(frame[number - 1] < 0.0 for number in (19, 20, 21, 22))


@pytest.mark.parametrize("name", ["joy", "sadness", "disgust"])
def test_mpeg4_signs_narrow_the_eyes(name: str) -> None:
    frame = archetype(name, 0).frame()
    assert all(frame[number - 1] > 0.0 for number in (19, 20, 21, 22))


@pytest.mark.parametrize("signs", ["paper", "mpeg4"])
@pytest.mark.parametrize("name", ARCHETYPES)
def test_equations_1_to_3_on_table_4_give_variant_0_of_table_5(name: Archetype, signs: str) -> None:
    initial, printed = initial_profile(name, signs=signs).ranges, archetype(name, 0, signs=signs).ranges
    errata = {entry.fap for entry in PRINTED_PROFILES[name, 0] if entry.erratum}
    assert initial.keys() == printed.keys()
    assert {number for number in printed if initial[number] != printed[number]} == errata


def test_the_printed_errata_are_one_slip_each() -> None:
    slips = [(key, entry) for key, entries in PRINTED_PROFILES.items() for entry in entries if entry.erratum]
    assert len(slips) == 6
    for (name, variant), entry in slips:
        low, high = initial_profile(name, signs="paper").ranges[entry.fap]
        assert variant == 0
        assert max(abs(low - entry.low), abs(high - entry.high)) in (1.0, 10.0)


def test_unidirectional_faps_are_cut_at_zero(monkeypatch: pytest.MonkeyPatch) -> None:
    from risorius.mpeg4.emotions import archetypes
    from risorius.mpeg4.emotions.archetypes import Statistic, Verified

    wide = {
        (Archetype.FEAR, 3): Statistic(3, Archetype.FEAR, Verified.VERIFIED, 50.0, 80.0),  # open_jaw
        (Archetype.FEAR, 41): Statistic(41, Archetype.FEAR, Verified.VERIFIED, -50.0, 80.0),  # lift_l_cheek
        (Archetype.FEAR, 31): Statistic(31, Archetype.FEAR, Verified.VERIFIED, 50.0, 80.0),  # bidirectional
    }
    monkeypatch.setattr(archetypes, "STATISTICS", wide)
    assert initial_profile("fear").ranges == {3: (0.0, 130.0), 31: (-30.0, 130.0), 41: (-130.0, 0.0)}


def test_profiles_keep_to_their_vocabulary_but_for_listed_exceptions() -> None:
    outside: dict[tuple[Archetype, int], set[int]] = {}
    for name, variant in ALL:
        for number in archetype(name, variant).ranges:
            if number not in VOCABULARIES[name]:
                outside.setdefault((name, number), set()).add(variant)
    assert outside == {key: set(variants) for key, variants in VOCABULARY_EXCEPTIONS.items()}


def test_vocabularies_are_symmetric_and_as_long_as_printed() -> None:
    sizes = {"joy": 17, "sadness": 10, "anger": 14, "fear": 19, "disgust": 19, "surprise": 20}
    for name, numbers in VOCABULARIES.items():
        assert {FAPS[number].mirror or number for number in numbers} == numbers
        assert len(numbers) == sizes[name]


def test_table_4_has_figures_only_inside_the_vocabulary() -> None:
    lids = {(Archetype.ANGER, 21), (Archetype.ANGER, 22)}  # rows shared with the upper lids
    for (name, number), cell in STATISTICS.items():
        if cell.status != "absent":
            assert number in VOCABULARIES[name] or (name, number) in lids
        assert (cell.std is None) == (cell.mean is None)
        assert cell.std is None or cell.std > 0.0
    assert STATISTICS[Archetype.SURPRISE, 53].mean == -82.0
    assert STATISTICS[Archetype.JOY, 22].std == 122.0


def test_archetypes_have_activation_and_angle_of_their_words() -> None:
    assert FEATURE_SIGNED == EYES_AND_LIP
    for name in ARCHETYPES:
        profile, word = archetype(name, 0), TABLE_WORDS[BASE_WORDS[name].word]
        assert (profile.activation, profile.angle) == (word.activation, word.angle)
        assert profile.category is name
        assert profile.weights == {name: 1.0}
        assert profile.variant == 0


def test_wrong_archetype_variant_or_signs_are_refused_by_name() -> None:
    with pytest.raises(ParameterError, match="joy, sadness, anger, fear, disgust, surprise"):
        archetype("happiness")
    with pytest.raises(ParameterError, match=r"variant of fear must be one of 0, 1, 2, .* but it is 10"):
        archetype("fear", 10)
    with pytest.raises(ParameterError, match="mpeg4, paper"):
        archetype("fear", 8, signs="iso")
    with pytest.raises(ParameterError, match="archetype"):
        initial_profile("terror")
