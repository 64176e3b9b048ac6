"""The table of muscles: what is wrong with a copy that somebody edited is said by file and key."""

from __future__ import annotations

from pathlib import Path

import pytest
from risorius.errors import FormatError
from risorius.face.muscle_table import NEEDS, read_muscles
from risorius.face.template import ANATOMY

TABLE = (ANATOMY / "muscles.toml").read_text(encoding="utf-8")
ROW = """
[muscles.test]
title = "test"
kind = "linear"
au = "12"
sides = "pair"
region = "all"
attachment = { point = "5.1", offset = [0.1, 0.1, 0.0] }
insertion = { point = "8.3", offset = [0.0, 0.0, 0.0] }
angle_deg = 30
exponent = 1.5
reach = 1.5
prior_mm = 4
amplitude_mm = 4
"""


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('kind = "linear"', 'kind = "spiral"', r"muscles\.test: kind, sides or region.*spiral"),
        ('sides = "pair"', 'sides = "both"', r"muscles\.test: kind, sides or region.*both"),
        ('region = "all"', 'region = "nowhere"', r"muscles\.test: kind, sides or region.*nowhere"),
        ("exponent = 1.5\n", "", r"muscles\.test: a linear muscle needs exponent"),
        ("exponent = 1.5", "exponent = 1.5\nexponnent = 2", r"muscles\.test: a linear muscle has no exponnent"),
        ("prior_mm = 4", "prior_mm = 0", r"muscles\.test: prior_mm must be positive, not 0"),
        ('"5.1"', '"5.99"', r"muscles\.test\.attachment: names feature point '5\.99'"),
        ("[0.1, 0.1, 0.0]", "[0.1, 0.1]", r"muscles\.test\.attachment: needs an offset of three numbers"),
        ("[muscles.test]", "[muscles.test", r"not a readable TOML table"),
    ],
)
def test_a_wrong_row_is_refused_by_file_and_key(tmp_path: Path, old: str, new: str, said: str) -> None:
    path = tmp_path / "mine.toml"
    assert ROW.count(old) == 1
    path.write_text(ROW.replace(old, new), encoding="utf-8")
    with pytest.raises(FormatError, match=rf"mine\.toml.*{said}"):
        read_muscles(path)


def test_a_missing_table_is_named(tmp_path: Path) -> None:
    with pytest.raises(FormatError, match=r"gone\.toml"):
        read_muscles(tmp_path / "gone.toml")


def test_a_row_of_ones_own_is_read(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(TABLE + ROW, encoding="utf-8")
    rows = read_muscles(path)
    assert set(rows) == {*read_muscles(), "test"}
    assert rows["test"].amplitude == pytest.approx(0.004)


def test_every_row_gives_what_its_kind_needs_and_says_where_it_is_from() -> None:
    rows = read_muscles()
    assert len(rows) >= 20
    assert "source = " in TABLE.split("[muscles.")[0]
    for row in rows.values():
        assert row.prior > 0.0, row.name
        assert 0.5e-3 <= row.amplitude <= 25e-3, row.name
        for needed, present in (("centre", row.centre), ("attachment", row.attachment), ("direction", row.direction)):
            assert (needed in NEEDS[row.kind]) == (present is not None), (row.name, needed)
