"""A recorded mouth is said with feeling: its own motion, the emotion by the rule of sharing."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
import risorius.api as api
from risorius.errors import FormatError

FPS = 30


@pytest.fixture
def weights(tmp_path: Path) -> Path:
    """Audio2Face's weights: a jaw that opens from 0.5 to 2.5 s, lips closed about 1.25 s."""
    times = np.arange(0, 3, 1 / FPS)
    jaw = np.where((times > 0.5) & (times < 2.5), 0.4, 0.0)
    close = np.where(np.abs(times - 1.25) < 0.06, 1.0, 0.0)
    rows = [[float(open_), float(open_ * shut), 0.3] for open_, shut in zip(jaw, close, strict=True)]
    path = tmp_path / "a2f.json"
    names = ["jawOpen", "mouthClose", "browInnerUp"]
    path.write_text(json.dumps({"exportFps": FPS, "facsNames": names, "weightMat": rows}), encoding="utf-8")
    return path


def column(frames: np.ndarray, name: str) -> np.ndarray:
    """(T,) one FAP."""
    return np.asarray(frames[:, api.fap(name).number - 1])


def test_lips_that_part_and_close_are_sounds(weights: Path) -> None:
    said = api.read_timings(weights)
    assert [sound.symbol for sound in said.sounds] == ["open", "closed", "open"]
    assert (said.sounds[0].start, said.sounds[-1].end) == (pytest.approx(0.53, abs=0.04), pytest.approx(2.5, abs=0.04))
    assert said.sounds[1].middle == pytest.approx(1.25, abs=0.04)
    assert said.assumed[-1] == "the mouth is the recording's own; what else it shows is left to the emotion"


def test_the_mouth_is_the_recordings_and_the_brows_are_the_emotions(weights: Path) -> None:
    recorded = api.read_stream(weights).frames
    plain = api.say(weights, fps=float(FPS)).stream.frames
    count = min(len(recorded), len(plain))
    assert np.allclose(column(plain, "open_jaw")[:count], column(recorded, "open_jaw")[:count])
    assert np.isnan(column(plain, "raise_l_i_eyebrow")).all()
    felt = api.say(weights, emotion=api.expression("sadness"), fps=float(FPS)).stream.frames
    assert column(felt, "raise_l_i_eyebrow")[30] > 50.0
    lips = column(felt, "lower_t_midlip") + column(felt, "raise_b_midlip")
    assert lips[round(1.25 * FPS)] > -5.0  # still closed
    smaller = api.say(weights, fps=float(FPS), jaw=0.5).stream.frames
    assert np.allclose(column(smaller, "open_jaw"), 0.5 * column(plain, "open_jaw"))


def test_it_is_said_at_another_rate(weights: Path) -> None:
    assert np.allclose(
        column(api.say(weights, fps=60.0).stream.frames, "open_jaw")[40:60:2],
        column(api.say(weights, fps=30.0).stream.frames, "open_jaw")[20:30],
    )


def test_a_recording_whose_mouth_rests_says_so(tmp_path: Path) -> None:
    path = tmp_path / "brows.json"
    path.write_text(json.dumps({"exportFps": 30, "facsNames": ["browInnerUp"], "weightMat": [[0.1], [0.9]]}))
    with pytest.raises(FormatError, match="has no mouth that speaks: its lips do not part"):
        api.read_timings(path)


def test_what_is_neither_is_refused_as_timings(tmp_path: Path) -> None:
    path = tmp_path / "nothing.json"
    path.write_text('{"what": 1}')
    with pytest.raises(FormatError, match="holds no sounds in time"):
        api.read_timings(path)
