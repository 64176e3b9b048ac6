"""FAP 1 and 2: sub-fields and what they expand to."""

from __future__ import annotations

import numpy as np
import pytest
import risorius.api as api
from risorius.errors import ParameterError
from risorius.mpeg4 import (
    FAP_COUNT,
    FAPS,
    PAIRS,
    VISEME_SHAPES,
    VISEMES,
    ExpressionField,
    FapStream,
    VisemeField,
    archetype,
    default_variant,
    expand,
    expression_frame,
    viseme_frame,
)


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
    np.testing.assert_array_equal(viseme_frame(VisemeField(10)), VISEME_SHAPES[10])


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
    assert np.isnan(low[0]).all()
    np.testing.assert_array_equal(low[2], VISEME_SHAPES[3])
    assert stream.expanded({3: _shape(F4=9.0)})[2, 3] == 9.0
    assert np.isnan(stream.frames[1, 30])


def test_every_viseme_has_a_shape_within_the_coding_limits() -> None:
    assert sorted(VISEME_SHAPES) == sorted(set(VISEMES) - {0})
    for number, frame in VISEME_SHAPES.items():
        assert np.isnan(frame[:2]).all()
        for index in np.flatnonzero(~np.isnan(frame)).tolist():
            fap = FAPS[index + 1]
            assert fap.intra_limits is not None
            assert fap.quant_step is not None
            low, high = (limit * fap.quant_step for limit in fap.intra_limits)
            assert low <= frame[index] <= high, (number, fap.name)
            assert fap.bidirectional or frame[index] >= 0.0, (number, fap.name)


def test_visemes_are_symmetric_mouths_and_leave_the_rest_of_the_face_alone() -> None:
    for frame in VISEME_SHAPES.values():
        for left, right in PAIRS:
            np.testing.assert_equal(frame[left - 1], frame[right - 1])
        assert np.isnan(frame[[n - 1 for n in range(3, FAP_COUNT + 1) if FAPS[n].group not in (2, 6, 8)]]).all()


def test_visemes_are_the_mouths_of_their_sounds() -> None:
    """Distances between the points, in FAP units; the lips touch at rest."""
    gap = {n: frame[4 - 1] * -1.0 - frame[5 - 1] for n, frame in VISEME_SHAPES.items()}
    assert gap[1] == 0.0 < gap[2] < min(gap[n] for n in range(3, 15))
    assert gap[10] == max(gap.values())
    jaw = {n: frame[3 - 1] for n, frame in VISEME_SHAPES.items()}
    assert jaw[10] > jaw[13] > jaw[11] > jaw[12] > jaw[7]
    rounded = {n for n, frame in VISEME_SHAPES.items() if frame[16 - 1] > 0.0}
    assert rounded == {6, 9, 13, 14}
    assert max(VISEME_SHAPES[n][6 - 1] for n in rounded) < min(
        VISEME_SHAPES[n][6 - 1] for n in VISEME_SHAPES if n not in rounded
    )
    tip = {n: VISEME_SHAPES[n][44 - 1] for n in (4, 5, 8, 10)}
    assert min(tip[4], tip[8]) > 300.0 > 0.0 > max(tip[5], tip[10])
    assert VISEME_SHAPES[3][45 - 1] == np.nanmax([frame[45 - 1] for frame in VISEME_SHAPES.values()])


def test_an_explicit_fap_wins_over_a_viseme_and_an_expression() -> None:
    frames = np.full((1, 68), np.nan)
    frames[0, [2, 30]] = 0.0, -5.0
    stream = FapStream(frames, expressions={0: ExpressionField(6)}, visemes={0: VisemeField(10)})
    low = stream.expanded()[0]
    assert (low[2], low[30]) == (0.0, -5.0)
    assert low[4] == pytest.approx(VISEME_SHAPES[10][4] + archetype("surprise", 2).frame()[4])


def test_the_api_offers_what_fap_1_and_2_stand_for() -> None:
    np.testing.assert_array_equal(api.viseme_frame(api.VisemeField(12)), VISEME_SHAPES[12])
    np.testing.assert_array_equal(
        api.expression_frame(api.ExpressionField(3, 63)), archetype("anger", default_variant("anger")).frame()
    )


@pytest.mark.parametrize("wrong", [-1, 15, 1.0, True])
def test_sub_fields_are_checked(wrong: object) -> None:
    with pytest.raises(ParameterError, match="viseme_select1"):
        VisemeField(wrong)  # type: ignore[arg-type]
    with pytest.raises(ParameterError, match="expression_select2"):
        ExpressionField(1, 63, wrong)  # type: ignore[arg-type]
