"""CSV files of trackers: one row per sample, one column per quantity."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np

from ....arrays import Floats, Ints
from ....errors import FormatError
from ....tables import parsed_number
from .delimited import cells_of, has_decimal_commas, lines_and_mark, read_text
from .row_names import tells_of_a_row

#: What trackers write for "no value".
UNKNOWN = ("", "nan", "na", "n/a", "none", "null", "-nan", "-nan(ind)", "inf", "-inf")

#: What they write for "it is so" and "it is not".
WORDS = {"true": 1.0, "false": 0.0}


@dataclass(frozen=True)
class TableFile:
    """A CSV file as text.

    Attributes
    ----------
    path : the file. columns : names as in the heading, without blanks around them.
    rows : cells of each row, as many as there are columns. lines : 1-based line of each row.
    decimal_commas : whether numbers have commas before their decimals.
    per_cent : whether scores are known to go from 0 to 100, however small they are.
    """

    path: Path
    columns: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    lines: tuple[int, ...]
    decimal_commas: bool = False
    per_cent: bool = False

    def __contains__(self, name: str) -> bool:
        return name.lower() in self._places

    def only(self, rows: Ints) -> TableFile:
        """The table with some of its rows."""
        if len(rows) == len(self.rows):
            return self
        chosen = [(self.rows[row], self.lines[row]) for row in rows]
        return replace(self, rows=tuple(row for row, _ in chosen), lines=tuple(line for _, line in chosen))

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
        if text.lower() in WORDS:
            return WORDS[text.lower()]
        share = 0.01 if text.endswith("%") else 1.0
        text = text.rstrip(" %")
        value = parsed_number(text.replace(".", "").replace(",", ".") if self.decimal_commas else text)
        if value is None or not math.isfinite(value):
            problem = f"must be a number, but it is {text[:40]!r}"
            raise FormatError(self.path, problem, line=self.lines[row], column=name)
        return float(value) * share

    def refusal(self, row: int, name: str, problem: str) -> FormatError:
        """The error for one cell."""
        return FormatError(self.path, problem, line=self.lines[row], column=name)

    def several(self, names: Iterable[str]) -> dict[str, Floats]:
        """Those of the named columns that the file has."""
        return {name: self.numbers(name) for name in names if name in self}


def read_table_file(path: str | Path) -> TableFile:
    """A table as text, with its heading in the first line that says something; see `delimited`.

    Raises
    ------
    FormatError : names the file, the line and the remedy.
    """
    file = Path(path)
    lines, mark = lines_and_mark(read_text(file))
    if not lines:
        raise FormatError(file, "is empty: it must begin with a line of column names")
    if len(lines) == 1:
        raise FormatError(file, "has a heading but no rows: nothing was recorded")
    (_, heading), *others = cells_of(file, lines, mark)
    others = [(number, cells) for number, cells in others if cells != heading]  # a logger that began anew writes it
    rows = tuple(_row(file, tuple(heading), number, cells) for number, cells in others)
    return TableFile(file, _told_apart(heading), rows, tuple(number for number, _ in others), has_decimal_commas(rows))


def _told_apart(heading: list[str]) -> tuple[str, ...]:
    """Names of columns; of one that is there twice, the second has a number, so that it is not lost in silence."""
    seen: Counter[str] = Counter()
    told = []
    for name in heading:
        seen[name] += 1
        told.append(f"{name} ({seen[name]})" if name and seen[name] > 1 else name)
    return tuple(told)


def _row(file: Path, columns: tuple[str, ...], number: int, cells: list[str]) -> tuple[str, ...]:
    """As many cells as there are columns; a row that ends before all that was seen in its frame states none of it."""
    count = len(columns)
    while len(cells) > count and cells[-1] == "":
        cells.pop()
    if len(cells) < count and any(cells) and all(tells_of_a_row(name) for name in columns[: len(cells)]):
        return (*cells, *[""] * (count - len(cells)))
    if len(cells) == count:
        return tuple(cells)
    if len(cells) >= 2 * count - 1 and count > 1:
        remedy = "if decimals have commas, separate the columns with semicolons"
    else:
        remedy = "is the file cut off here? Remove this line to read the rest"
    raise FormatError(file, f"has {len(cells)} cells, but the heading has {count}: {remedy}", line=number)
