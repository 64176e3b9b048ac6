"""Words and the wheel: Table 6, categories, any point of the wheel, and what is refused."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from risorius.errors import ParameterError
from risorius.mpeg4 import (
    ARCHETYPES,
    BASE_WORDS,
    TABLE_WORDS,
    WORDS,
    Archetype,
    archetype,
    between,
    default_variant,
    expression,
    find_word,
    neighbours,
)

SILENT = {"accepting", "neutral"}


def test_table_6_as_printed() -> None:
    assert len(TABLE_WORDS) == 14
    printed = {name: (word.activation, word.evaluation, word.angle) for name, word in TABLE_WORDS.items()}
    assert printed["accepting"] == (None, None, 0.0)
    assert printed["terrified"] == (6.3, 3.4, 75.7)
    assert printed["sad"] == (3.8, 2.4, 108.5)
    assert printed["eager"] == (5.0, 5.1, 311.0)
    assert printed["guilty"] == (4.0, 1.1, 102.3)
    assert set(TABLE_WORDS) < set(WORDS)
    for name, word in TABLE_WORDS.items():
        loaded = WORDS[name]
        assert (loaded.activation, loaded.evaluation, loaded.angle) == (word.activation, word.evaluation, word.angle)
        assert loaded.category == word.category


def test_every_preset_word_gives_a_profile_that_says_why() -> None:
    assert len(WORDS) >= 14 + 6 + 10
    for name, word in WORDS.items():
        profile = expression(name)
        assert profile.word == name
        assert word.reason
        assert word.source
        if name in SILENT:
            assert profile.neutral
            assert np.isnan(profile.frame()).all()
            assert profile.weights == {}
        else:
            assert profile.activation == word.activation
            assert sum(profile.weights.values()) == pytest.approx(1.0)
            assert np.nanmax(np.abs(profile.frame())) > 10.0


def test_the_projects_own_words_say_so() -> None:
    own = {name for name in WORDS if name not in TABLE_WORDS and name not in ARCHETYPES}
    assert len(own) >= 10
    assert all("own choice" in WORDS[name].source for name in own)
    assert all("Raouzaiou" in WORDS[name].source for name in TABLE_WORDS)


@pytest.mark.parametrize(
    ("word", "category", "variant"),
    [("terrified", "fear", 8), ("worried", "fear", 8), ("sad", "sadness", 0), ("angry", "anger", 1),
     ("disgusted", "disgust", 0), ("joyful", "joy", 1), ("delighted", "joy", 1), ("eager", "joy", 1),
     ("surprised", "surprise", 2), ("fear", "fear", 8)],
)  # fmt: skip
def test_a_word_of_a_category_is_its_archetype_at_the_words_activation(word: str, category: str, variant: int) -> None:
    profile = expression(word)
    assert profile.category == category
    assert profile.variant == variant == default_variant(category)
    activation = WORDS[word].activation
    assert activation is not None
    assert profile.ranges == archetype(category, variant).scaled(activation).ranges


def test_worrieds_category_wins_over_its_angle() -> None:
    worried = expression("worried")
    assert worried.category is Archetype.FEAR
    assert worried.angle == 126.0
    assert worried.weights == {Archetype.FEAR: 1.0}


def test_guilty_lies_between_fear_and_sadness() -> None:
    guilty = expression("guilty")
    expected = between(archetype("fear", 8), archetype("sadness", 0), activation=4.0, angle=102.3)
    assert guilty.ranges == expected.ranges
    assert guilty.category is None
    assert guilty.variant is None
    assert guilty.variants == {Archetype.FEAR: 8, Archetype.SADNESS: 0}
    assert guilty.weights == pytest.approx({Archetype.FEAR: 6.2 / 38.2, Archetype.SADNESS: 32.0 / 38.2})


def test_patient_wraps_round_the_zero_of_the_wheel() -> None:
    assert expression("patient").weights.keys() == {Archetype.JOY, Archetype.FEAR}


def test_the_neutral_word_stays_neutral_at_any_activation() -> None:
    assert expression("accepting", activation=6.0).neutral
    with pytest.raises(ParameterError, match="activation"):
        expression("accepting", activation=99)


def test_named_neighbours_replace_those_of_the_angle() -> None:
    startled = expression("startled")
    assert startled.weights == pytest.approx({Archetype.FEAR: 0.5, Archetype.SURPRISE: 0.5})


def test_a_word_at_another_activation() -> None:
    assert expression("afraid", activation=6.3).ranges == expression("terrified").ranges
    assert expression("guilty", activation=2.0).frame() == pytest.approx(
        expression("guilty").frame() / 2.0, nan_ok=True
    )


def test_variants_can_be_chosen() -> None:
    assert expression("fear", variants={"fear": 4}).variant == 4
    assert expression("fear", variants=4).ranges == archetype("fear", 4).ranges
    assert expression("guilty", variants={"fear": 4}).variants == {Archetype.FEAR: 4, Archetype.SADNESS: 0}
    with pytest.raises(ParameterError, match="variant of fear"):
        expression("fear", variants=11)
    with pytest.raises(ParameterError, match="map archetypes"):
        expression("guilty", variants=4)


def test_the_papers_signs_pass_through() -> None:
    assert expression("sad", signs="paper").ranges == archetype("sadness", 0, signs="paper").ranges


@given(st.floats(0.0, 360.0, exclude_max=True), st.floats(1.0, 7.0))
def test_any_point_of_the_wheel_lies_between_its_neighbours(angle: float, activation: float) -> None:
    profile = expression(angle=angle, activation=activation)
    assert profile.activation == activation
    assert profile.angle == angle
    assert sum(profile.weights.values()) == pytest.approx(1.0)
    assert 1 <= len(profile.weights) <= 2
    # The neighbours are the nearest on either side: no other archetype lies nearer on that side.
    gaps = {name: (BASE_WORDS[name].angle - angle + 180.0) % 360.0 - 180.0 for name in ARCHETYPES}
    above = min((gap, name) for name, gap in gaps.items() if gap >= 0.0)[1]
    below = max((gap, name) for name, gap in gaps.items() if gap <= 0.0)[1]
    assert profile.weights.keys() <= {above, below}
    heavier = max(profile.weights, key=lambda name: profile.weights[name])
    assert abs(gaps[heavier]) == pytest.approx(min(abs(gaps[above]), abs(gaps[below])), abs=1e-6)


@pytest.mark.parametrize("name", ARCHETYPES)
def test_an_archetypes_own_angle_is_the_archetype(name: Archetype) -> None:
    angle = BASE_WORDS[name].angle
    assert neighbours(angle) == (name, name)
    assert neighbours(angle + 360.0) == (name, name)
    made = expression(angle=angle, activation=3.0)
    assert made.ranges == archetype(name, default_variant(name)).scaled(3.0).ranges


@pytest.mark.parametrize(
    ("word", "hint"),
    [
        ("gilty", "guilty"),
        ("terified", "terrified"),
        ("joyfull", "joyful"),
        ("Happiness", "joy\\?"),
        ("scared", "fear\\?"),
        ("contempt", "contemptuous"),
    ],
)
def test_an_unknown_word_is_refused_with_a_suggestion(word: str, hint: str) -> None:
    with pytest.raises(ParameterError, match=rf"did you mean .*{hint}"):
        expression(word)


def test_a_word_like_no_other_lists_what_is_known() -> None:
    with pytest.raises(ParameterError, match=r"use one of .*afraid.*worried"):
        expression("xyzzy")
    with pytest.raises(ParameterError, match="emotion word"):
        find_word(3)  # type: ignore[arg-type]


def test_case_and_blanks_do_not_matter() -> None:
    assert expression(" Guilty ") == expression("guilty")


@pytest.mark.parametrize("activation", [0, 99, -1, math.nan])
@pytest.mark.parametrize("word", ["guilty", "terrified", "neutral", "startled"])
def test_an_activation_off_the_scale_is_refused(word: str, activation: float) -> None:
    with pytest.raises(ParameterError, match=r"scale from 1 .* to 7"):
        expression(word, activation=activation)


def test_word_or_angle_and_nothing_else() -> None:
    with pytest.raises(ParameterError, match="either a word or an angle"):
        expression()
    with pytest.raises(ParameterError, match="either a word or an angle"):
        expression("joy", angle=20.0)
    with pytest.raises(ParameterError, match="must be given with an angle"):
        expression(angle=20.0)
    with pytest.raises(ParameterError, match="finite"):
        expression(angle=math.nan, activation=3.0)
