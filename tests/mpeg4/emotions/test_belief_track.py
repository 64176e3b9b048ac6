"""Beliefs over time: frame by frame what recognition says, how strong it is, and the table of it."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest
import risorius.api as api
from risorius.errors import FormatError, ParameterError


@pytest.fixture
def rising() -> np.ndarray:
    """(5, 68) surprise from none to all of it."""
    profile = api.archetype("surprise", 0)
    return np.linspace(0.0, 1.0, 5)[:, None] * profile.frame()


def test_strength_is_the_share_of_the_profile(rising: np.ndarray) -> None:
    profile = api.archetype("surprise", 0)
    strengths = [api.shown_strength(frame, profile) for frame in rising]
    np.testing.assert_allclose(strengths, np.linspace(0.0, 1.0, 5), atol=1e-12)
    assert api.shown_strength(-rising[-1], profile) == 0.0
    unseen = np.where(np.arange(68) < 30, rising[2], np.nan)
    assert api.shown_strength(unseen, profile) == pytest.approx(0.5)
    assert api.shown_strength(np.full(68, np.nan), profile) == 0.0


@pytest.mark.parametrize("rule", ["paper", "robust"])
def test_each_frame_is_recognised_as_it_is_alone(rising: np.ndarray, rule: str) -> None:
    told: list[api.Progress] = []
    track = api.recognise_over_time(rising, rule=rule, fps=30.0, first_frame=7, progress=told.append)
    for frame, beliefs in zip(rising, track.beliefs, strict=True):
        np.testing.assert_array_equal(beliefs, [api.recognise(frame, rule=rule)[name] for name in api.ARCHETYPES])
    assert told[-1] == (1.0, "5 of 5 frames")
    assert track.best[-1] == "surprise"
    np.testing.assert_array_equal(track.numbers, [7, 8, 9, 10, 11])
    assert track.strengths[-1] > track.strengths[2] > 0.3


def test_the_best_profile_is_the_one_whose_belief_is_the_emotions_own(rising: np.ndarray) -> None:
    beliefs = api.recognise(rising[-1])
    assert beliefs.best_profile is not None
    assert beliefs.best_profile.ranges == api.archetype("surprise", 0).ranges
    assert api.recognise(np.full(68, np.nan)).best_profile is None


def test_the_table_has_what_was_measured_and_leaves_unknown_cells_empty(rising: np.ndarray, tmp_path: Path) -> None:
    rising[1, 3 - 1] = np.nan
    track = api.recognise_over_time(rising, fps=25.0, first_frame=1)
    api.write_belief_csv(tmp_path / "t.csv", track)
    with (tmp_path / "t.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert [row["frame"] for row in rows] == ["1", "2", "3", "4", "5"]
    assert float(rows[2]["seconds"]) == pytest.approx(0.08)
    assert float(rows[4]["surprise"]) == pytest.approx(track.beliefs[4, 5], rel=1e-5)
    assert rows[1]["F3_open_jaw"] == ""
    assert float(rows[4]["F3_open_jaw"]) == pytest.approx(rising[4, 2], abs=0.01)
    assert rows[4]["best"] == "surprise"
    assert "F16_push_b_lip" not in rows[0]


def test_frames_of_another_shape_and_unwritable_tables_are_refused(rising: np.ndarray, tmp_path: Path) -> None:
    with pytest.raises(ParameterError, match="frames"):
        api.recognise_over_time(rising[0])
    with pytest.raises(FormatError, match=r"t\.csv"):
        api.write_belief_csv(tmp_path / "none" / "t.csv", api.recognise_over_time(rising))


def clip(word: str, fps: float = 25.0) -> np.ndarray:
    """(T, 68) a word that comes from rest and goes back to it."""
    return np.nan_to_num(api.envelope(api.expression(word), onset=0.4, apex=0.4, offset=0.4, fps=fps))


@pytest.mark.parametrize("fps", [10.0, 25.0, 120.0])
@pytest.mark.parametrize("word", api.ARCHETYPES)
def test_a_clip_is_neutral_then_its_emotion_then_neutral(word: str, fps: float) -> None:
    track = api.recognise_over_time(clip(word, fps), rule="robust", fps=fps)
    runs = [name for index, name in enumerate(track.best) if index == 0 or track.best[index - 1] != name]
    assert runs == ["neutral", word, "neutral"]
    assert track.neutral is not None
    assert track.neutral[0] == 1.0
    assert track.beliefs[0].max() == 0.0


def test_trembling_does_not_name_what_a_face_does_not_show() -> None:
    frames = clip("joy", 50.0)
    shaken = frames + np.random.default_rng(1).normal(scale=40.0, size=frames.shape)
    track = api.recognise_over_time(shaken, rule="robust", fps=50.0)
    alone = [api.recognise(frame, rule="robust").best for frame in shaken]
    assert not set(alone) <= {"neutral", "joy"}
    assert set(track.best) == {"neutral", "joy"}


@pytest.mark.parametrize("word", api.ARCHETYPES)
def test_a_shaken_clip_is_neutral_then_its_emotion_then_neutral(word: str) -> None:
    frames = clip(word, 50.0)
    for seed in range(1, 5):
        shaken = frames + np.random.default_rng(seed).normal(scale=40.0, size=frames.shape)
        best = api.recognise_over_time(shaken, rule="robust", fps=50.0).best
        runs = [name for index, name in enumerate(best) if index == 0 or best[index - 1] != name]
        assert runs == ["neutral", word, "neutral"]


@pytest.mark.parametrize("fps", [1.0, 25.0, 240.0])
def test_a_single_picture_is_what_it_is_alone(fps: float) -> None:
    for word in api.ARCHETYPES:
        frame = np.nan_to_num(api.expression(word).frame())[None]
        assert api.recognise_over_time(frame, rule="robust", fps=fps).best == (word,)


def test_a_change_from_one_emotion_to_another_is_seen() -> None:
    joy, anger = (np.nan_to_num(api.expression(word).frame()) for word in ("joy", "anger"))
    frames = np.concatenate([np.tile(joy, (25, 1)), np.tile(anger, (25, 1))])
    assert api.recognise_over_time(frames, rule="robust", fps=25.0).best == ("joy",) * 25 + ("anger",) * 25


def test_frames_without_a_face_have_no_verdict_and_change_none() -> None:
    frames = clip("joy")
    frames[12:15] = np.nan
    track = api.recognise_over_time(frames, rule="robust", fps=25.0)
    assert track.best[11:16] == ("joy", None, None, None, "joy")


def test_the_table_says_how_far_the_face_rests(tmp_path: Path) -> None:
    track = api.recognise_over_time(clip("joy"), rule="robust", fps=25.0)
    api.write_belief_csv(tmp_path / "t.csv", track)
    with (tmp_path / "t.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert rows[0]["neutral"] == "1"
    assert [row["best"] for row in rows] == list(track.best)


def test_confidence_is_each_frame_s_own() -> None:
    frames = np.tile(np.nan_to_num(api.archetype("sadness", 0).frame()), (2, 1))
    frames[:, 12 - 1] = 400.0
    confidence = np.ones((2, 68))
    confidence[1, 12 - 1] = 0.0
    track = api.recognise_over_time(frames, rule="robust", confidence=confidence)
    assert track.beliefs[1, 1] > track.beliefs[0, 1]
    with pytest.raises(ParameterError, match="confidence"):
        api.recognise_over_time(frames, rule="robust", confidence=confidence[0])
