"""A sound lasts longer or shorter, and its pitch stays."""

from __future__ import annotations

import numpy as np
import pytest
from risorius.errors import ParameterError
from risorius.speech.stretching import stretched

RATE = 16000


@pytest.mark.parametrize("amount", [0.5, 0.8, 1.25, 2.0])
def test_the_pitch_of_a_tone_stays_and_so_does_its_loudness(amount: float) -> None:
    tone = np.sin(2.0 * np.pi * 150.0 * np.arange(RATE) / RATE)[:, None]
    longer = stretched(tone, RATE, amount)
    assert len(longer) == round(RATE * amount)
    inside = longer[1000:-1000, 0]
    spectrum = np.abs(np.fft.rfft(inside * np.hanning(len(inside))))
    assert np.fft.rfftfreq(len(inside), 1.0 / RATE)[spectrum.argmax()] == pytest.approx(150.0, abs=2.0)
    assert np.sqrt((inside**2).mean()) == pytest.approx(np.sqrt(0.5), rel=0.02)


def test_both_channels_stay_apart_and_a_moment_stays_where_it_was() -> None:
    sound = np.zeros((RATE, 2))
    sound[RATE // 2 : RATE // 2 + 800, 1] = 0.5 * np.sin(np.arange(800) * 0.3)
    longer = stretched(sound, RATE, 1.5)
    assert not longer[:, 0].any()
    loud = np.flatnonzero(np.abs(longer[:, 1]) > 0.1)
    assert loud.mean() / RATE == pytest.approx(1.5 * (0.5 + 400 / RATE), abs=0.02)


def test_what_is_too_short_or_no_amount_stays() -> None:
    short = np.ones((50, 1))
    assert (stretched(short, RATE, 2.0) == short).all()
    with pytest.raises(ParameterError, match="must be above 0"):
        stretched(short, RATE, 0.0)
