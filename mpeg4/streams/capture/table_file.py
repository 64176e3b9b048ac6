"""CSV files of trackers: one row per sample, one column per quantity."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from ....arrays import Floats, Ints
from ....errors import FormatError
from ....files import read_bytes
from ....tables import numbered_lines, parsed_number, row_cells, split_cells
from .row_names import tells_of_a_row

#: What trackers write for "no value".
UNKNOWN = ("", "nan", "na", "none", "null", "-nan", "-nan(ind)", "inf", "-inf")


@dataclass(frozen=True)
class TableFile:
    """A CSV file as text.

    Attributes
    ----------
    path : the file. columns : names as in the heading, without blanks around them.
    rows : cells of each row, as many as there are columns. lines : 1-based line of each row.
    """

    path: Path
    columns: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    lines: tuple[int, ...]

    def __contains__(self, name: str) -> bool:
        return name.lower() in self._places

    def only(self, rows: Ints) -> TableFile:
        """The table with some of its rows."""
        if len(rows) == len(self.rows):
            return self
        chosen = [(self.rows[row], self.lines[row]) for row in rows]
        return TableFile(self.path, self.columns, tuple(row for row, _ in chosen), tuple(line for _, line in chosen))

    @cached_property
    def _places(self) -> dict[str, int]:
        """Column by lower-case name; the first of equal names."""
        return {name.lower(): place for place, name in reversed(list(enumerate(self.columns)))}

    def texts(self, name: str) -> list[str]:
        """The cells of one column.

        Raises
        ------
        FormatError : no such column.
        """
        place = self._places.get(name.lower())
        if place is None:
            raise FormatError(self.path, f"has no column {name}: is this the right file?", line=1)
        return [row[place] for row in self.rows]

    def numbers(self, name: str) -> Floats:
        """(T,) values of one column; NaN where the tracker wrote none.

        Raises
        ------
        FormatError : no such column, or a cell that is no number: names line and column.
        """
        return np.array([self._number(name, text, row) for row, text in enumerate(self.texts(name))])

    def _number(self, name: str, text: str, row: int) -> float:
        """One cell."""
        if text.lower() in UNKNOWN:
            return math.nan
        value = parsed_number(text)
        if value is None or not math.isfinite(value):
            problem = f"must be a number, but it is {text[:40]!r}"
            raise FormatError(self.path, problem, line=self.lines[row], column=name)
        return float(value)

    def several(self, names: Iterable[str]) -> dict[str, Floats]:
        """Those of the named columns that the file has."""
        return {name: self.numbers(name) for name in names if name in self}


def read_table_file(path: str | Path) -> TableFile:
    """A CSV file (comma, semicolon or tab; UTF-8 or Latin-1), with its heading in the first line that says something.

    Raises
    ------
    FormatError : names the file, the line and the remedy.
    """
    file = Path(path)
    lines = numbered_lines(_text(file))
    if not lines:
        raise FormatError(file, "is empty: it must begin with a line of column names")
    if len(lines) == 1:
        raise FormatError(file, "has a heading but no rows: nothing was recorded")
    mark = max(",;\t", key=lines[0][1].count)
    columns = tuple(split_cells(file, *lines[0], separator=mark))
    rows = tuple(_row(file, columns, *line, separator=mark) for line in lines[1:])
    return TableFile(file, columns, rows, tuple(number for number, _ in lines[1:]))


def _row(file: Path, columns: tuple[str, ...], number: int, line: str, *, separator: str) -> tuple[str, ...]:
    """The cells of one line; a line that ends before anything that was seen in its frame, states nothing of that."""
    cells = split_cells(file, number, line, separator=separator)
    stated = sum(1 for cell in cells if cell)
    if len(cells) < len(columns) and stated and all(tells_of_a_row(name) for name in columns[: len(cells)]):
        return (*cells, *[""] * (len(columns) - len(cells)))
    return row_cells(file, len(columns), number, line, separator=separator)


def _text(file: Path) -> str:
    """The file's text."""
    data = read_bytes(file)
    if b"\0" in data:
        raise FormatError(file, "is binary, not a CSV file", offset=data.index(b"\0"))
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("latin-1")
