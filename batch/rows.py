"""The rows of a table of jobs as spreadsheets, programs and people write them: CSV and TOML."""

from __future__ import annotations

import contextlib
import csv
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeAlias

from ..errors import FormatError
from ..files import read_bytes
from ..tables import Cells, CsvRow, TomlTable, numbered_lines, parsed_number, read_toml, split_cells, table_text
from .columns import BY_NAME, Kind

#: The most lines that one row may have: a quotation mark that nothing closes must not swallow the rows after it.
LONGEST = 50
#: What Excel writes above a table to say what parts its cells.
SAYS_SEPARATOR = re.compile(r"sep=(.)", re.IGNORECASE)
#: A number of the countries in which semicolons part cells.
DECIMAL_COMMA = re.compile(r"[-+]?\d*,\d+")
#: A colour in a first cell, which is no comment.
COLOUR = re.compile(r"#[0-9a-fA-F]{6}\b")
#: Characters of a stray cell that a message shows.
SHOWN = 40

#: Number and text of a line.
Line: TypeAlias = tuple[int, str]


@dataclass(frozen=True, eq=False)
class Row:
    """One row: where it stands, for people, its cells, and the names of those that a table says for all rows."""

    place: str
    cells: Cells
    shared: frozenset[str] = frozenset()


class _CsvRow(CsvRow):
    """A row of a table in which a comma is a decimal one where it does not part cells."""

    def __init__(self, path: Path, cells: Mapping[str, str], line: int, *, decimal_comma: bool) -> None:
        super().__init__(path, cells, line)
        self._decimal_comma = decimal_comma

    def _number(self, name: str) -> object:
        text = self.cells.get(name, "")
        if self._decimal_comma and DECIMAL_COMMA.fullmatch(text):
            text = text.replace(",", ".")
        return parsed_number(text)


class _Placed(TomlTable):
    """One job of a TOML file, that knows its line."""

    line: int | None = None

    def refuse(self, problem: str, name: str | None = None) -> FormatError:
        """The error for one cell, or for the whole job."""
        error = super().refuse(problem, name)
        return FormatError(self.path, problem, line=self.line, key=error.key)


def csv_rows(file: Path, problems: list[FormatError]) -> Iterator[Row]:
    """The rows of a CSV file; a line that is no row is a problem of its own.

    Raises
    ------
    FormatError : it cannot be read, or its heading is wrong.
    """
    lines = numbered_lines(table_text(file))
    separator, lines = _begun(file, lines)
    heading = _heading(file, *lines[0], separator)
    coloured = heading[0] in BY_NAME and BY_NAME[heading[0]].kind is Kind.COLOUR
    at = 1
    while at < len(lines):
        number, line = lines[at]
        taken = 1
        if not _is_comment(line, coloured=coloured):
            try:
                cells, taken = _row_at(file, lines[at : at + LONGEST], len(heading), separator)
                if taken > 1:
                    problem = f"goes on to line {lines[at + taken - 1][0]} in quotation marks: write it in one line"
                    raise FormatError(file, problem, line=number)
                row = _cells_of(file, heading, cells, number, separator)
            except FormatError as error:
                problems.append(error)
            else:
                if any(cells):
                    yield Row(f"line {number}", row)
        at += taken


def _begun(file: Path, lines: list[Line]) -> tuple[str, list[Line]]:
    """What parts the cells, and the lines from the heading on."""
    said = SAYS_SEPARATOR.fullmatch(lines[0][1].strip()) if lines else None
    rest = lines[1:] if said else lines
    while rest and _is_comment(rest[0][1]):
        rest = rest[1:]
    if not rest:
        raise FormatError(file, "is empty: it must begin with a line of column names")
    return said[1] if said else max((",", ";", "\t"), key=rest[0][1].count), rest


def _is_comment(line: str, *, coloured: bool = False) -> bool:
    """Whether a line says nothing, since it begins with #; `coloured`: a colour is no comment."""
    begin = line.lstrip(' "')
    return begin.startswith("#") and not (coloured and COLOUR.match(begin))


def _heading(file: Path, number: int, line: str, separator: str) -> list[str]:
    """Names of the columns, in small letters; an empty one has no name.

    Raises
    ------
    FormatError : a column is unknown, or stands there twice.
    """
    said = split_cells(file, number, line, separator=separator)
    heading = [re.sub(r"[\s-]+", "_", name.lower()) for name in said]
    named = [name for name in heading if name]
    CsvRow(file, dict.fromkeys(named, ""), number).only(*BY_NAME)
    for name in named:
        if named.count(name) > 1:
            raise FormatError(file, "stands twice in the heading: keep one", line=number, column=name)
    if not named:
        raise FormatError(file, "must begin with a line of column names", line=number)
    return heading


def _row_at(file: Path, lines: Sequence[Line], count: int, separator: str) -> tuple[list[str], int]:
    """The cells of the row with which some lines begin, and how many of them it has: a cell in quotation marks may go
    over several."""
    taken = 0

    def feed() -> Iterator[str]:
        nonlocal taken
        for _, line in lines:
            taken += 1
            yield f"{line}\n"

    number, first = lines[0]
    with contextlib.suppress(csv.Error):
        cells = [cell.strip() for cell in next(csv.reader(feed(), delimiter=separator, strict=True))]
        if taken == 1 or len(cells) == count:
            return cells, taken
    if taken > 1:
        raise FormatError(file, "has a quotation mark that nothing closes: close or remove it", line=number)
    return split_cells(file, number, first, separator=separator), 1


def _cells_of(file: Path, heading: Sequence[str], cells: list[str], number: int, separator: str) -> CsvRow:
    """A row under its heading. Cells beyond it, and those under no name, must be empty.

    Raises
    ------
    FormatError : a cell too few, or something in a column without a name.
    """
    if len(cells) < len(heading):
        problem = f"has {len(cells)} cells, but the heading has {len(heading)}: is the file cut off here?"
        raise FormatError(file, problem, line=number)
    if any(cells[len(heading) :]):
        problem = f"has {len(cells)} cells, but the heading has {len(heading)}: "
        raise FormatError(file, problem + f"put a text with {separator!r} into quotation marks", line=number)
    for place, (name, cell) in enumerate(zip(heading, cells, strict=False), start=1):
        if cell and not name:
            problem = f"has {cell[:SHOWN]!r} in column {place}, which has no name: name that column, or empty it"
            raise FormatError(file, problem, line=number)
    named = {name: cell for name, cell in zip(heading, cells, strict=False) if name}
    return _CsvRow(file, named, number, decimal_comma=separator != ",")


def toml_rows(file: Path, problems: list[FormatError]) -> Iterator[Row]:
    """The jobs of a TOML file, with what its [defaults] say; one with an unknown key is a problem of its own.

    Raises
    ------
    FormatError : it cannot be read, or its [defaults] are wrong.
    """
    whole = read_toml(file)
    whole.only("defaults", "jobs")
    shared = whole.table("defaults", optional=True)
    shared.only(*(name for name in BY_NAME if name != "id"))
    entries = whole.listed("jobs")
    text = read_bytes(file).decode("utf-8-sig")
    lines = [number for number, line in numbered_lines(text) if re.match(r"\s*\[\[\s*jobs\s*\]\]", line)]
    for number, entry in enumerate(entries):
        row = _Placed(file, {**shared.cells, **entry.cells}, entry.key)
        row.line = lines[number] if len(lines) == len(entries) else None
        place = f"line {row.line}" if row.line else f"job {number + 1}"
        try:
            row.only(*BY_NAME)
        except FormatError as error:
            problems.append(error)
            continue
        yield Row(place, row, frozenset(shared.cells) - frozenset(entry.cells))
