"""What detectors see in rendered faces: the pure parts."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from detectors.figures import both_sides, dead, faps_follow, film_follows, follows, named, right, rise_of, risen
from detectors.page import Findings, page
from detectors.points68 import EYES, MEASURES, measure_follows
from detectors.stills import (
    EMOTIONS,
    HEADS,
    LIGHTS,
    REST,
    STRENGTHS,
    TRACED,
    YAWS,
    Action,
    Still,
    actions,
    few,
    stills,
    unit_faps,
)

SMILE = Action("AU12", "lip corner puller", "mouthSmile", (12, 13))


def test_a_still_is_known_by_its_file_and_compared_with_rest_seen_alike() -> None:
    still = Still("ict", "AU12", 33, 20, "front")
    assert still.file == "ict-AU12-33-20-front.png"
    assert still.at_rest == Still("ict", REST, 100, 20, "front")
    every = stills()
    assert len({each.file for each in every}) == len(every)
    assert {each.at_rest for each in every} <= set(every)
    assert {(each.yaw, each.light) for each in every} == {
        *((yaw, LIGHTS[0]) for yaw in YAWS),
        *((0, light) for light in (LIGHTS[1], *TRACED)),
    }
    assert {each.shows for each in every} == {REST, *EMOTIONS, *actions()}


def test_units_move_the_faps_that_tell_of_them_on_both_sides() -> None:
    for unit, action in actions().items():
        full, half = unit_faps(unit, 1.0), unit_faps(unit, 0.5)
        told = full[[number - 1 for number in action.faps]]
        assert np.isfinite(told).all(), unit
        assert (np.abs(told) > 5.0).all(), unit
        np.testing.assert_allclose(half, 0.5 * full)
    smile = unit_faps("AU12", 1.0)
    assert smile[11] == pytest.approx(smile[12])
    assert smile[11] > 300.0


def scores_of(full: float, other: float = 0.0) -> dict[Still, dict[str, float]]:
    """Scores of a smile that rises straight with strength, over .05 at rest."""
    found: dict[Still, dict[str, float]] = {}
    for still in stills():
        if still.shows in (REST, "AU12"):
            share = 0.0 if still.shows == REST else still.strength / 100.0
            found[still] = {"mouthSmile": 0.05 + full * share, "jawOpen": other * share}
    return found


def test_a_rise_is_over_rest_and_seen_where_most_heads_show_it() -> None:
    scores = scores_of(0.24)
    assert risen(scores, Still("ict", "AU12"))["mouthSmile"] == pytest.approx(0.24)
    rise = rise_of(scores, SMILE, strengths=STRENGTHS, yaws=YAWS, lights=(LIGHTS[1], *TRACED))
    assert rise.by_strength[33] == pytest.approx(0.33 * 0.24)
    assert rise.seen_from == 67
    assert rise.heads == rise.first == len(HEADS)
    assert set(rise.by_light) == {LIGHTS[1], *TRACED}
    assert all(rise.by_yaw[40] == pytest.approx(light) for light in rise.by_light.values())
    assert rise.turned_by == ()
    dim = {still: {**each, "mouthSmile": 0.05} if still.light == TRACED[0] else each for still, each in scores.items()}
    turned = rise_of(dim, SMILE, strengths=STRENGTHS, yaws=YAWS, lights=(LIGHTS[1], *TRACED))
    assert turned.turned_by == (TRACED[0],)
    none = rise_of(scores_of(0.01, 0.5), SMILE, strengths=STRENGTHS, yaws=YAWS, lights=LIGHTS[1:])
    assert none.seen_from is None
    assert (none.heads, none.first) == (0, 0)
    assert none.instead == ("jawOpen", pytest.approx(0.5))


def test_a_face_that_is_not_found_is_left_out() -> None:
    scores = scores_of(0.5)
    for yaw in (20, 40):
        for head in HEADS:
            del scores[Still(head, "AU12", yaw=yaw)]
    assert risen(scores, Still("ict", "AU12", yaw=40)) == {}
    rise = rise_of(scores, SMILE, strengths=STRENGTHS, yaws=YAWS, lights=LIGHTS[1:])
    assert np.isnan(rise.by_yaw[40])
    assert rise.by_yaw[0] == pytest.approx(0.5)


def test_left_and_right_are_one_and_gaze_is_none() -> None:
    shapes = {"mouthSmileLeft": 0.2, "mouthSmileRight": 0.4, "jawOpen": 0.1, "eyeLookUpLeft": 1.0, "_neutral": 1.0}
    assert both_sides(shapes) == pytest.approx({"mouthSmile": 0.3, "jawOpen": 0.1})


def test_what_was_read_follows_what_is_true() -> None:
    true = np.array([0.0, 100.0, 200.0, np.nan, 50.0])
    found = follows(0.5 * true, true)
    assert (found.correlation, found.slope, found.count) == (pytest.approx(1.0), pytest.approx(0.5), 4)
    assert np.isnan(follows(np.zeros(5), true).correlation)
    still = Still("ict", "AU12")
    frames = {replace(still, strength=s): np.full(68, float(s)) for s in STRENGTHS}
    assert faps_follow(frames, frames, (12, 13), frames).slope == pytest.approx(1.0)
    assert faps_follow({}, frames, (12,), frames).count == 0


def test_a_film_s_shape_follows_its_faps() -> None:
    truth = np.zeros((5, 68))
    truth[:, [11, 12]] = np.array([0.0, 100.0, 200.0, 100.0, 0.0])[:, None]
    shapes = [{"mouthSmileLeft": 0.001 * value, "mouthSmileRight": 0.001 * value} for value in truth[:, 11]]
    assert film_follows(shapes, truth, SMILE) == pytest.approx(1.0)
    assert film_follows([*shapes[:4], {}], truth, SMILE) == pytest.approx(1.0)
    assert np.isnan(film_follows([{}] * 5, truth, SMILE))
    assert np.isnan(film_follows(shapes, 0.1 * truth, SMILE))  # it hardly moves
    assert np.isnan(film_follows(shapes, -truth, SMILE))  # corners that fall are no smile


def test_a_shape_that_never_leaves_nothing_is_dead() -> None:
    assert dead(scores_of(0.24)) == ["jawOpen"]
    assert dead(scores_of(0.24, 0.5)) == []


def test_a_judge_names_the_likeliest_and_rest_is_neutral() -> None:
    assert named({"joy": 0.2, "neutral": 0.7}) == "neutral"
    assert named(None) == "no face"
    rest, joy = Still("ict", REST), Still("ict", "joy")
    assert right({rest: "neutral", joy: "fear"}, [rest, joy, Still("ict", "anger")]) == (1, 2)


def test_the_page_says_what_was_seen() -> None:
    scores = scores_of(0.24)
    frames = {still: np.full(68, 10.0 * index) for index, still in enumerate(scores)}
    verdicts = {Still(head, emotion, yaw=yaw): "joy" for head in HEADS for emotion in EMOTIONS for yaw in YAWS}
    text = page(
        Findings(scores, frames, frames, {"face-api": verdicts}, len(stills()), 3, {"default, 0°": {"AU12": 0.9}})
    )
    assert "| AU12 lip corner puller | mouthSmile | 0.08 | **0.16** | **0.24** |" in text
    assert "| face-api | 3 of 18 | 3 of 18 | 3 of 18 |" in text
    assert f"{len(stills())} pictures" in text
    assert "| AU12 mouthSmile | 0.90 |" in text
    assert "nan" not in text


def face_of(**moved: tuple[float, float]) -> np.ndarray:
    """(68, 2) landmarks a hundred pixels between the eyes; `moved`: p30=(dx, dy)."""
    points = np.zeros((68, 2))
    points[36:42], points[42:48] = (100.0, 100.0), (200.0, 100.0)
    for name, by in moved.items():
        points[int(name[1:])] += by
    return points


def test_measures_follow_the_faps_that_they_tell_of() -> None:
    """Each grows with its FAPs, and is told from the same head at rest, seen alike."""
    width = next(measure for measure in MEASURES if measure.across)
    brows = MEASURES[0]
    assert brows.below == EYES
    raised = face_of(p21=(0.0, -5.0), p22=(0.0, -5.0))
    assert brows.of(raised) - brows.of(face_of()) == pytest.approx(5.0)
    assert width.of(face_of(p54=(3.0, 4.0))) == pytest.approx(5.0)
    rest, stills_of = Still("ict", REST), [Still("ict", "AU1", strength) for strength in STRENGTHS]
    found = {rest: face_of()} | {
        still: face_of(p21=(0.0, -0.1 * still.strength), p22=(0.0, -0.1 * still.strength)) for still in stills_of
    }
    true = {still: np.full(68, 2.0 * still.strength) for still in stills_of} | {rest: np.zeros(68)}
    followed = measure_follows(brows, found, true, [rest, *stills_of])
    assert (followed.correlation, followed.count) == (pytest.approx(1.0), 3)
    assert measure_follows(brows, {**found, rest: None}, true, stills_of).count == 0
    assert {number for measure in MEASURES for number in measure.faps} <= set(range(3, 69))


def test_a_few_pictures_are_some_of_all_and_make_a_page() -> None:
    assert set(few()) < set(stills())
    assert {still.at_rest for still in few()} <= set(few())
    scores = {still: each for still, each in scores_of(0.24).items() if still in few()}
    true = {still: np.full(68, float(still.strength)) for still in few()}
    points = {"dlib": {still: face_of(p54=(0.1 * still.strength, 0.0)) for still in few()}}
    text = page(Findings(scores, {}, true, {}, len(few()), 0, points=points))
    assert "| width of the mouth | 6, 7 | 1.00 |" in text
    assert "Films" not in text
