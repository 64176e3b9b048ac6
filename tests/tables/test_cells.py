"""Cells of tables: each reader takes what keeps its rule, and refuses the rest with file, place, rule and value."""

from __future__ import annotations

from collections.abc import Callable
from enum import StrEnum
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from risorius.errors import FormatError, ParameterError
from risorius.tables import Cells, CsvRow, TomlTable

FILE = Path("some.toml")


class Side(StrEnum):
    LEFT = "left"
    RIGHT = "right"


def toml(**cells: Any) -> TomlTable:
    return TomlTable(FILE, cells, "row")


def row(**cells: str) -> CsvRow:
    return CsvRow(Path("some.csv"), cells, 7)


@pytest.mark.parametrize("cells", [toml(a=3, b=0.5, c="left"), row(a="3", b="0.5", c="left")])
def test_reads_what_keeps_its_rule(cells: Cells) -> None:
    assert cells.number("a") == 3.0
    assert isinstance(cells.number("a"), float)
    assert cells.number("b", above=0.0, most=0.5) == 0.5
    assert cells.integer("a", least=3, most=3) == 3
    assert cells.text("c") == "left"
    assert cells.choice("c", Side) is Side.LEFT
    assert cells.choice("c", ("right", "left")) == "left"


@pytest.mark.parametrize("cells", [toml(), row(a="", b="", c="")])
def test_absent_cells_give_the_default(cells: Cells) -> None:
    assert "a" not in cells
    assert cells.number("a", 1.5) == 1.5
    assert cells.integer("a", 2) == 2
    assert cells.text("a", "") == ""
    assert cells.choice("a", Side, Side.RIGHT) is Side.RIGHT


READERS: dict[str, Callable[[Cells], object]] = {
    "a number": lambda cells: cells.number("a"),
    "a number above 0": lambda cells: cells.number("a", above=0.0),
    "a number, 2 or more": lambda cells: cells.number("a", least=2.0),
    "a number from 0 to 1": lambda cells: cells.number("a", least=0.0, most=1.0),
    "a number above 0, 1 or less": lambda cells: cells.number("a", above=0.0, most=1.0),
    "a whole number": lambda cells: cells.integer("a"),
    "a whole number from 1 to 68": lambda cells: cells.integer("a", least=1, most=68),
    "a text": lambda cells: cells.text("a"),
    "one of left, right": lambda cells: cells.choice("a", Side),
    "N finite numbers": lambda cells: cells.numbers("a"),
    "3 finite numbers": lambda cells: cells.numbers("a", 3),
}


@pytest.mark.parametrize("rule", READERS)
def test_an_absent_cell_without_default_is_refused(rule: str) -> None:
    if rule != "N finite numbers":  # an empty cell of CSV holds no numbers, and that is a count too
        with pytest.raises(FormatError) as refused:
            READERS[rule](row(a=""))
        assert str(refused.value) == f"some.csv, line 7, column a: is missing: it must be {rule}"
    with pytest.raises(FormatError) as refused:
        READERS[rule](toml())
    assert str(refused.value) == f"some.toml, key row.a: is missing: it must be {rule}"


@pytest.mark.parametrize(
    ("rule", "value"),
    [
        ("a number", "three"),
        ("a number", True),
        ("a number", float("nan")),
        ("a number", float("inf")),
        ("a number", [1.0]),
        ("a number", 10**400),
        ("a number above 0", 0.0),
        ("a number, 2 or more", 1.999),
        ("a number from 0 to 1", 1.001),
        ("a number from 0 to 1", -0.001),
        ("a number above 0, 1 or less", 2),
        ("a whole number", 3.0),
        ("a whole number", False),
        ("a whole number from 1 to 68", 0),
        ("a whole number from 1 to 68", 69),
        ("a text", 3),
        ("a text", ""),
        ("a text", " "),
        ("one of left, right", "up"),
        ("one of left, right", 1),
        ("N finite numbers", 3.0),
        ("N finite numbers", [1.0, "2"]),
        ("N finite numbers", [1.0, float("nan")]),
        ("N finite numbers", [True, False]),
        ("N finite numbers", [[1.0], [2.0, 3.0]]),
        ("3 finite numbers", [1.0, 2.0]),
    ],
)
def test_toml_refuses_what_breaks_the_rule(rule: str, value: object) -> None:
    with pytest.raises(FormatError) as refused:
        READERS[rule](toml(a=value))
    assert refused.value.key == "row.a"
    told = "is missing: it must be" if value == "" else "must be"
    assert refused.value.problem.startswith(f"{told} {rule}")
    assert value == "" or refused.value.problem.endswith(f", but it is {repr(value)[:40]}")


@pytest.mark.parametrize(
    ("rule", "value"),
    [
        ("a number", "three"),
        ("a number", "nan"),
        ("a number", "1_000"),
        ("a number", "1,5"),
        ("a number above 0", "0"),
        ("a whole number", "3.0"),
        ("a whole number from 1 to 68", "69"),
        ("one of left, right", "up"),
        ("N finite numbers", "1 two"),
        ("3 finite numbers", "1 2"),
    ],
)
def test_csv_refuses_what_breaks_the_rule(rule: str, value: str) -> None:
    with pytest.raises(FormatError) as refused:
        READERS[rule](row(a=value))
    assert (refused.value.line, refused.value.column) == (7, "a")
    assert refused.value.problem == f"must be {rule}, but it is {value!r}"


def test_numbers_have_the_shape_that_is_asked_for() -> None:
    np.testing.assert_array_equal(toml(a=[[1, 2], [3, 4], [5, 6]]).numbers("a", None, 2), [[1, 2], [3, 4], [5, 6]])
    np.testing.assert_array_equal(row(a="1 2.5  3").numbers("a", 3), [1.0, 2.5, 3.0])
    assert toml(a=[]).numbers("a").shape == (0,)
    assert toml(a=[]).numbers("a", 0, 4, None).shape == (0, 4, 0)
    assert toml(a=[1, 2]).numbers("a").dtype == np.float64


def test_texts_are_lists_in_toml_and_words_in_csv() -> None:
    assert toml(a=["8.3", "8.4"]).texts("a") == row(a="8.3 8.4").texts("a") == ("8.3", "8.4")
    with pytest.raises(FormatError, match=r"row\.a: must be a list of texts, but it is 'b'"):
        toml(a="b").texts("a")


def test_flags_are_not_numbers() -> None:
    assert toml(a=True).flag("a")
    assert not toml().flag("a", False)
    with pytest.raises(FormatError, match=r"row\.a: must be true or false, but it is 1"):
        toml(a=1).flag("a")


def test_unknown_cells_are_refused() -> None:
    toml(a=1, b=2).only("a", "b", "c")
    with pytest.raises(FormatError, match=r"key row\.prior: is unknown: did you mean prior_mm\?"):
        toml(a=1, prior=2).only("a", "prior_mm")
    with pytest.raises(FormatError, match=r"key row\.c: is unknown: use one of a, prior_mm"):
        toml(a=1, c=2).only("a", "prior_mm")


def test_a_refused_parameter_tells_where_it_stands() -> None:
    def refuse() -> None:
        raise ParameterError("a", "must be above 0", -1)

    with pytest.raises(FormatError) as refused:
        toml(a=-1).made(refuse)
    assert str(refused.value) == "some.toml, key row.a: must be above 0, but it is -1"
    with pytest.raises(FormatError) as refused:
        row(b="1").made(refuse)
    assert str(refused.value) == "some.csv, line 7: a must be above 0, but it is -1"
    assert toml().made(lambda: 3) == 3
