"""CSV files as rows of checked cells.

Lines that begin with # say what a table is, its units and where it is from; blank lines say nothing. One line is one
row: a cell holds no line break.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from ..errors import FormatError
from ..files import read_bytes, write_whole
from .cells import Cells
from .json_text import number_of_text


class CsvRow(Cells):
    """One row of a CSV file; `line` is its 1-based line."""

    cells: Mapping[str, str]

    def __init__(self, path: Path, cells: Mapping[str, str], line: int) -> None:
        super().__init__(path, cells)
        self.line = line

    def refuse(self, problem: str, name: str | None = None) -> FormatError:
        """The error for one cell, or for the whole row."""
        return FormatError(self.path, problem, line=self.line, column=name)

    def _number(self, name: str) -> object:
        return parsed_number(self.cells.get(name, ""))

    def _numbers(self, name: str) -> object:
        return [parsed_number(word) for word in self.cells.get(name, "").split()]

    def _texts(self, name: str) -> object:
        return self.cells.get(name, "").split()


def table_text(file: Path) -> str:
    """The text of a table's file.

    Raises
    ------
    FormatError : it cannot be read, or is no UTF-8.
    """
    try:
        return read_bytes(file).decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise FormatError(file, "is not UTF-8 text: save it as UTF-8", offset=error.start) from error


def table_lines(file: Path) -> list[tuple[int, str]]:
    """Numbers and texts of a table's lines, the heading first; blank ones and those that begin with # are passed over.

    Raises
    ------
    FormatError : it cannot be read, is no UTF-8, or has no line.
    """
    lines = [(number, line) for number, line in numbered_lines(table_text(file)) if not line.startswith("#")]
    if not lines:
        raise FormatError(file, "is empty: it must begin with a line of column names")
    return lines


def read_csv(path: str | Path, *columns: str) -> list[CsvRow]:
    """The rows of a CSV file, whose heading must have the named columns.

    Raises
    ------
    FormatError : it cannot be read, lacks a column, or a row has a cell too many or too few; names the line.
    """
    file = Path(path)
    lines = table_lines(file)
    heading = split_cells(file, *lines[0])
    for column in columns:
        if column not in heading:
            raise FormatError(
                file, f"lacks a column: it must have {', '.join(columns)}", line=lines[0][0], column=column
            )
    rows = [(number, row_cells(file, len(heading), number, line)) for number, line in lines[1:]]
    return [CsvRow(file, dict(zip(heading, cells, strict=True)), number) for number, cells in rows]


def write_csv(path: str | Path, heading: Sequence[str], rows: Iterable[Sequence[object]]) -> None:
    """Write a CSV file, whole or not at all.

    Raises
    ------
    FormatError : it cannot be written.
    """
    write_whole(path, csv_text(heading, rows))


def csv_text(heading: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """What `write_csv` writes."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(heading)
    writer.writerows(rows)
    return out.getvalue()


def numbered_lines(text: str) -> list[tuple[int, str]]:
    """Lines that say something, with their 1-based numbers; those that editors count, not Unicode's other breaks."""
    plain = text.replace("\r\n", "\n").replace("\r", "\n")
    return [(number, line) for number, line in enumerate(plain.split("\n"), start=1) if line.strip()]


def split_cells(path: Path, number: int, line: str, *, separator: str = ",") -> list[str]:
    """The cells of one line of CSV, without blanks around them.

    Raises
    ------
    FormatError : it is not a line of CSV.
    """
    try:
        return [cell.strip() for cell in next(csv.reader([line], delimiter=separator))]
    except csv.Error as error:
        raise FormatError(path, f"is not a row of a table ({error}): correct or remove it", line=number) from error


def row_cells(path: Path, count: int, number: int, line: str, *, separator: str = ",") -> tuple[str, ...]:
    """The cells of one line, as many as there are columns; a separator at its end parts nothing.

    Raises
    ------
    FormatError : a cell too many or too few.
    """
    cells = split_cells(path, number, line, separator=separator)
    if len(cells) == count + 1 and cells[-1] == "":
        cells.pop()
    if len(cells) != count:
        problem = f"has {len(cells)} cells, but the heading has {count}: is the file cut off here?"
        raise FormatError(path, problem, line=number)
    return tuple(cells)


def parsed_number(text: str) -> int | float | None:
    """The number that a text is, infinite where it is larger than any of use; None where it is none."""
    if "_" in text:  # Python takes 1_000
        return None
    try:
        return number_of_text(text)
    except ValueError:
        return None
