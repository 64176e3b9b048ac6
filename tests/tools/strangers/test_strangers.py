"""The small parts of `make strangers`: what a judge is shown, what counts as named, what the page says."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
import risorius.api as api
from faithful.heads import HEADS
from risorius.api import EyeballPlace
from strangers.chart import growth_chart
from strangers.judges import JUDGES, ask
from strangers.mini_xception import Network, convolve_each, crop, softmax, widened_square, windows
from strangers.page import MEAN, Findings, Sheet, page
from strangers.paint import (
    BEHIND,
    EYE_GREYS,
    IRIS,
    LIPS,
    brow_line,
    brow_places,
    exposed,
    iris_places,
    lip_depths,
    rounded,
)
from strangers.poses import Poses
from strangers.sittings import EMOTIONS, OWN, REST, Sitting, sittings, whole_evening
from strangers.verdicts import NO_FACE, confusion, grows, mean_growth, mean_said, named, share_named, tallies


def said(emotion: str, share: float) -> dict[str, float]:
    """One class with a share, the others with the rest of it."""
    classes = [*EMOTIONS, "neutral"]
    return {name: share if name == emotion else (1.0 - share) / 6.0 for name in classes}


# ---- what a judge is shown -------------------------------------------------------------------------------------


def test_shares_of_scores_of_any_size() -> None:
    assert softmax(np.array([1000.0, 1000.0 + np.log(3.0)])) == pytest.approx([0.25, 0.75])


def test_a_box_becomes_a_square_about_its_middle_and_wider() -> None:
    assert widened_square((20, 30, 40, 60), by=5) == (5, 25, 75, 95)


def test_beyond_the_edge_of_a_picture_lies_the_mean_of_its_lowest_rows() -> None:
    grey = np.array([[1.0, 2.0], [3.0, 5.0], [7.0, 9.0]])
    assert crop(grey, (-1, 1, 2, 4)).tolist() == [[6.0, 3.0, 5.0], [6.0, 7.0, 9.0], [6.0, 6.0, 6.0]]


def test_squares_that_stand_two_apart_are_padded_more_at_the_end() -> None:
    row = np.arange(4.0).reshape(1, 4, 1)
    found = windows(np.repeat(row, 3, axis=0), 3, 2, padding="same", fill=-1.0)
    assert found.shape == (2, 2, 3, 3, 1)
    assert found[0, 0, 1, :, 0].tolist() == [0.0, 1.0, 2.0]
    assert found[0, 1, 1, :, 0].tolist() == [2.0, 3.0, -1.0]


def test_each_channel_meets_its_own_kernel() -> None:
    values = np.stack([np.eye(3), np.ones((3, 3))], axis=-1)
    kernel = np.zeros((3, 3, 2))
    kernel[1, 1] = 2.0, 5.0
    assert np.allclose(convolve_each(values, kernel), values * [2.0, 5.0])


def layer(kind: str, name: str, *after: str, **settings: Any) -> dict[str, Any]:
    """A layer as a Keras file has it."""
    inbound = [[[source, 0, 0, {}] for source in after]] if after else []
    return {"class_name": kind, "config": {"name": name, **settings}, "inbound_nodes": inbound}


def test_a_network_is_read_layer_by_layer() -> None:
    layers = [
        layer("InputLayer", "in"),
        layer("Conv2D", "conv", "in", strides=[1, 1], padding="valid"),
        layer("BatchNormalization", "norm", "conv", epsilon=0.0),
        layer("GlobalAveragePooling2D", "mean", "norm"),
        layer("Activation", "shares", "mean", activation="softmax"),
    ]
    weights = {
        "conv": {"kernel": np.array([[[[1.0, 2.0]]]])},
        "norm": {
            "gamma": np.array([2.0, 1.0]),
            "beta": np.array([0.0, 1.0]),
            "moving_mean": np.array([1.0, 0.0]),
            "moving_variance": np.array([4.0, 1.0]),
        },
    }
    picture = np.array([[0.0, 1.0], [2.0, 3.0]])  # mean 1.5: (1.5 - 1) / 2 * 2, and 2 * 1.5 + 1
    assert Network(layers, weights)(picture) == pytest.approx(softmax(np.array([0.5, 4.0])))


def test_a_layer_of_an_unknown_kind_is_named() -> None:
    with pytest.raises(ValueError, match="odd: there is no reading for layers of the kind Dropout"):
        Network([layer("InputLayer", "in"), layer("Dropout", "odd", "in")], {})(np.zeros((2, 2)))


# ---- paint -----------------------------------------------------------------------------------------------------


def points() -> dict[str, Any]:
    """Brows that rise and fall, and round lips of a radius of two, below."""
    found = {"3.5": (3.0, 0.0, 0.0), "3.6": (-3.0, 0.0, 0.0)}
    for left, right, x, z in (("4.1", "4.2", 1.0, 2.0), ("4.3", "4.4", 3.0, 3.0), ("4.5", "4.6", 5.0, 2.0)):
        found |= {left: (x, 0.0, z), right: (-x, 0.0, z)}
    for number, name in enumerate(LIPS):
        angle = 2.0 * np.pi * number / len(LIPS)
        found[name] = (2.0 * np.cos(angle), 0.0, 2.0 * np.sin(angle) - 5.0)
    return {name: np.array(place) for name, place in found.items()}


def test_brows_run_along_their_points_on_both_sides() -> None:
    vertices = np.array([[1.0, 0.0, 2.0], [-3.0, 0.0, 3.0], [5.0, 0.0, 2.6]])
    assert brow_places(vertices, points()) == pytest.approx(np.array([[0.0, 0.0], [0.5, 0.0], [1.0, 0.1]]))


def test_a_brow_sets_out_straight_and_is_highest_at_its_middle() -> None:
    line = brow_line(np.array([12.0, 38.0, 58.0]), np.array([23.0, 26.5, 16.0]))
    rise = 3.5 / 26.0
    assert line(np.array([12.0, 38.0, 58.0])) == pytest.approx([23.0, 26.5, 16.0])
    assert line(np.array([11.0, 12.5])) == pytest.approx([23.0 - rise, 23.0 + 0.5 * rise], abs=0.05)
    along = np.linspace(10.0, 60.0, 101)
    assert line(along).max() == pytest.approx(26.5)


def test_level_and_ever_rising_brows_are_drawn_too() -> None:
    along = np.array([10.0, 20.0, 30.0])
    assert brow_line(along, np.full(3, 5.0))(np.array([8.0, 15.0, 40.0])) == pytest.approx(np.full(3, 5.0))
    assert brow_line(along, np.array([0.0, 2.0, 4.0]))(np.array([5.0, 25.0])) == pytest.approx([-1.0, 3.0])


def test_irises_look_ahead_wherever_a_coarse_ball_has_its_pupil() -> None:
    gaze = np.array([0.3, -0.9, -0.3]) / np.linalg.norm([0.3, -0.9, -0.3])
    ball = EyeballPlace(np.arange(4), np.array([30.0, -80.0, 36.0]), gaze, 0.3, 0.1)
    vertices = ball.centre + 12.0 * np.array([[0, -1, 0], [0.6, -0.8, 0], [0, -0.8, 0.6], [0, 1, 0]])
    found = iris_places(vertices, ball, np.array([0.0, -1.0, 0.0]), np.array([0.0, 0.0, 1.0]), 64.0)
    edge = 7.2 / (64.0 * IRIS)
    assert found == pytest.approx(np.array([[0, 0], [-edge, 0], [0, edge], [BEHIND, BEHIND]]))
    assert EYE_GREYS[-1][0] < edge  # there is white beside the iris


def test_the_red_is_what_lies_within_the_outline() -> None:
    vertices = np.array([[0.0, 0.0, -5.0], [0.0, 0.0, -4.0], [0.0, 0.0, -1.0]])
    assert lip_depths(vertices, points()) == pytest.approx([2.0, 1.0, -2.0], abs=0.05)


def test_a_rounded_outline_passes_through_its_points() -> None:
    outline = np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]])
    assert np.allclose(rounded(outline, 3)[::3], outline)


def test_a_stop_is_twice_the_light() -> None:
    half = 1.055 * 0.5 ** (1 / 2.4) - 0.055  # half of all light, as stored
    assert exposed(np.array([half, 0.0]), 1.0) == pytest.approx([1.0, 0.0], abs=1e-6)


# ---- what counts as named --------------------------------------------------------------------------------------


def test_the_mean_is_of_judges_that_found_a_face() -> None:
    assert mean_said([said("joy", 0.9), None]) == said("joy", 0.9)
    assert mean_said([None, None]) is None
    mean = mean_said([said("joy", 1.0), said("fear", 1.0)])
    assert mean is not None
    assert mean["joy"] == mean["fear"] == 0.5


def test_neutral_is_not_named() -> None:
    assert named(said("neutral", 0.5) | {"fear": 0.2}) == "fear"
    assert named(None) == NO_FACE


def test_tallies_and_confusion_tell_what_was_taken_for_what() -> None:
    judged = {
        Sitting("a", "fear"): said("fear", 0.8),
        Sitting("b", "fear"): said("surprise", 0.7),
        Sitting("c", "fear"): None,
    }
    tally = tallies(judged)["fear"]
    assert (tally.named, tally.of, tally.taken_for) == (1, 3, ("surprise", NO_FACE))
    assert tally.mean == pytest.approx((0.8 + 0.05 + 0.0) / 3)
    assert share_named(judged) == pytest.approx(1 / 3)
    assert confusion(judged)["fear"] == {"fear": 1, "surprise": 1, NO_FACE: 1}


@pytest.mark.parametrize(
    ("values", "yes"), [((0.1, 0.5, 0.49, 0.9), True), ((0.1, 0.5, 0.4, 0.9), False), ((0.5, 0.5), False)]
)
def test_growing_allows_no_real_fall(values: tuple[float, ...], yes: bool) -> None:
    assert grows(values) is yes


# ---- asking, and the page --------------------------------------------------------------------------------------


def test_what_was_said_is_not_asked_again(tmp_path: Path) -> None:
    kept = tmp_path / "said.json"
    kept.write_text(json.dumps({judge: {"a.png": said("joy", 0.9), "old.png": None} for judge in JUDGES}))
    assert ask([tmp_path / "a.png"], kept) == {judge: {"a.png": said("joy", 0.9)} for judge in JUDGES}


def test_every_head_is_pictured_at_rest_too() -> None:
    asked = sittings(["default", "ict"], ["joy"], [OWN, "7"], [0, 20], control=False)
    assert len(asked) == len(set(asked)) == 2 * 2 * (2 + 1)
    assert Sitting("ict", REST, REST, 20) in asked


def test_the_page_tells_each_emotion_and_leaves_out_what_was_not_pictured() -> None:
    judged = {Sitting(head, emotion): said(emotion, 0.9) for head in ("a", "b") for emotion in EMOTIONS}
    judged[Sitting("b", "anger")] = said("fear", 0.76)
    judged |= {Sitting("a", "joy", str(how)): said("joy", 0.1 * how) for how in range(1, 8)}
    judged[Sitting("a", "joy", OWN, 20)] = said("joy", 0.7)
    sheet = Sheet("A sheet", "pictures/a.jpg", "What is to be seen.")
    text = page(Findings(["a", "b"], {MEAN: judged}, [sheet], "pictures/growth.svg"))
    assert "**0.92 at its own" in text
    assert "| its own | anger | 1 of 2 | 0.47 | fear |" in text
    assert "| **anger** |  |  | 1 | 1 |  |  |" in text
    assert "| a | joy | 0.10 | 0.20 | 0.30 | 0.40 | 0.50 | 0.60 | 0.70 | yes |" in text
    assert "| joy | 0.10 | 0.20 | 0.30 | 0.40 | 0.50 | 0.60 | 0.70 | 1 of 1 |" in text
    assert "What is to be seen.\n\n![A sheet](pictures/a.jpg)" in text
    assert "![Growth](pictures/growth.svg)" in text
    assert "## The control" not in text
    assert "| 20° | 1.00 | 1 of 1 |" in text
    assert "### mean, own, from 20°: 1.00 named" in text


def test_a_chart_has_a_line_for_each_head_and_one_for_their_mean() -> None:
    heads = ("a", "b")
    judged = {Sitting(head, "joy", str(how)): said("joy", 0.1 * how) for head in heads for how in range(1, 8)}
    judged[Sitting("b", "joy", "7")] = said("joy", 0.9)
    assert mean_growth(judged, heads, "joy")[7] == pytest.approx(0.8)
    drawing = ElementTree.fromstring(growth_chart(judged, heads))
    lines = [each.attrib["points"].split() for each in drawing.iter("{http://www.w3.org/2000/svg}polyline")]
    joy = lines[:3]
    assert [len(line) for line in joy] == [7, 7, 7]
    heights = [float(line[-1].split(",")[1]) for line in joy]
    assert heights[0] > heights[2] > heights[1]  # a picture's rows count downwards
    assert growth_chart({Sitting("a", "joy"): said("joy", 0.9)}, heads) == ""


# ---- what is asked ---------------------------------------------------------------------------------------------


def test_the_whole_has_every_head_from_two_sides_its_growth_and_all_words() -> None:
    asked = whole_evening()
    assert len(asked) == len(set(asked))
    assert {Sitting(head, "fear", OWN, 20) for head in HEADS} <= set(asked)
    assert {Sitting(head, "joy", str(how)) for head in HEADS for how in range(1, 8)} <= set(asked)
    assert {Sitting("ict", word) for word in api.WORDS} <= set(asked)
    assert Sitting("makehuman", "worried") not in asked


def test_a_pose_is_worked_out_once_and_known_the_next_time(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("strangers.poses.sources_digest", lambda: "as today")
    worked_out: list[Sitting] = []

    def posed(face: Any, sitting: Sitting) -> Any:
        worked_out.append(sitting)
        return np.full((2, 3), float(sitting.how))

    monkeypatch.setattr("strangers.poses.posed", posed)
    face: Any = None
    front, side, stronger = Sitting("ict", "joy", "3"), Sitting("ict", "joy", "3", 20), Sitting("ict", "joy", "4")
    first = Poses(face, tmp_path)
    assert first.digest(front) == first.digest(side) != first.digest(stronger)
    assert len(worked_out) == 2
    second = Poses(face, tmp_path)
    assert second.digest(front) == first.digest(front)
    assert len(worked_out) == 2
    assert second.positions(side).tolist() == [[3.0] * 3] * 2
    monkeypatch.setattr("strangers.poses.sources_digest", lambda: "as tomorrow")
    second.digest(front)
    assert len(list(tmp_path.iterdir())) == 3
