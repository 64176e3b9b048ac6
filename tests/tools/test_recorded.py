"""What recordings on heads say when they are read back (tools/recorded): figures of motions whose truth is known."""

from __future__ import annotations

import numpy as np
import pytest
from recorded import played


def test_a_face_that_adds_a_tremor_is_seen_where_the_recording_is_still() -> None:
    time = np.arange(400.0)
    told = np.where(time < 200.0, 0.01 * np.sin(time), 50.0 * np.sin(time / 10.0))[:, None]
    assert played._trembling(told, told) == pytest.approx(1.0)
    assert played._trembling(told, told + 0.05 * (-1.0) ** time[:, None]) > 3.0
    assert played._trembling(told, told + 5.0 * np.where(time < 250.0, 0.0, (-1.0) ** time)[:, None]) < 1.2


def test_a_pop_at_a_missing_frame_is_seen_and_one_elsewhere_is_not() -> None:
    unknown = np.zeros(100, dtype=bool)
    unknown[50] = True
    even = np.linspace(0.0, 99.0, 100)[:, None]
    assert played._jump(even, unknown) == pytest.approx(1.0 / 99.0)
    popped = even.copy()
    popped[50] = 0.0
    assert played._jump(popped, unknown) > 0.5
    elsewhere = even.copy()
    elsewhere[20] = 90.0
    assert played._jump(elsewhere, unknown) < 0.05


def test_what_hardly_moves_says_nothing() -> None:
    asked = np.zeros((100, 68))
    asked[:, 2], asked[:, 3], asked[:, 47] = np.linspace(0, 300, 100), np.linspace(0, 5, 100), np.linspace(0, 300, 100)
    assert np.flatnonzero(played._moved(asked)).tolist() == [2]
