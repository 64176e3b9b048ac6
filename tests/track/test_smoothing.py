"""Smoothing: what it keeps, what it takes away, what it costs in time."""

from __future__ import annotations

import numpy as np
import pytest
from risorius.errors import ParameterError
from risorius.track import Smoothing, smooth

FPS = 25.0


def columns(values: np.ndarray) -> np.ndarray:
    """One column in a frame's shape (T, 68), the others unknown."""
    frames = np.full((len(values), 68), np.nan)
    frames[:, 2] = values
    return frames


def test_parabolas_pass_through_savitzky_golay_unchanged() -> None:
    t = np.arange(40) / FPS
    values = 300.0 * t**2 - 120.0 * t + 7.0
    np.testing.assert_allclose(smooth(columns(values), FPS)[:, 2], values, atol=1e-9)


@pytest.mark.parametrize("how", [Smoothing.SAVGOL, Smoothing.EURO])
def test_trembling_is_taken_out(how: Smoothing) -> None:
    noise = np.random.default_rng(3).normal(0.0, 10.0, 400)
    left = smooth(columns(noise), FPS, how)[20:, 2].std()
    assert left < 0.75 * noise.std()


@pytest.mark.parametrize("how", list(Smoothing))
def test_a_slow_motion_comes_as_late_as_is_said(how: Smoothing) -> None:
    ramp = 2.0 * np.arange(400) / FPS  # FAP units, two a second
    lag = (ramp - smooth(columns(ramp), FPS, how)[:, 2])[300:].mean() / 2.0
    assert lag == pytest.approx(how.delay, abs=0.5 / FPS)


def test_the_one_euro_filter_lags_less_when_the_face_moves_fast() -> None:
    ramp = 2000.0 * np.arange(400) / FPS
    lag = (ramp - smooth(columns(ramp), FPS, "euro")[:, 2])[300:].mean() / 2000.0
    assert lag < 0.2 * Smoothing.EURO.delay


@pytest.mark.parametrize("how", list(Smoothing))
def test_unknown_stays_unknown_and_parts_its_two_sides(how: Smoothing) -> None:
    values = np.concatenate([np.zeros(30), [np.nan, np.nan], np.full(30, 500.0)])
    smoothed = smooth(columns(values), FPS, how)
    assert np.array_equal(np.isnan(smoothed), np.isnan(columns(values)))
    np.testing.assert_allclose(smoothed[:30, 2], 0.0, atol=1e-9)
    np.testing.assert_allclose(smoothed[32:, 2], 500.0, atol=1e-9)


def test_stretches_too_short_for_the_window_are_left_alone() -> None:
    values = np.array([1.0, 5.0, np.nan, 2.0, np.nan, 9.0, -4.0, 3.0])
    np.testing.assert_array_equal(smooth(columns(values), FPS)[:, 2], values)


def test_what_is_given_is_not_changed() -> None:
    given = columns(np.random.default_rng(1).normal(size=50))
    kept = given.copy()
    smooth(given, FPS)
    np.testing.assert_array_equal(given, kept)


def test_an_unknown_way_is_refused() -> None:
    with pytest.raises(ParameterError, match="savgol"):
        smooth(np.zeros((3, 68)), FPS, "kalman")
