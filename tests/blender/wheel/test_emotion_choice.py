"""What is chosen in the panel is what the API says: a word, or a point of the wheel; and whoever listens is told."""

from __future__ import annotations

import math
from contextlib import ExitStack
from typing import Any

import numpy as np
import pytest
import risorius.api as api
from risorius.operators.changes import listen
from risorius.operators.emotion.profile import title_of, wanted_of


def test_a_point_of_the_wheel_is_the_profile_of_that_angle(head: Any) -> None:
    emotion = head.risorius.emotion
    emotion.by, emotion.angle, emotion.activation = "WHEEL", math.radians(90.0), 5.0
    wanted = wanted_of(head)
    np.testing.assert_allclose(wanted.faps, api.expression(angle=90.0, activation=5.0).frame(), rtol=1e-5)
    assert title_of(emotion) == "90° at 5.0"


def test_a_word_puts_the_wheel_where_the_word_is(head: Any) -> None:
    emotion = head.risorius.emotion
    emotion.by = "WHEEL"
    emotion.word = "sadness"
    assert emotion.by == "WORD"
    assert math.degrees(emotion.angle) == pytest.approx(api.expression("sadness").angle, abs=1e-3)
    assert wanted_of(head).profile == api.expression("sadness", activation=emotion.activation)


@pytest.mark.parametrize(("turned", "kept"), [(370.0, 10.0), (-20.0, 340.0), (360.0, 0.0), (359.0, 359.0)])
def test_the_wheel_goes_round(head: Any, turned: float, kept: float) -> None:
    emotion = head.risorius.emotion
    emotion.angle = math.radians(turned)
    assert math.degrees(emotion.angle) == pytest.approx(kept, abs=1e-3)


@pytest.mark.parametrize(
    ("name", "value"), [("word", "fear"), ("activation", 2.0), ("seed", 3), ("drive", "exact"), ("angle", 1.0)]
)
def test_every_choice_tells_the_listeners(head: Any, name: str, value: Any) -> None:
    heard: list[Any] = []
    with ExitStack() as undo:
        listen(heard.append, undo)
        setattr(head.risorius.emotion, name, value)
    assert head in heard
