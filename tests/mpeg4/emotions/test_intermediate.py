"""Sections 4.1 and 4.2 of the first paper: Tables 7 and 8, and what must hold of any mixture."""

from __future__ import annotations

import csv
import math
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from risorius.errors import ParameterError
from risorius.mpeg4 import ARCHETYPES, BASE_WORDS, VARIANTS, Archetype, Profile, archetype, between
from risorius.mpeg4.emotions.profile import Range
from risorius.mpeg4.emotions.wheel import position, turn

# FAP units: the paper rounds mostly away from zero to tens (720 is printed 730); 1e-9 lets 4.9 be no binary number.
#: How far Table 7 is off its own rule: it rounds to tens, and the lids of "terrified" are a whole ten off.
ROUNDING = {"afraid": 0.0, "worried": 5.0, "terrified": 10.0 + 1e-9}


def _created(table: int, word: str) -> dict[int, Range]:
    """Ranges of Table 7 or 8 as printed."""
    path = Path(__file__).parents[1] / "data" / "created_profiles.csv"
    lines = [line for line in path.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    ranges: dict[int, Range] = {}
    for row in csv.DictReader(lines):
        if int(row["table"]) == table and row["word"] == word:
            low, high = sorted((float(row["low"]), float(row["high"])))
            ranges[int(row["fap"])] = (low, high)
    return ranges


def _assert_close(computed: dict[int, Range], printed: dict[int, Range], tolerance: float) -> None:
    assert computed.keys() == printed.keys()
    for number, ends in printed.items():
        assert computed[number] == pytest.approx(ends, abs=tolerance), f"F{number}"


@pytest.mark.parametrize(("word", "activation"), [("afraid", 4.9), ("terrified", 6.3), ("worried", 3.9)])
def test_table_7(word: str, activation: float) -> None:
    printed = _created(7, word)
    assert len(printed) == 12
    _assert_close(archetype("fear", 8).scaled(activation).ranges, printed, ROUNDING[word])


def test_table_8_in_the_papers_signs() -> None:
    afraid = archetype("fear", 8, signs="paper")
    sad = archetype("sadness", 0, signs="paper", activation=3.9)
    _assert_close(afraid.ranges, _created(8, "afraid"), 0.0)
    _assert_close(sad.ranges, _created(8, "sad"), 0.0)
    guilty = between(afraid, sad, activation=4.0, angle=102.3)
    _assert_close(guilty.ranges, _created(8, "guilty"), 3.5)  # the paper rounds what it mixes, too


def test_the_worked_example_13() -> None:
    guilty = between(
        archetype("fear", 8, signs="paper"),
        archetype("sadness", 0, signs="paper", activation=3.9),
        activation=4.0,
        angle=102.3,
    )
    low, high = guilty.ranges[19]
    # The paper rounds inside the example: -485 for -489.8 and 50 for 49.0, hence a tolerance of 2.5.
    assert (low + high) / 2.0 == pytest.approx(-209.0, abs=2.5)
    assert high - low == pytest.approx(199.0, abs=2.5)


def test_rule_3_drops_guiltys_lids_in_mpeg4_signs() -> None:
    guilty = between(archetype("fear", 8), archetype("sadness", 0), activation=4.0, angle=102.3)
    assert guilty.ranges.keys() == {3, 5, 31, 32, 33, 34, 35, 36}


def _made(ranges: dict[int, Range], angle: float, name: Archetype, activation: float = 4.0) -> Profile:
    return Profile(ranges=ranges, activation=activation, angle=angle, weights={name: 1.0}, category=name)


def test_rule_3_keeps_what_two_opposite_ranges_share() -> None:
    first = _made({31: (-20.0, 100.0)}, 70.0, Archetype.FEAR)
    second = _made({31: (-60.0, 10.0)}, 110.0, Archetype.SADNESS)
    for angle in (70.0, 85.0, 110.0):
        assert between(first, second, activation=4.0, angle=angle).ranges == {31: (-20.0, 10.0)}
    assert between(first, second, activation=2.0, angle=85.0).ranges == {31: (-10.0, 5.0)}


def test_rule_4_halves_what_one_alone_asks() -> None:
    first = _made({3: (400.0, 560.0)}, 70.0, Archetype.FEAR, activation=4.0)
    second = _made({33: (-20.0, -10.0)}, 110.0, Archetype.SADNESS, activation=2.0)
    for angle in (70.0, 100.0):
        made = between(first, second, activation=3.0, angle=angle)
        assert made.ranges == {3: (150.0, 210.0), 33: (-15.0, -7.5)}


def test_rule_2_by_hand() -> None:
    first = _made({31: (100.0, 200.0)}, 10.0, Archetype.FEAR)
    second = _made({31: (10.0, 20.0)}, 50.0, Archetype.SADNESS)
    made = between(first, second, activation=4.0, angle=20.0)  # a quarter of the way: nearer to the first
    assert made.ranges[31] == pytest.approx((77.5, 155.0))
    assert made.weights == pytest.approx({Archetype.FEAR: 0.75, Archetype.SADNESS: 0.25})


emotions = st.sampled_from(ARCHETYPES)
activations = st.floats(1.0, 7.0)
shares = st.floats(0.0, 1.0)


@st.composite
def pairs(draw: st.DrawFn) -> tuple[Profile, Profile]:
    """Any variants of two different archetypes."""
    one, other = draw(st.lists(emotions, min_size=2, max_size=2, unique=True))
    return archetype(one, draw(st.sampled_from(VARIANTS[one]))), archetype(
        other, draw(st.sampled_from(VARIANTS[other]))
    )


def _on_arc(first: Profile, second: Profile, share: float) -> float:
    """The angle at this share of the shorter arc, reached without the code under test."""
    gap = (second.angle - first.angle + 180.0) % 360.0 - 180.0
    return (first.angle + share * gap) % 360.0


@given(pairs(), activations, shares)
def test_swapping_the_neighbours_changes_nothing(
    both: tuple[Profile, Profile], activation: float, share: float
) -> None:
    first, second = both
    angle = _on_arc(first, second, share)
    one = between(first, second, activation=activation, angle=angle)
    other = between(second, first, activation=activation, angle=angle)
    _assert_close(one.ranges, other.ranges, 1e-9)
    assert one.weights == pytest.approx(other.weights)
    assert one.variants == other.variants


@given(pairs())
def test_an_archetypes_own_place_gives_it_back_on_shared_faps(both: tuple[Profile, Profile]) -> None:
    first, second = both
    own = between(first, second, activation=first.activation, angle=first.angle)
    for number in first.ranges.keys() & second.ranges.keys():
        same_side = sum(first.ranges[number]) * sum(second.ranges[number]) >= 0.0
        assert (number in own.ranges) == same_side
        if same_side:
            assert own.ranges[number] == pytest.approx(first.ranges[number], abs=1e-9)
    assert own.weights == pytest.approx(first.weights)


@given(pairs(), activations, shares, st.floats(1e-6, 1e-3))
def test_a_small_turn_makes_a_small_change(
    both: tuple[Profile, Profile], activation: float, share: float, step: float
) -> None:
    first, second = both
    near = min(share + step, 1.0)
    one = between(first, second, activation=activation, angle=_on_arc(first, second, share))
    other = between(first, second, activation=activation, angle=_on_arc(first, second, near))
    assert one.ranges.keys() == other.ranges.keys()
    steepest = max(abs(end) for profile in both for ends in profile.scaled(activation).ranges.values() for end in ends)
    for number, ends in one.ranges.items():
        assert other.ranges[number] == pytest.approx(ends, abs=2.0 * steepest * step + 1e-6)


@given(pairs(), activations, activations, shares)
def test_a_mixture_is_proportional_to_activation(
    both: tuple[Profile, Profile], one: float, other: float, share: float
) -> None:
    angle = _on_arc(*both, share)
    weak, strong = (between(*both, activation=activation, angle=angle) for activation in (one, other))
    _assert_close(weak.scaled(other).ranges, strong.ranges, 1e-8)


@given(pairs(), activations, shares)
def test_a_mixture_names_only_faps_of_either_and_keeps_their_sign(
    both: tuple[Profile, Profile], activation: float, share: float
) -> None:
    first, second = both
    made = between(first, second, activation=activation, angle=_on_arc(first, second, share))
    assert made.ranges.keys() <= first.ranges.keys() | second.ranges.keys()
    for number, (low, high) in made.ranges.items():
        sources = [profile.ranges[number] for profile in both if number in profile.ranges]
        lows, highs = zip(*sources, strict=True)
        assert high <= 0.0 or max(highs) > 0.0
        assert low >= 0.0 or min(lows) < 0.0
    assert sum(made.weights.values()) == pytest.approx(1.0)


def test_the_wheel_wraps_between_joy_and_fear() -> None:
    joy, fear = archetype("joy", 1), archetype("fear", 8)
    share = (360.0 + 39.7 - 323.4) / (360.0 + 70.3 - 323.4)
    patient = between(joy, fear, activation=3.3, angle=39.7)
    assert patient.weights == pytest.approx({Archetype.JOY: 1.0 - share, Archetype.FEAR: share})
    _assert_close(between(joy, fear, activation=3.3, angle=-320.3).ranges, patient.ranges, 1e-9)


def test_an_angle_off_the_shorter_arc_is_refused() -> None:
    with pytest.raises(ParameterError, match=r"between 70\.3 and 108\.5"):
        between(archetype("fear", 8), archetype("sadness", 0), activation=4.0, angle=200.0)


@pytest.mark.parametrize("activation", [0, 0.99, 7.01, 99, -4, math.nan, math.inf, "high", None])
def test_an_activation_off_the_scale_is_refused(activation: object) -> None:
    fear, sadness = archetype("fear", 8), archetype("sadness", 0)
    with pytest.raises(ParameterError, match=r"scale from 1 .* to 7"):
        between(fear, sadness, activation=activation, angle=100.0)  # type: ignore[arg-type]
    with pytest.raises(ParameterError, match=r"scale from 1 .* to 7"):
        fear.scaled(activation)  # type: ignore[arg-type]


def test_sign_conventions_do_not_mix() -> None:
    with pytest.raises(ParameterError, match="must be the same"):
        between(archetype("fear", 8), archetype("sadness", 0, signs="paper"), activation=4.0, angle=100.0)


def test_two_variants_of_one_emotion_mix_evenly() -> None:
    one, other = archetype("fear", 7), archetype("fear", 8)
    made = between(one, other, activation=4.9, angle=70.3)
    assert made.ranges[31] == (310.0, 390.0)
    assert made.category is Archetype.FEAR
    assert made.variant is None


@given(st.floats(0.0, 359.99), st.floats(0.0, 359.99), shares)
def test_position_on_an_arc(start: float, end: float, share: float) -> None:
    gap = (end - start + 180.0) % 360.0 - 180.0
    assume(1e-3 < abs(gap) < 179.999)
    angle = (start + share * gap) % 360.0
    assert position(angle, start, end) == pytest.approx(share, abs=1e-6)
    assert position(angle, end, start) == pytest.approx(1.0 - share, abs=1e-6)


def test_opposite_directions_have_two_arcs() -> None:
    assert position(90.0, 0.0, 180.0) == 0.5
    assert position(315.0, 0.0, 180.0) == 0.25
    assert position(315.0, 180.0, 0.0) == 0.75
    assert turn(350.0, 10.0) == 20.0


def test_neighbouring_archetypes_are_less_than_half_a_turn_apart() -> None:
    angles = sorted(BASE_WORDS[name].angle for name in ARCHETYPES)
    assert max(turn(a, b) for a, b in zip(angles, angles[1:] + angles[:1], strict=True)) < 180.0


def test_the_neutral_face_is_no_neighbour() -> None:
    silent = Profile(ranges={}, activation=1.0, angle=0.0, weights={})
    with pytest.raises(ParameterError, match="second profile"):
        between(archetype("joy", 1), silent, activation=3.0, angle=350.0)
    assert replace(silent, activation=2.0).neutral
