"""Text with columns, as programs of all countries write it: which mark parts the cells, which one the decimals.

Spreadsheets of many countries write ``0,98;1`` for ``0.98,1``; some say ``sep=;`` in the first line, put every cell or
every line in quotes, or end lines with empty cells.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Sequence
from pathlib import Path

from ....errors import FormatError
from ....files import read_bytes
from ....tables import numbered_lines, split_cells

#: Marks between cells; the first of equals counts.
MARKS = (",", ";", "\t", "|")

#: Lines that are looked at to tell the marks.
TRIED = 20

SEPARATOR_LINE = re.compile(r"(\"?)sep=(.)\1[\s,;]*", re.IGNORECASE)
DECIMAL_COMMA = re.compile(r"[+-]?\d*,\d+(?:[eE][+-]?\d+)?")
THOUSANDS = re.compile(r"[1-9]\d{0,2}(?:\.\d{3})+")
DECIMAL_POINT = re.compile(r"[+-]?\d*\.\d+(?:[eE][+-]?\d+)?")

Line = tuple[int, str]


def decoded(data: bytes) -> str | None:
    """Text in UTF-8 or UTF-16, with or without a byte order mark; None where it is neither."""
    marked = data[:2] in (b"\xff\xfe", b"\xfe\xff")
    unmarked = len(data) > 3 and data[0] > 0 and data[2] > 0 and data[1] == data[3] == 0  # plain letters
    try:
        return data.decode("utf-16" if marked else "utf-16-le" if unmarked else "utf-8-sig")
    except UnicodeDecodeError:
        return None


def read_text(file: Path) -> str:
    """A file's text: UTF-8 or UTF-16 with or without a byte order mark, else Latin-1.

    Raises
    ------
    FormatError : it cannot be read, or is binary.
    """
    data = read_bytes(file)
    text = decoded(data)
    text = data.decode("latin-1") if text is None else text
    if "\0" in text:
        raise FormatError(file, "is binary, not a CSV file", offset=max(data.find(b"\0"), 0))
    return text


def lines_and_mark(text: str) -> tuple[list[Line], str]:
    """The lines that say something, with their numbers, and the mark between their cells."""
    lines = numbered_lines(text)
    lines = lines[_remarks(lines) :]
    said = SEPARATOR_LINE.fullmatch(lines[0][1]) if lines else None
    if said is not None:
        return lines[1:], said[2]
    tried = [line for _, line in lines[:TRIED]]
    lines = _unwrapped(lines) if tried and all(_is_wrapped(line) for line in tried) else lines
    return lines, max(MARKS, key=lambda mark: _parted([line for _, line in lines[:TRIED]], mark))


def _remarks(lines: Sequence[Line]) -> int:
    """How many lines above the heading are remarks: no cells, where the first line of cells has names in them."""
    cells = [max(len(re.split(re.escape(mark), line)) for mark in MARKS) for _, line in lines[:TRIED]]
    starts = next(
        (place for place, (_, line) in enumerate(lines[:TRIED]) if cells[place] > 1 and not line.startswith("#")), 0
    )
    if any(SEPARATOR_LINE.fullmatch(line) for _, line in lines[:starts]):
        return 0
    names = [cell.strip(' "') for cell in re.split(r"[,;\t|]", lines[starts][1])] if lines else []
    return starts if 2 * sum(bool(re.match(r"[A-Za-z]", name)) for name in names) >= len(names) else 0


def _parted(lines: Sequence[str], mark: str) -> tuple[int, int]:
    """How well a mark parts lines: the columns of the heading, where other lines have as many; how often it stands."""
    try:
        counts = [len(row) for row in csv.reader(lines, delimiter=mark)]
    except csv.Error:
        return 0, 0
    if not counts:
        return 0, 0
    agree = sum(abs(count - counts[0]) <= 1 for count in counts[1:])
    return (counts[0] if 2 * agree >= len(counts) - 1 else 1), counts[0]


def _is_wrapped(line: str) -> bool:
    """Whether a whole line stands in quotes, with its cells inside."""
    line = line.strip()
    try:
        cells = next(csv.reader([line]), [])
    except csv.Error:
        return False
    return line.startswith('"') and len(cells) == 1 and any(mark in cells[0] for mark in MARKS)


def _unwrapped(lines: Sequence[Line]) -> list[Line]:
    """Lines without the quotes around them."""
    return [(number, next(csv.reader([line.strip()]))[0]) for number, line in lines]


def cells_of(file: Path, lines: Sequence[Line], mark: str) -> list[tuple[int, list[str]]]:
    """The cells of lines, without empty ones at the end of all of them."""
    rows = [(number, split_cells(file, number, line, separator=mark)) for number, line in lines]
    while len(rows[0][1]) > 1 and rows[0][1][-1] == "" and all(_ends_empty(row, len(rows[0][1])) for _, row in rows):
        rows[0][1].pop()
        for _, row in rows[1:]:
            del row[len(rows[0][1]) :]
    return rows


def _ends_empty(row: Sequence[str], count: int) -> bool:
    """Whether a row has nothing from a column on."""
    return not any(row[count - 1 :])


def has_decimal_commas(rows: Sequence[Sequence[str]]) -> bool:
    """Whether cells have commas before their decimals: some do, and none has a point there, but after thousands."""
    cells = [cell for row in rows[: 10 * TRIED] for cell in row]
    commas = any(DECIMAL_COMMA.fullmatch(cell) for cell in cells)
    return commas and not any(DECIMAL_POINT.fullmatch(cell) and not THOUSANDS.fullmatch(cell) for cell in cells)
