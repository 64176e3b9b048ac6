"""Reading FAPs and features back: equations (8) to (11) and Table 3."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from risorius.errors import ParameterError
from risorius.mpeg4 import (
    ARCHETYPES,
    FAPS,
    FEATURE_POINTS,
    FEATURES,
    VARIANTS,
    Archetype,
    Rule,
    Unit,
    archetype,
    expression,
    faps_from_features,
    recognise,
    recognise_features,
    recognise_words,
)
from risorius.mpeg4.emotions.fuzzy import RELATIVE_WIDTH, membership

ALL = [(name, variant) for name in ARCHETYPES for variant in VARIANTS[name]]


@pytest.mark.parametrize(("name", "variant"), ALL)
def test_an_archetypes_own_midpoint_is_recognised(name: Archetype, variant: int) -> None:
    beliefs = recognise(archetype(name, variant).frame())
    assert beliefs.best is name
    assert beliefs[name] == pytest.approx(1.0)
    assert beliefs.profiles[name][variant] == pytest.approx(1.0)
    assert max(belief for other, belief in beliefs.items() if other is not name) < 0.8


@pytest.mark.parametrize(("name", "variant"), ALL)
def test_so_it_is_with_every_other_fap_at_rest(name: Archetype, variant: int) -> None:
    beliefs = recognise(np.nan_to_num(archetype(name, variant).frame()))
    assert beliefs.best is name
    assert max(belief for other, belief in beliefs.items() if other is not name) < 0.5


@pytest.mark.parametrize(("name", "variant"), ALL)
def test_draws_inside_the_ranges_are_recognised(name: Archetype, variant: int) -> None:
    rng = np.random.default_rng(variant)
    frames = [np.nan_to_num(archetype(name, variant).frame(rng)) for _ in range(40)]
    assert sum(recognise(frame).best is name for frame in frames) >= 38


@given(st.lists(st.floats(-2000.0, 2000.0) | st.just(float("nan")), min_size=68, max_size=68))
def test_beliefs_are_beliefs(values: list[float]) -> None:
    beliefs = recognise(values)
    assert tuple(beliefs) == ARCHETYPES
    for name, belief in beliefs.items():
        assert 0.0 <= belief <= 1.0
        assert belief == max(beliefs.profiles[name].values())  # equation (9)
        assert tuple(beliefs.profiles[name]) == VARIANTS[name]


def test_a_silent_frame_is_no_emotion_at_all() -> None:
    beliefs = recognise(np.full(68, np.nan))
    assert set(beliefs.values()) == {0.0}
    assert beliefs.best is None


def test_one_fap_is_no_evidence() -> None:
    frame = np.full(68, np.nan)
    frame[2] = 885.0
    assert recognise(frame).best is None


@given(st.floats(-500.0, 500.0), st.floats(1.0, 500.0), st.floats(0.1, 5.0))
def test_membership_is_one_at_the_centre_and_falls_on_both_sides(centre: float, width: float, way: float) -> None:
    at = membership(centre + width * way * np.array([-1.1, -1.0, 0.0, 1.0, 1.1]), np.full(5, centre), np.full(5, width))
    assert at[2] == 1.0
    assert at[0] < at[1] < 1.0
    assert at[4] < at[3] < 1.0
    np.testing.assert_allclose(at, at[::-1])
    assert at[3] == pytest.approx(2.0 ** -(way**2))


def test_equation_8_is_the_product() -> None:
    sadness = archetype("sadness", 0)
    frame = sadness.frame()
    frame[30] += RELATIVE_WIDTH * sum(sadness.ranges[31]) / 2.0  # one width off in two FAPs: half each
    frame[31] -= RELATIVE_WIDTH * sum(sadness.ranges[32]) / 2.0
    assert recognise(frame)[Archetype.SADNESS] == pytest.approx(0.25)
    frame[18] = np.nan  # and one unseen: half again
    assert recognise(frame)["sadness"] == pytest.approx(0.125)  # type: ignore[index]


@pytest.mark.parametrize(("name", "variant"), ALL)
def test_the_robust_rule_recognises_them_too_and_no_single_fap_kills(name: Archetype, variant: int) -> None:
    frame = archetype(name, variant).frame()
    assert recognise(frame, rule="robust").best is name
    asked = np.flatnonzero(~np.isnan(frame))
    frame[asked[0]] = -3.0 * frame[asked[0]] - 200.0
    assert recognise(frame, rule="robust")[name] > recognise(frame)[name]
    assert recognise(frame, rule="robust")[name] > 0.1


def test_the_robust_rule_is_the_geometric_mean_and_skips_what_is_not_seen() -> None:
    sadness = archetype("sadness", 0)
    frame = sadness.frame()
    frame[30] += RELATIVE_WIDTH * sum(sadness.ranges[31]) / 2.0
    count = int((~np.isnan(frame)).sum())
    assert recognise(frame, rule=Rule.ROBUST)[Archetype.SADNESS] == pytest.approx(0.5 ** (1.0 / count))
    frame[18] = np.nan
    assert recognise(frame, rule=Rule.ROBUST)[Archetype.SADNESS] == pytest.approx(0.5 ** (1.0 / (count - 1)))


def test_decisive_faps_tell_the_best_from_the_runner_up() -> None:
    beliefs = recognise(np.nan_to_num(archetype("surprise", 0).frame()))
    assert beliefs.best is Archetype.SURPRISE
    weights = list(beliefs.decisive.values())
    assert weights == sorted(weights, key=abs, reverse=True)
    first, second = sorted(beliefs.values(), reverse=True)[:2]
    assert sum(weights) == pytest.approx(np.log(first / second), rel=1e-6)


def test_words_are_recognised_among_words() -> None:
    words = ("guilty", "worried", "content", "terrified", "neutral")
    for word in words[:-1]:
        beliefs = recognise_words(np.nan_to_num(expression(word).frame()), words)
        assert next(iter(beliefs)) == word
        assert "neutral" not in beliefs


def test_an_unknown_rule_is_refused() -> None:
    with pytest.raises(ParameterError, match="paper, robust"):
        recognise(np.zeros(68), rule="loud")


@pytest.mark.parametrize("wrong", [np.zeros(67), np.zeros((2, 68)), np.full(68, np.inf)])
def test_a_frame_of_another_shape_is_refused(wrong: np.ndarray) -> None:
    with pytest.raises(ParameterError, match="68 numbers"):
        recognise(wrong)


def test_table_3_names_points_and_faps_of_the_standard() -> None:
    assert [feature.number for feature in FEATURES] == list(range(1, 16))
    for feature in FEATURES:
        assert {feature.point_a, feature.point_b} <= set(FEATURE_POINTS)
        for number in feature.shares:
            # The brow squeezes and lids differ in points, never in unit.
            assert FAPS[number].unit is feature.unit
    assert {feature.number for feature in FEATURES if feature.sign < 0} == {1, 2, 4, 15}
    assert FEATURES[3].unit is Unit.MNS


def test_features_are_symmetric() -> None:
    found = {frozenset((feature.point_a, feature.point_b)) for feature in FEATURES}
    for feature in FEATURES:
        mirrored = frozenset(FEATURE_POINTS[point].mirror or point for point in (feature.point_a, feature.point_b))
        assert mirrored in found


def test_a_feature_is_a_change_of_distance_in_fap_units() -> None:
    assert FEATURES[10].value(0.030, 0.020, 0.02 / 1024) == pytest.approx(512.0)
    assert FEATURES[0].value(0.040, 0.045, 0.065 / 1024) == pytest.approx(0.005 / 0.065 * 1024)


def test_features_become_faps_in_mpeg4_signs() -> None:
    features = np.zeros(15)
    features[[3, 10, 11, 13]] = -300.0, 800.0, 400.0, 200.0
    features[[0, 14]] = 60.0, 100.0
    frame = faps_from_features(features)
    assert frame[3 - 1] == 800.0
    assert frame[5 - 1] == -300.0  # the lip's distance from the nose grew: the lip went down
    assert frame[19 - 1] == frame[21 - 1] == -200.0  # the eye opened
    assert frame[6 - 1] == frame[7 - 1] == frame[53 - 1] == frame[54 - 1] == 100.0
    assert frame[37 - 1] == 55.0  # mean of 60 and half of 100
    assert frame[38 - 1] == 25.0
    assert np.isnan(frame[12 - 1])


def test_an_unknown_feature_leaves_the_other_measure() -> None:
    features = np.full(15, np.nan)
    features[14] = 100.0
    frame = faps_from_features(features)
    assert frame[37 - 1] == frame[38 - 1] == 50.0
    assert np.isnan(np.delete(frame, [36, 37])).all()


@pytest.mark.parametrize(
    ("word", "variant"), [("sadness", 0), ("anger", 0), ("joy", 0), ("disgust", 0), ("fear", 0), ("surprise", 0)]
)
def test_features_of_the_statistics_are_recognised(word: str, variant: int) -> None:
    faps = np.nan_to_num(archetype(word, variant).frame())
    features = np.zeros(15)
    for feature in FEATURES:
        mine = [faps[number - 1] / share for number, share in feature.shares.items()]
        features[feature.number - 1] = np.mean(mine)
    assert recognise_features(features).best == word


def test_features_do_not_blame_a_smile_for_its_unmeasured_corners() -> None:
    frame = np.nan_to_num(archetype("joy", 1).frame())
    features = np.array([np.mean([frame[n - 1] / share for n, share in f.shares.items()]) for f in FEATURES])
    features[11:13] = 0.0  # joy:1 closes lower lids as far as it opens upper ones: no change of distance
    frame[18:22] = 0.0
    seen_faps = np.where(np.isnan(faps_from_features(features)), np.nan, frame)
    assert (
        recognise_features(features).profiles[Archetype.JOY][1] > 4.0 * recognise(seen_faps).profiles[Archetype.JOY][1]
    )


def test_features_of_another_shape_are_refused() -> None:
    with pytest.raises(ParameterError, match="15 numbers"):
        recognise_features(np.zeros(14))


def test_a_word_is_recognised_as_its_category() -> None:
    for word in ("terrified", "delighted", "worried"):
        profile = expression(word)
        assert recognise(profile.frame()).best is profile.category
