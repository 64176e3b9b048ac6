"""Profiles: scaling, drawing inside the ranges, and what they refuse."""

from __future__ import annotations

import copy
import math
import pickle

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from risorius.errors import ParameterError
from risorius.mpeg4 import ARCHETYPES, FAPS, LIP_TWINS, PAIRS, VARIANTS, Profile, archetype, expression

profiles = st.sampled_from([(name, variant) for name in ARCHETYPES for variant in VARIANTS[name]]).map(
    lambda key: archetype(*key)
)
activations = st.floats(1.0, 7.0)
seeds = st.integers(0, 2**32 - 1)


@given(profiles, activations, activations)
def test_scaling_is_linear_and_keeps_signs(profile: Profile, one: float, other: float) -> None:
    scaled = profile.scaled(one)
    assert scaled.activation == one
    assert scaled.ranges.keys() == profile.ranges.keys()
    for number, (low, high) in profile.ranges.items():
        assert scaled.ranges[number] == pytest.approx((low * one / profile.activation, high * one / profile.activation))
        assert np.sign(scaled.ranges[number]) == pytest.approx(np.sign((low, high)))
        assert scaled.scaled(other).ranges[number] == pytest.approx(profile.scaled(other).ranges[number])
    assert (scaled.category, scaled.angle, scaled.variant) == (profile.category, profile.angle, profile.variant)


@given(profiles)
def test_the_midpoint_frame(profile: Profile) -> None:
    frame = profile.frame()
    assert frame.shape == (68,)
    assert frame.dtype == np.float64
    for number in FAPS:
        if number in profile.ranges:
            assert frame[number - 1] == pytest.approx(sum(profile.ranges[number]) / 2.0)
        else:
            assert math.isnan(frame[number - 1])


@given(profiles, seeds, st.floats(0.0, 1.0))
def test_a_draw_lies_inside_the_ranges_and_repeats(profile: Profile, seed: int, asymmetry: float) -> None:
    frame = profile.frame(seed, asymmetry=asymmetry)
    np.testing.assert_array_equal(frame, profile.frame(np.random.default_rng(seed), asymmetry=asymmetry))
    for number, (low, high) in profile.ranges.items():
        assert low - 1e-9 <= frame[number - 1] <= high + 1e-9
    assert np.isnan(frame).sum() == 68 - len(profile.ranges)


def _places(profile: Profile, frame: np.ndarray) -> dict[int, float]:
    """Relative place of each FAP in its range."""
    return {
        number: (frame[number - 1] - low) / (high - low) for number, (low, high) in profile.ranges.items() if high > low
    }


@given(profiles, seeds)
def test_left_and_right_and_both_lip_contours_are_drawn_together(profile: Profile, seed: int) -> None:
    places = _places(profile, profile.frame(seed))
    for one, other in PAIRS + LIP_TWINS:
        if one in places and other in places:
            assert places[one] == pytest.approx(places[other])


def test_asymmetry_draws_sides_apart() -> None:
    joy = archetype("joy", 1)
    gaps = {}
    for asymmetry in (0.0, 0.3, 1.0):
        draws = [_places(joy, joy.frame(seed, asymmetry=asymmetry)) for seed in range(300)]
        gaps[asymmetry] = np.mean([abs(places[12] - places[13]) for places in draws])
        assert all(places[7] == pytest.approx(places[54]) for places in draws)
    assert gaps[0.0] == pytest.approx(0.0, abs=1e-12)
    assert gaps[1.0] == pytest.approx(1.0 / 3.0, abs=0.05)  # mean distance of two independent uniform draws
    assert gaps[0.3] == pytest.approx(0.1, abs=0.02)


def test_draws_fill_the_range_evenly() -> None:
    joy = archetype("joy", 1)
    rng = np.random.default_rng(7)
    places = np.array([_places(joy, joy.frame(rng))[12] for _ in range(2000)])
    assert places.min() < 0.01
    assert places.max() > 0.99
    assert places.mean() == pytest.approx(0.5, abs=0.03)
    assert places.std() == pytest.approx(1.0 / math.sqrt(12.0), abs=0.02)


def test_one_seed_gives_related_words_related_faces() -> None:
    afraid, terrified = expression("afraid").frame(5), expression("terrified").frame(5)
    np.testing.assert_allclose(terrified, afraid * 6.3 / 4.9)


def test_a_profile_survives_copying_and_pickling() -> None:
    profile = expression("guilty")
    assert copy.deepcopy(profile) == profile
    assert pickle.loads(pickle.dumps(profile)) == profile


def test_archetypes_do_not_share_their_ranges() -> None:
    spoilt = archetype("fear", 8)
    spoilt.ranges[3] = (0.0, 0.0)
    assert archetype("fear", 8).ranges[3] == (400.0, 560.0)


@pytest.mark.parametrize("number", [0, 1, 2, 69])
def test_a_fap_without_a_displacement_is_refused(number: int) -> None:
    with pytest.raises(ParameterError, match=r"3\.\.68"):
        Profile(ranges={number: (0.0, 1.0)}, activation=3.0, angle=0.0, weights={})


@pytest.mark.parametrize("ends", [(2.0, 1.0), (math.nan, 1.0), (0.0, math.inf)])
def test_a_range_the_wrong_way_round_is_refused(ends: tuple[float, float]) -> None:
    with pytest.raises(ParameterError, match="range of F31"):
        Profile(ranges={31: ends}, activation=3.0, angle=0.0, weights={"joy": 1.0})  # type: ignore[dict-item]


@pytest.mark.parametrize("weights", [{"joy": 0.5}, {"joy": 1.5, "fear": -0.5}, {}])
def test_weights_that_are_no_shares_are_refused(weights: dict[str, float]) -> None:
    with pytest.raises(ParameterError, match="weights"):
        Profile(ranges={31: (0.0, 1.0)}, activation=3.0, angle=0.0, weights=weights)  # type: ignore[arg-type]


def test_asymmetry_outside_is_refused() -> None:
    with pytest.raises(ParameterError, match="asymmetry"):
        archetype("joy", 1).frame(1, asymmetry=1.5)
