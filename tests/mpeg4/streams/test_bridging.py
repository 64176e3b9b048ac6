"""Holes in a stream: bridged evenly where short, eased to rest where long, and said."""

from __future__ import annotations

import numpy as np
import pytest
from risorius.errors import ParameterError
from risorius.mpeg4 import FAP_COUNT, bridged

FPS = 30.0


def stream(count: int, **columns: float) -> np.ndarray:
    """Frames that state some FAPs ("f3") all the time."""
    frames = np.full((count, FAP_COUNT), np.nan)
    for name, value in columns.items():
        frames[:, int(name[1:]) - 1] = value
    return frames


@pytest.mark.parametrize("rate", [2.0, 24.0, 60.0])
def test_one_unknown_frame_is_bridged_evenly_and_said(rate: float) -> None:
    frames = stream(5, f3=0.0, f49=0.0)
    frames[:, 2] = [100.0, 200.0, np.nan, 400.0, 0.0]
    frames[2, 48] = np.nan
    found = bridged(frames, rate)
    np.testing.assert_allclose(found.frames[:, 2], [100.0, 200.0, 300.0, 400.0, 0.0])
    np.testing.assert_array_equal(found.frames[:, 48], 0.0)
    assert found.said == ("1 unknown frame (2): bridged from those around",)
    assert np.isnan(frames[2, 2])


def test_a_long_hole_is_eased_to_rest_and_back_without_a_step() -> None:
    frames = stream(200, f3=300.0, f19=500.0)
    frames[60:140] = np.nan
    found = bridged(frames, FPS)
    assert not np.isnan(found.frames[:, [2, 18]]).any()
    assert found.frames[100, 2] == 0.0
    assert np.abs(np.diff(found.frames[:, 18])).max() < 2.0 * 500.0 / (0.4 * FPS)
    np.testing.assert_allclose(found.frames, found.frames[::-1])
    assert found.said == ("80 unknown frames (60 to 139): longer than 0.5 s, the face goes to rest",)


def test_holes_at_the_ends_are_held_where_short_and_eased_where_long() -> None:
    frames = stream(100, f3=300.0)
    frames[:3] = frames[60:] = np.nan
    found = bridged(frames, FPS).frames[:, 2]
    np.testing.assert_array_equal(found[:60], 300.0)
    assert found[-1] == 0.0
    assert (np.diff(found) <= 0.0).all()


def test_silence_on_purpose_stays_and_a_trackers_silence_does_not() -> None:
    frames = stream(120, f3=300.0, f12=100.0)
    frames[40:80, 11] = np.nan
    on_purpose = bridged(frames, FPS)
    np.testing.assert_array_equal(on_purpose.frames, frames)
    assert on_purpose.said == ()
    lost = bridged(frames, FPS, whole=True)
    assert lost.frames[60, 11] == 0.0
    assert np.isnan(lost.frames[:, 12]).all()
    assert lost.said == ("40 frames lack some FAPs: bridged from those around",)


def test_what_lies_under_it_shows_where_it_knows_nothing() -> None:
    frames, under = stream(120, f3=300.0), stream(120, f3=50.0, f12=80.0)
    frames[40:80] = np.nan
    found = bridged(frames, FPS, under=under)
    assert found.frames[60, 2] == 50.0
    assert found.frames[0, 2] == 300.0
    np.testing.assert_array_equal(found.frames[:, 11], 80.0)
    assert found.said == ("40 unknown frames (40 to 79): longer than 0.5 s, the face shows the timeline alone",)


def test_a_stream_without_holes_or_without_anything_is_left_alone() -> None:
    for frames in (stream(4, f3=1.0), stream(4), stream(0)):
        found = bridged(frames, FPS)
        np.testing.assert_array_equal(found.frames, frames)
        assert found.said == ()
    with pytest.raises(ParameterError):
        bridged(np.zeros((3, 4)), FPS)
