"""CSV files as rows: comments and blank lines say nothing, and every row has a cell for each column."""

from __future__ import annotations

from pathlib import Path

import pytest
from risorius.errors import FormatError
from risorius.resources import STANDARD
from risorius.tables import parsed_number, read_csv, write_csv


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "mine.csv"


def test_rows_are_read_by_their_columns(path: Path) -> None:
    path.write_text('# what it is\nfap, reason\n3,"wide, open"\n\n# more\n4,\n', encoding="utf-8-sig")
    rows = read_csv(path, "fap", "reason")
    assert [dict(row.cells) for row in rows] == [{"fap": "3", "reason": "wide, open"}, {"fap": "4", "reason": ""}]
    assert [row.line for row in rows] == [3, 6]
    assert list(rows[0]) == ["fap", "reason"]


def test_a_heading_alone_has_no_rows(path: Path) -> None:
    path.write_text("fap,reason\n")
    assert read_csv(path) == []


@pytest.mark.parametrize(
    ("content", "told"),
    [
        (b"# only a comment\n", "is empty: it must begin with a line of column names"),
        (b"# title\nfap\n3\n", "line 2, column reason: lacks a column: it must have fap, reason"),
        (b"fap,reason\n3\n", "line 2: has 1 cells, but the heading has 2: is the file cut off here?"),
        (b"fap,reason\n3,a,b\n", "line 2: has 3 cells, but the heading has 2"),
        (b"fap,reason\n3,\xff\n", "byte 13: is not UTF-8 text: save it as UTF-8"),
    ],
)
def test_damage_is_refused_with_its_place(path: Path, content: bytes, told: str) -> None:
    path.write_bytes(content)
    with pytest.raises(FormatError) as refused:
        read_csv(path, "fap", "reason")
    assert told in str(refused.value)


def test_a_missing_table_of_ours_is_a_damaged_installation() -> None:
    with pytest.raises(FormatError, match=r"cannot be read .*: install Risorius again"):
        read_csv(STANDARD / "absent.csv")


def test_what_is_written_is_read_back(path: Path) -> None:
    write_csv(path, ["fap", "reason"], [[3, 'wide, "open"'], [4, ""]])
    assert path.read_bytes() == b'fap,reason\n3,"wide, ""open"""\n4,\n'
    assert [(row.integer("fap"), row.text("reason", "")) for row in read_csv(path)] == [(3, 'wide, "open"'), (4, "")]
    with pytest.raises(FormatError, match="cannot be written"):
        write_csv(path / "below", ["fap"], [])


@pytest.mark.parametrize(("text", "number"), [("3", 3), ("-2.5", -2.5), ("1e3", 1000.0), ("1_0", None), ("x", None)])
def test_numbers_are_told_from_texts(text: str, number: float | None) -> None:
    assert parsed_number(text) == number
    assert type(parsed_number(text)) is type(number)
