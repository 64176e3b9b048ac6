"""The table of muscles: what is wrong with a copy that somebody edited is said by file and key."""

from __future__ import annotations

import json
import tomllib
from collections.abc import Mapping
from pathlib import Path

import pytest
from risorius.api import MUSCLE_GROUPS, Mechanism
from risorius.errors import FormatError
from risorius.face.figures import ANATOMY
from risorius.face.muscles.kinds import KINDS
from risorius.face.muscles.table import read_muscles

TABLES = sorted((ANATOMY / "muscles").glob("*.toml"))
HEADER = 'mechanism = "lips"\n'
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
        ('kind = "linear"', 'kind = "spiral"', r"muscles\.test\.kind: must be one of linear, .*but it is 'spiral'"),
        ('sides = "pair"', 'sides = "both"', r"muscles\.test\.sides: must be one of pair, halves, but it is 'both'"),
        ('region = "all"', 'region = "nowhere"', r"muscles\.test\.region: must be one of all, .*but it is 'nowhere'"),
        ("exponent = 1.5\n", "", r"muscles\.test: a linear muscle needs exponent"),
        (
            "exponent = 1.5",
            "exponent = 1.5\nexponnent = 2",
            r"muscles\.test\.exponnent: is unknown: did you mean exponent",
        ),
        ("prior_mm = 4", "prior_mm = 0", r"muscles\.test\.prior_mm: must be a number above 0, but it is 0"),
        ('"5.1"', '"5.99"', r"muscles\.test\.attachment\.point: names feature point 5\.99, which the template lacks"),
        ("[0.1, 0.1, 0.0]", "[0.1, 0.1]", r"muscles\.test\.attachment\.offset: must be 3 finite numbers"),
        ("[0.1, 0.1, 0.0]", '[0.1, 0.1, "far"]', r"muscles\.test\.attachment\.offset: must be 3 finite numbers.*'far'"),
        ("reach = 1.5", "reach = true", r"muscles\.test\.reach: must be a number, but it is True"),
        ("reach = 1.5", "reach = inf", r"muscles\.test\.reach: must be a number, but it is inf"),
        ('au = "12"', "au = 12", r"muscles\.test\.au: must be a text, but it is 12"),
        ("reach = 1.5", "reach = 1.5\nbulge = 1", r"muscles\.test\.bulge: is unknown: use one of .*along_skin"),
        ("[muscles.test]", "[muscles.test", r"line 3: is not valid TOML"),
    ],
)
def test_a_wrong_row_is_refused_by_file_and_key(tmp_path: Path, old: str, new: str, said: str) -> None:
    path = tmp_path / "mine.toml"
    assert ROW.count(old) == 1
    path.write_text(HEADER + ROW.replace(old, new), encoding="utf-8")
    with pytest.raises(FormatError, match=rf"mine\.toml.*{said}"):
        read_muscles(path)


def test_a_missing_table_is_named(tmp_path: Path) -> None:
    with pytest.raises(FormatError, match=r"gone\.toml"):
        read_muscles(tmp_path / "gone.toml")


def test_a_row_of_ones_own_is_read(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(HEADER + ROW, encoding="utf-8")
    rows = read_muscles(path)
    assert set(rows) == {"test"}
    assert rows["test"].amplitude == pytest.approx(0.004)
    assert rows["test"].mechanism is Mechanism.LIPS


def test_a_table_of_no_group_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text('mechanism = "bending"\n' + ROW, encoding="utf-8")
    with pytest.raises(FormatError, match=r"mine\.toml.*mechanism.*must be one of brow.*'bending'"):
        read_muscles(path)


def test_a_muscle_stands_in_one_table_only(tmp_path: Path) -> None:
    for name in ("one.toml", "two.toml"):
        (tmp_path / name).write_text(HEADER + ROW, encoding="utf-8")
    with pytest.raises(FormatError, match=r"two\.toml.*muscles\.test.*also a muscle of the group lips"):
        read_muscles(tmp_path)


def test_every_group_has_a_table_of_its_name() -> None:
    assert {path.stem for path in TABLES} == {str(group) for group in MUSCLE_GROUPS}
    for path in TABLES:
        assert {row.mechanism for row in read_muscles(path).values()} == {path.stem}


def test_every_row_gives_what_its_kind_needs_and_says_where_it_is_from() -> None:
    rows = read_muscles()
    assert len(rows) >= 20
    for path in TABLES:
        assert tomllib.loads(path.read_text(encoding="utf-8"))["source"].strip(), path
    for row in rows.values():
        assert row.prior > 0.0, row.name
        assert 0.5e-3 <= row.amplitude <= 25e-3, row.name


def as_toml(row: Mapping[str, object]) -> str:
    """Keys and values of a row as a table has them: JSON is TOML for lists and words, but not for tables."""
    return "".join(f"{key} = {_value(value)}\n" for key, value in row.items())


def _value(value: object) -> str:
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {_value(inner)}" for key, inner in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(_value, value)) + "]"
    return json.dumps(value)


def first_of_each_kind() -> list[tuple[str, Path, Mapping[str, object]]]:
    """Kind, file and raw row of the first muscle of each kind."""
    found: dict[str, tuple[str, Path, Mapping[str, object]]] = {}
    for path in TABLES:
        for raw in tomllib.loads(path.read_text(encoding="utf-8"))["muscles"].values():
            found.setdefault(raw["kind"], (raw["kind"], path, raw))
    return list(found.values())


@pytest.mark.parametrize(("kind", "path", "raw"), first_of_each_kind())
def test_a_row_without_what_its_kind_needs_is_refused_by_what_it_lacks(
    tmp_path: Path, kind: str, path: Path, raw: Mapping[str, object]
) -> None:
    header = f'mechanism = "{path.stem}"\n[muscles.test]\n'
    copy = tmp_path / "mine.toml"
    copy.write_text(header + as_toml(raw), encoding="utf-8")
    assert type(read_muscles(copy)["test"]) is KINDS[kind]
    assert KINDS[kind].needed() <= set(raw)
    for key in KINDS[kind].needed():
        copy.write_text(header + as_toml({k: v for k, v in raw.items() if k != key}), encoding="utf-8")
        with pytest.raises(FormatError, match=rf"mine\.toml.*muscles\.test: a {kind} muscle needs {key}"):
            read_muscles(copy)


def test_the_table_has_a_muscle_of_every_kind() -> None:
    assert {kind for kind, _, _ in first_of_each_kind()} == set(KINDS)
