"""The page of what moves each FAP: whole, and true to the face."""

from __future__ import annotations

import re

import fap_table
import numpy as np
import pytest
import risorius.api as api
from places import DOCS


def test_the_page_has_every_low_level_fap_once() -> None:
    rows = re.findall(r"^\| (\d+)(?:, (\d+))? ", (DOCS / "faps.md").read_text(encoding="utf-8"), re.MULTILINE)
    assert sorted(int(number) for row in rows for number in row if number) == list(range(3, 69))


@pytest.mark.parametrize(
    ("number", "sign", "mechanism"),
    [(3, 1, "jaw opening"), (15, -1, "jaw shift"), (12, 1, "zygomaticus_major"), (19, 1, "orbicularis_oculi_upper"),
     (31, 1, "frontalis_med"), (46, 1, "tongue"), (49, -1, "head turn"), (65, 1, "skin")],
)  # fmt: skip
def test_a_fap_is_moved_by_what_anatomy_moves_it_with(number: int, sign: float, mechanism: str) -> None:
    found = fap_table.measure(api.default_face(), number, float(sign))
    assert max(found.shares, key=lambda name: found.shares[name]) == mechanism
    assert sum(found.shares.values()) == pytest.approx(found.natural)
    assert found.exact == pytest.approx(1.0, abs=0.02)


def test_leaks_are_told_in_the_faces_millimetres() -> None:
    """An opening jaw takes the lower lip along, and the tongue lies down, as far as itself; twins are no leak."""
    face = api.default_face()
    frame, achieved = np.full(68, np.nan), np.zeros(68)
    frame[[5, 6]] = 100.0
    achieved[[5, 6, 52, 53]] = 100.0
    assert fap_table.largest_leak(face, frame, achieved) is None
    achieved[32 - 1] = 50.0
    assert fap_table.largest_leak(face, frame, achieved) is None  # its pair speaks for it
    achieved[31 - 1] = 50.0
    leak = fap_table.largest_leak(face, frame, achieved)
    assert leak == (31, pytest.approx(50.0 * face.units.ens0 / face.units.mw0))
    number, value = fap_table.measure(face, 3, 1.0).leak
    assert number in (5, 10, 44, 46, 52, 57)
    assert -200.0 < value < -50.0


def test_nothing_is_asked_beyond_the_range_in_which_a_face_follows() -> None:
    assert fap_table.request(3, 1.0)[2] == 100.0
    nose = fap_table.request(63, 1.0)[62]
    assert 0.0 < nose < 50.0
    assert np.flatnonzero(~np.isnan(fap_table.request(61, -1.0))).tolist() == [60, 61]
