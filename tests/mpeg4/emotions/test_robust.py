"""The robust rule: what a profile does not know counts against it, rest is a verdict, doubt is carried."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pytest
import risorius.api as api
from risorius.errors import ParameterError
from risorius.mpeg4 import ARCHETYPES, VARIANTS, Archetype, archetype
from risorius.mpeg4.emotions.beside import beside, known_classes
from risorius.mpeg4.emotions.places import TOGETHER
from risorius.mpeg4.emotions.robust import ASKED_MOST, UNASKED_MOST, archetype_rule

ALL = [(name, variant) for name in ARCHETYPES for variant in VARIANTS[name]]

#: FAP -> FAP units: a broad smile with shut lids as a camera reads it against somebody else's neutral face.
SMILE = {
    4: -370, 5: -200, 6: 115, 7: 135, 8: -400, 9: -420, 12: 430, 13: 450, 18: 90, 19: 100, 20: 100, 21: 210, 22: 190,
    31: 30, 32: 45, 33: 85, 34: 90, 41: 55, 42: 60, 53: 140, 54: 160,
}  # fmt: skip


#: FAP -> FAP units at half strength, medians of seven heads: scanned AU 6+12, and 1+4+15.
WEAK_SMILE = {
    3: -60, 4: -92, 5: 82, 6: 76, 7: 76, 8: -136, 9: -136, 10: 124, 11: 124, 12: 246, 13: 246, 16: -29, 18: 99, 19: 34,
    20: 34, 21: 126, 22: 126, 31: 0, 32: 0, 33: -12, 34: -12, 35: -11, 36: -11, 37: 0, 38: 0, 41: 103, 42: 103, 51: -85,
    52: 90, 53: 78, 54: 78, 55: -110, 56: -110, 57: 125, 58: 125, 59: 268, 60: 268,
}  # fmt: skip
WEAK_SADNESS = {
    3: -22, 4: 18, 5: -12, 6: 18, 7: 18, 8: 33, 9: 33, 10: -24, 11: -24, 12: -94, 13: -94, 16: 0, 18: 24, 19: 0, 20: 0,
    21: 0, 22: 0, 31: 38, 32: 38, 33: -10, 34: -10, 35: 0, 36: 0, 37: 14, 38: 14, 41: 0, 42: 0, 51: 26, 52: 0, 53: 19,
    54: 19, 55: 37, 56: 37, 57: -13, 58: -13, 59: -111, 60: -111,
}  # fmt: skip

#: FAP -> FAP units: scanned AU 4, 7, 17 and 24 on the head that was scanned, lips pressed and chin raised.
SHUT_ANGER = {
    3: -269, 4: 31, 5: 191, 8: -21, 9: -21, 10: 197, 11: 197, 12: 109, 13: 109, 18: 408, 19: 26, 20: 26, 21: 158,
    22: 158, 31: -47, 32: -47, 33: -80, 34: -80, 35: -20, 36: -20, 37: 33, 38: 33, 41: 45, 42: 45, 51: 67, 52: 258,
    57: 253, 58: 253, 59: 90, 60: 90,
}  # fmt: skip


def frame_of(values: Mapping[int, float]) -> np.ndarray:
    """(68,) FAPs, the others unknown."""
    frame = np.full(68, np.nan)
    for number, value in values.items():
        frame[number - 1] = value
    return frame


def own_faps_alone(frame: np.ndarray, name: str) -> float:
    """The geometric mean over a profile's own FAPs: what the rule was without the FAPs that it does not know."""
    profile = archetype(Archetype(name), 0)
    return api.recognise(np.where(np.isnan(profile.frame()), np.nan, frame), rule="robust")[Archetype(name)]


def test_a_broad_smile_is_no_sadness() -> None:
    frame = frame_of(SMILE)
    assert own_faps_alone(frame, "sadness") > own_faps_alone(frame, "joy")  # by their own FAPs it is
    beliefs = api.recognise(frame, rule="robust")
    assert beliefs.best == "joy"
    assert beliefs[Archetype.JOY] > beliefs[Archetype.SADNESS] + 0.1
    assert set(list(beliefs.decisive)[:3]) == {4, 8, 9}  # the upper lip, of which sadness knows nothing


@pytest.mark.parametrize(("seen", "word"), [(WEAK_SMILE, "joy"), (WEAK_SADNESS, "sadness")])
@pytest.mark.parametrize("share", [1.0, 1.25, 1.5, 2.0])
def test_a_weak_expression_is_what_the_strong_one_is(seen: Mapping[int, float], word: str, share: float) -> None:
    assert api.recognise(share * frame_of(seen), rule="robust").best == word


def test_what_a_profile_does_not_know_counts_by_how_much_the_face_moves() -> None:
    frame = np.nan_to_num(archetype("sadness", 0).frame())
    lifted = frame.copy()
    lifted[[11, 12]] = 150.0
    wide = lifted.copy()
    wide[[2, 4]] = 900.0, -700.0  # with a wide open mouth the same lifted corners say less
    row = list(known_classes()).index((Archetype.SADNESS, 0))
    against = [archetype_rule().judge(values[None]).against[0, row, 11] for values in (lifted, wide)]
    assert against[0] > 1.5 * against[1]


def test_anger_with_a_shut_mouth_is_anger_and_a_lifted_lip_is_disgust() -> None:
    shut = frame_of(SHUT_ANGER)
    beliefs = api.recognise(shut, rule="robust")
    assert beliefs.best == "anger"
    assert beliefs.best_profile is not None
    assert beliefs.best_profile.variants == {"anger": 5}
    assert not beliefs.best_profile.ranges.keys() & {12, 13}
    lifted = shut.copy()
    lifted[[3, 7, 8, 50, 54, 55]] = -300.0  # the same with the upper lip drawn up, inner and outer contour
    assert api.recognise(lifted, rule="robust").best == "disgust"


def test_a_profile_that_lifts_a_lip_lifts_its_outer_contour() -> None:
    frame = np.nan_to_num(archetype("disgust", 0).frame())
    rolled, drawn = frame.copy(), frame.copy()
    drawn[51 - 1] = frame[4 - 1]
    rolled[51 - 1] = 60.0
    beliefs = [api.recognise(values, rule="robust")[Archetype.DISGUST] for values in (drawn, rolled)]
    assert beliefs[0] > beliefs[1]


@pytest.mark.parametrize("number", [12, 31, 19, 61])
def test_one_fap_alone_is_no_expression(number: int) -> None:
    frame = np.zeros(68)
    frame[number - 1] = 150.0
    assert api.recognise(frame, rule="robust").best == api.NEUTRAL


@pytest.mark.parametrize("number", [12, 3, 5])
def test_motion_that_a_profile_does_not_know_counts_against_it_by_how_sure_it_is(number: int) -> None:
    frame = np.nan_to_num(archetype("sadness", 0).frame())
    moved = frame.copy()
    moved[number - 1] += 400.0
    sure, unsure = np.ones(68), np.ones(68)
    unsure[number - 1] = 0.2
    still, certain, guessed = (
        api.recognise(values, rule="robust", confidence=weights)[Archetype.SADNESS]
        for values, weights in ((frame, sure), (moved, sure), (moved, unsure))
    )
    assert certain < guessed < still
    moved[number - 1] = np.nan
    assert api.recognise(moved, rule="robust")[Archetype.SADNESS] == pytest.approx(still, abs=0.05)


def test_profiles_beside_the_table_go_on_where_it_ends() -> None:
    assert [variant for name, variant in beside() if name == "anger"] == [VARIANTS[Archetype.ANGER][-1] + 1]
    assert set(known_classes()) == {*ALL, *beside()}
    with pytest.raises(ParameterError, match="variant of anger"):
        api.archetype("anger", 5)


def test_a_profile_that_asks_for_one_fap_of_a_lip_knows_the_others() -> None:
    frame = np.nan_to_num(archetype("joy", 0).frame())
    lips = frame.copy()
    lips[[7, 8]] = frame[3]  # the sides of the upper lip rise as its middle does
    before, after = (api.recognise(values, rule="robust").profiles[Archetype.JOY][0] for values in (frame, lips))
    assert after == pytest.approx(before)
    numbers = [number for together in TOGETHER for number in together]
    assert len(numbers) == len(set(numbers))


def test_no_fap_decides_alone() -> None:
    frame = np.nan_to_num(archetype("sadness", 0).frame())
    frame[12 - 1] = 1e5
    judged = archetype_rule().judge(frame[None])
    count = (archetype_rule().asked | archetype_rule().unasked).sum(axis=1)
    most = np.where(archetype_rule().asked, ASKED_MOST, UNASKED_MOST) / count[:, None]
    assert (judged.against[0] <= most + 1e-9).all()
    assert api.recognise(frame, rule="robust")[Archetype.SADNESS] > 0.5


def test_a_face_at_rest_is_neutral() -> None:
    beliefs = api.recognise(np.zeros(68), rule="robust")
    assert beliefs.best == api.NEUTRAL
    assert beliefs.neutral == 1.0
    assert set(beliefs.values()) == {0.0}
    assert beliefs.best_profile is None
    for trembling in np.random.default_rng(3).normal(scale=15.0, size=(50, 68)):
        assert api.recognise(trembling, rule="robust").best == api.NEUTRAL


def test_what_was_not_seen_is_not_neutral() -> None:
    beliefs = api.recognise(np.full(68, np.nan), rule="robust")
    assert beliefs.neutral is None
    assert beliefs.best is None


@pytest.mark.parametrize(("name", "variant"), ALL)
def test_the_paper_s_rule_knows_no_neutral_face(name: Archetype, variant: int) -> None:
    assert api.recognise(archetype(name, variant).frame()).neutral is None
    assert api.recognise(np.zeros(68)).best is not None


@pytest.mark.parametrize(("name", "variant"), ALL)
def test_an_expression_that_grows_is_neutral_and_then_itself(name: Archetype, variant: int) -> None:
    apex = np.nan_to_num(archetype(name, variant).frame())
    shares = np.linspace(0.0, 1.0, 21)
    said = [api.recognise(share * apex, rule="robust") for share in shares]
    assert {beliefs.best for beliefs in said} == {api.NEUTRAL, name}
    first = next(index for index, beliefs in enumerate(said) if beliefs.best == name)
    assert 0.1 <= shares[first] <= 0.55
    assert all(beliefs.best == name for beliefs in said[first:])
    rests = [beliefs.neutral for beliefs in said]
    assert rests == sorted(rests, reverse=True)


def test_a_doubtful_neutral_face_explains_what_moves_with_it() -> None:
    mouth = np.zeros((68, 1))
    higher = {4: -90, 5: 110, 8: -90, 9: -90, 10: 110, 11: 110, 12: 100, 13: 100, 18: 140}
    mouth[:, 0] = np.nan_to_num(frame_of(higher))
    frame = 2.0 * mouth[:, 0]  # the mouth stands higher than in the neutral face: two standard deviations
    sure, doubtful = api.recognise(frame, rule="robust"), api.recognise(frame, rule="robust", doubt=mouth)
    assert sure.best != api.NEUTRAL
    assert doubtful.best == api.NEUTRAL
    assert doubtful.neutral is not None
    assert 0.5 < doubtful.neutral < 1.0  # it has its price
    smile = frame_of(SMILE)
    assert api.recognise(smile, rule="robust", doubt=mouth).best == "joy"


def test_no_doubt_is_as_no_doubt_at_all() -> None:
    frame = frame_of(SMILE)
    for doubt in (np.zeros((68, 0)), np.zeros((68, 2))):
        assert dict(api.recognise(frame, rule="robust", doubt=doubt)) == pytest.approx(
            dict(api.recognise(frame, rule="robust"))
        )
    assert dict(api.recognise(frame, rule="robust", confidence=np.full(68, 0.5))) == pytest.approx(
        dict(api.recognise(frame, rule="robust"))
    )


@pytest.mark.parametrize(
    ("weights", "match"),
    [
        ({"confidence": np.ones(67)}, "confidence"),
        ({"confidence": np.full(68, 1.5)}, "confidence"),
        ({"doubt": np.ones(68)}, "doubt"),
        ({"doubt": np.full((68, 1), np.nan)}, "doubt"),
    ],
)
def test_weights_of_another_shape_are_refused(weights: dict[str, np.ndarray], match: str) -> None:
    with pytest.raises(ParameterError, match=match):
        api.recognise(np.zeros(68), rule="robust", **weights)


def test_the_paper_s_rule_refuses_weights() -> None:
    with pytest.raises(ParameterError, match="robust"):
        api.recognise(np.zeros(68), confidence=np.ones(68))
    with pytest.raises(ParameterError, match="robust"):
        api.recognise_over_time(np.zeros((2, 68)), doubt=np.ones((68, 1)))
