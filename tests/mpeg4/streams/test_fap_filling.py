"""FAPs that a stream does not state: copied, held, or left unknown."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from risorius.errors import ParameterError
from risorius.mpeg4 import LIP_TWINS, PAIRS, ExpressionField, FapStream, Filling, VisemeField, fill, read_fap


def frames_of(*rows: dict[int, float]) -> np.ndarray:
    """Frames that state these FAPs."""
    frames = np.full((len(rows), 68), np.nan)
    for frame, row in zip(frames, rows, strict=True):
        for number, value in row.items():
            frame[number - 1] = value
    return frames


def stated(frame: np.ndarray) -> dict[int, float]:
    """FAP number -> value of what a frame states."""
    return {int(index) + 1: float(frame[index]) for index in np.flatnonzero(~np.isnan(frame))}


def test_copy_goes_to_the_other_contour_and_the_other_side() -> None:
    filled = fill(frames_of({6: 50.0}, {31: -20.0}, {3: 9.0}), Filling.COPY)
    assert stated(filled[0]) == {6: 50.0, 7: 50.0, 53: 50.0, 54: 50.0}
    assert stated(filled[1]) == {31: -20.0, 32: -20.0}
    assert stated(filled[2]) == {3: 9.0}


@pytest.mark.parametrize("pair", [*PAIRS, *LIP_TWINS])
def test_copy_goes_both_ways(pair: tuple[int, int]) -> None:
    one, other = pair
    assert stated(fill(frames_of({one: 7.0}), "copy")[0])[other] == 7.0
    assert stated(fill(frames_of({other: 7.0}), "copy")[0])[one] == 7.0


def test_a_mouth_stated_crooked_on_one_contour_is_crooked_on_both() -> None:
    """Inner left and outer right: each goes to its own side's twin."""
    assert stated(fill(frames_of({12: 90.0, 60: -30.0}))[0]) == {12: 90.0, 59: 90.0, 60: -30.0, 13: -30.0}


def test_hold_keeps_the_last_value_and_invents_none_before_it() -> None:
    filled = fill(frames_of({}, {3: 5.0}, {}, {3: 8.0, 31: 1.0}), Filling.HOLD)
    assert [stated(frame) for frame in filled] == [{}, {3: 5.0}, {3: 5.0}, {3: 8.0, 31: 1.0}]


def test_the_standard_copies_before_it_holds() -> None:
    filled = fill(frames_of({31: 5.0, 32: 6.0}, {31: 9.0}, {}), Filling.STANDARD)
    assert [stated(frame) for frame in filled] == [{31: 5.0, 32: 6.0}, {31: 9.0, 32: 9.0}, {31: 9.0, 32: 9.0}]


def test_stated_values_and_the_argument_are_untouched() -> None:
    frames = frames_of({6: 1.0, 7: 2.0, 53: 3.0, 54: 4.0}, {6: 0.0})
    before = frames.copy()
    filled = fill(frames)
    np.testing.assert_array_equal(frames, before)
    assert stated(filled[0]) == {6: 1.0, 7: 2.0, 53: 3.0, 54: 4.0}
    assert stated(filled[1])[6] == 0.0  # zero is a statement


def test_a_stream_fills_its_high_level_faps_by_holding_only() -> None:
    stream = FapStream(
        frames_of({}, {6: 1.0}, {}),
        visemes={1: VisemeField(3)},
        expressions={0: ExpressionField(1)},
        name="x",
        fps=30.0,
    )
    held = stream.filled()
    assert held.visemes == {1: VisemeField(3), 2: VisemeField(3)}
    assert set(held.expressions) == {0, 1, 2}
    assert held.mask[:, [0, 1, 5]].tolist() == [[False, True, False], [True, True, True], [True, True, True]]
    copied = stream.filled("copy")
    assert copied.visemes == stream.visemes
    assert copied.mask[1, [5, 6, 52, 53]].all()
    assert (held.name, held.fps) == ("x", 30.0)


def test_a_real_stream_with_one_sided_gaps(shared: Path) -> None:
    """This sample states the outer lips alone; after filling the inner ones are stated, too."""
    stream = read_fap(shared / "samples" / "fap" / "vreng_sad.fap")
    filled = stream.filled()
    for inner, outer in LIP_TWINS:
        assert (stream.mask[:, outer - 1] & ~stream.mask[:, inner - 1]).any()
    for one, other in (*PAIRS, *LIP_TWINS):
        assert (filled.mask[:, one - 1] == filled.mask[:, other - 1]).all()


def test_an_unknown_rule_and_frames_of_another_shape_are_refused() -> None:
    with pytest.raises(ParameterError, match="copy, hold, standard"):
        fill(frames_of({}), "guess")
    with pytest.raises(ParameterError, match=r"\(T, 68\)"):
        fill(np.zeros(68))
