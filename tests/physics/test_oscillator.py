"""A damped second-order response against its closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from risorius.errors import ParameterError
from risorius.physics.oscillator import Oscillator


def test_a_step_is_answered_in_closed_form_whatever_the_length_of_steps() -> None:
    frequency, ratio, end = 6.0, 0.7, 0.1
    omega = 2.0 * np.pi * frequency
    damped = omega * np.sqrt(1.0 - ratio**2)
    phase = np.exp(-ratio * omega * end)
    exact = 1.0 - phase * (np.cos(damped * end) + ratio * omega / damped * np.sin(damped * end))
    for count in (1, 7):
        after, state = Oscillator(frequency, ratio).propagator(end / count), np.zeros(2)
        for _ in range(count):
            state = after @ np.array([*state, 1.0, 0.0])
        assert state[0] == pytest.approx(exact, abs=1e-12)


def test_an_even_ramp_is_followed_at_the_lag_of_the_damping() -> None:
    frequency, ratio, step = 5.0, 0.8, 0.01
    after, state = Oscillator(frequency, ratio).propagator(step), np.zeros(2)
    for number in range(200):
        state = after @ np.array([*state, 0.3 * number * step, 0.3])
    lag = 2.0 * ratio / (2.0 * np.pi * frequency)
    assert state == pytest.approx([0.3 * (200 * step - lag), 0.3], abs=1e-9)


@pytest.mark.parametrize(("figures", "name"), [((0.0, 0.7), "frequency"), ((6.0, -0.1), "damping_ratio")])
def test_impossible_figures_are_refused(figures: tuple[float, float], name: str) -> None:
    with pytest.raises(ParameterError, match=name):
        Oscillator(*figures)
