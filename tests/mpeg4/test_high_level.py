"""FAP 1 and 2: sub-fields and what they expand to."""

from __future__ import annotations

import numpy as np
import pytest
from risorius.errors import ParameterError
from risorius.mpeg4 import ExpressionField, FapStream, VisemeField, archetype, expand, expression_frame, viseme_frame


def _shape(**values: float) -> np.ndarray:
    frame = np.full(68, np.nan)
    for name, value in values.items():
        frame[int(name[1:]) - 1] = value
    return frame


def test_an_expression_at_full_intensity_is_its_archetype() -> None:
    np.testing.assert_array_equal(expression_frame(ExpressionField(4)), archetype("fear", 8).frame())
    np.testing.assert_array_equal(expression_frame(ExpressionField(1)), archetype("joy", 1).frame())


def test_two_expressions_add() -> None:
    both = expression_frame(ExpressionField(2, 21, 6, 42))
    sadness, surprise = archetype("sadness", 0).frame(), archetype("surprise", 2).frame()
    assert both[30] == pytest.approx(sadness[30] / 3.0 + surprise[30] * 2.0 / 3.0)
    assert both[2] == pytest.approx(surprise[2] * 2.0 / 3.0)
    assert np.isnan(both[36])


def test_no_expression_is_silent() -> None:
    assert np.isnan(expression_frame(ExpressionField(0))).all()


def test_visemes_cross_fade() -> None:
    shapes = {3: _shape(F3=63.0, F17=10.0), 10: _shape(F3=630.0)}
    mixed = viseme_frame(VisemeField(3, 10, 42), shapes)
    assert mixed[2] == pytest.approx(63.0 * 2 / 3 + 630.0 / 3)
    assert mixed[16] == pytest.approx(10.0 * 2 / 3)
    assert np.isnan(mixed[3])
    np.testing.assert_array_equal(viseme_frame(VisemeField(3), shapes), shapes[3])
    with pytest.raises(ParameterError, match=r"viseme 1 \(p b m\)"):
        viseme_frame(VisemeField(1), shapes)


def test_explicit_faps_override_and_expansions_add() -> None:
    np.testing.assert_array_equal(
        expand(_shape(F3=1.0), _shape(F3=50.0, F4=2.0), _shape(F4=3.0, F5=4.0)), _shape(F3=1.0, F4=5.0, F5=4.0)
    )


def test_a_stream_expands_its_high_level_faps() -> None:
    frames = np.full((3, 68), np.nan)
    frames[1, 2] = 7.0
    stream = FapStream(frames, expressions={1: ExpressionField(6)}, visemes={2: VisemeField(3)})
    low = stream.expanded()
    assert low[1, 2] == 7.0
    assert low[1, 30] == archetype("surprise", 2).frame()[30]
    assert np.isnan(low[[0, 2]]).all()
    assert stream.expanded({3: _shape(F4=9.0)})[2, 3] == 9.0
    assert np.isnan(stream.frames[1, 30])


@pytest.mark.parametrize("wrong", [-1, 15, 1.0, True])
def test_sub_fields_are_checked(wrong: object) -> None:
    with pytest.raises(ParameterError, match="viseme_select1"):
        VisemeField(wrong)  # type: ignore[arg-type]
    with pytest.raises(ParameterError, match="expression_select2"):
        ExpressionField(1, 63, wrong)  # type: ignore[arg-type]
