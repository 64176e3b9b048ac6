"""Trembling is taken out of recordings, and what moves stays: in time, and as far as it moves."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from risorius import api
from risorius.face.tracked.steady import steadied, trembling

FPS, COUNT = 30.0, 300
JAW, LID = 3 - 1, 19 - 1


def moving() -> np.ndarray:
    """(300, 68) a jaw that opens and closes slowly, and a lid that blinks within a tenth of a second."""
    frames = np.full((COUNT, 68), np.nan)
    frames[:, JAW] = 200.0 - 200.0 * np.cos(np.arange(COUNT) / 12.0)
    frames[:, LID] = 0.0
    for blink in range(20, COUNT, 40):
        frames[blink : blink + 4, LID] = 500.0, 1000.0, 1000.0, 450.0
    return frames


def errors() -> np.ndarray:
    """(300, 68) errors of 10 FAP units."""
    return np.random.default_rng(5).normal(0.0, 10.0, (COUNT, 68))


def test_a_trembling_face_keeps_still_and_moves_as_before() -> None:
    frames = moving()
    found = steadied(frames + errors(), FPS)
    inside = slice(5, -5)
    off = {column: (found - frames)[inside, column] for column in (JAW, LID)}
    assert np.std(off[JAW]) < 8.0
    still = np.flatnonzero(np.convolve(frames[:, LID], np.ones(11), mode="same") == 0.0)
    assert np.std(found[still, LID]) < 7.0
    shut = frames[:, LID] == 1000.0
    assert found[shut, LID].min() > 940.0
    assert np.corrcoef(found[1:, LID], frames[:-1, LID])[0, 1] < np.corrcoef(found[:, LID], frames[:, LID])[0, 1]


def test_what_trembles_is_measured() -> None:
    frames = moving()
    assert trembling(frames + errors(), FPS)[JAW] == pytest.approx(10.0, rel=0.3)
    assert trembling(frames, FPS)[JAW] < 1.0
    assert trembling(frames, FPS)[0] == 0.0


def test_a_recording_that_does_not_tremble_stays_as_it_is() -> None:
    frames = np.full((COUNT, 68), np.nan)
    frames[:, LID] = moving()[:, LID]
    frames[100:110] = np.nan
    np.testing.assert_array_equal(steadied(frames, FPS), frames)
    short = moving()[:4]
    np.testing.assert_array_equal(steadied(short, FPS), short)


@pytest.mark.parametrize("ending", [".fap", ".json", ".csv", ".fba"])
def test_every_file_is_steadied_on_request(ending: str, tmp_path: Path) -> None:
    path = tmp_path / f"a{ending}"
    stream = api.FapStream(moving() + errors(), fps=25.0, visemes={3: api.VisemeField(4)})
    api.write_stream(path, stream)
    plain, steady = (api.read_recording(path, steady=asked).stream for asked in (False, True))
    np.testing.assert_allclose(steady.frames, steadied(plain.frames, plain.fps), atol=1e-9)
    assert steady.visemes == plain.visemes
    assert np.nanmax(np.abs(steady.frames - plain.frames)) > 5.0
