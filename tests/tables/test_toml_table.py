"""TOML files as tables: found by name, and refused with the dotted key."""

from __future__ import annotations

import tomllib
from pathlib import Path

import pytest
from risorius.errors import FormatError
from risorius.resources import PRESETS
from risorius.tables import TomlTable, read_toml, toml_number, toml_text

TEXT = """
unit = "mm"
[muscles.risorius]
prior = 2
[muscles.mentalis.at]
x = 1.5
[[clips]]
word = "joy"
[[clips]]
word = 3
[points]
"8.4" = "far"
lines = [[[1, 2]], [[3, 4], [5, "six"]]]
"""


@pytest.fixture
def table(tmp_path: Path) -> TomlTable:
    path = tmp_path / "mine.toml"
    path.write_text(TEXT)
    return read_toml(path)


def test_tables_are_found_by_name(table: TomlTable) -> None:
    assert list(table) == ["unit", "muscles", "clips", "points"]
    assert list(table.tables("muscles")) == ["risorius", "mentalis"]
    assert table.table("muscles").table("risorius").integer("prior") == 2
    assert table.tables("muscles")["mentalis"].table("at").number("x") == 1.5
    assert table.listed("clips")[0].text("word") == "joy"
    assert table.table("absent", optional=True).cells == {}
    assert table.tables("absent", optional=True) == {}
    assert table.listed("absent") == []


def test_lists_are_read_by_place(table: TomlTable) -> None:
    lines = table.table("points").entries("lines")
    assert list(lines) == ["0", "1"]
    assert lines.numbers("0", None, 2).tolist() == [[1.0, 2.0]]
    with pytest.raises(FormatError, match=r"key points\.lines\.1: must be N x 2 finite numbers"):
        lines.numbers("1", None, 2)
    with pytest.raises(FormatError, match=r"key unit: must be a list, but it is 'mm'"):
        table.entries("unit")


def test_refusals_name_the_dotted_key(table: TomlTable) -> None:
    for read, told in (
        (lambda: table.table("unit"), r"key unit: must be a table: begin it with \[unit\]"),
        (lambda: table.table("absent"), r"key absent: must be a table"),
        (lambda: table.tables("absent"), r"key absent: must have at least one table: begin it with \[absent\.NAME\]"),
        (lambda: table.table("muscles").tables("risorius"), r"key muscles\.risorius\.prior: must be a table"),
        (lambda: table.listed("unit"), r"key unit: must be a list of tables: begin each with \[\[unit\]\]"),
        (lambda: table.listed("clips")[1].text("word"), r"key clips\.1\.word: must be a text, but it is 3"),
        (lambda: table.table("points").number("8.4"), r'key points\."8\.4": must be a number'),
    ):
        with pytest.raises(FormatError, match=told):
            read()
    assert str(table.table("muscles").refuse("is odd")).endswith("mine.toml, key muscles: is odd")
    assert str(table.refuse("is odd")).endswith("mine.toml: is odd")


def test_what_is_not_toml_is_refused_with_its_line(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text("a = 1\nb = = 2\n")
    with pytest.raises(FormatError, match=r"mine\.toml, line 2: is not valid TOML: Invalid value"):
        read_toml(path)
    path.write_bytes(b"a = 1\n# \xff")
    with pytest.raises(FormatError, match=r"byte 8: is not UTF-8 text: save it as UTF-8"):
        read_toml(path)


def test_a_file_that_cannot_be_read_is_refused_with_the_remedy(tmp_path: Path) -> None:
    with pytest.raises(FormatError, match=r"absent\.toml: cannot be read \(No such file or directory\): give a file"):
        read_toml(tmp_path / "absent.toml")
    with pytest.raises(FormatError, match=r"cannot be read .*: install Risorius again"):
        read_toml(PRESETS / "absent.toml")


@pytest.mark.parametrize("text", ["plain", 'a "b" \\ c', "two\nlines\tand\rtabs", "Mälzel 顔", "bell \x07 and \x7f"])
def test_texts_survive_toml(text: str) -> None:
    assert tomllib.loads(f"a = {toml_text(text)}") == {"a": text}


def test_numbers_survive_toml() -> None:
    assert toml_number(0.30000001192092896) == "0.3"
    assert tomllib.loads(f"a = {toml_number(7)}") == {"a": 7.0}
