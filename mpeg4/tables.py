"""The CSV tables beside this file: one reader, so that every table is written and refused in the same way."""

from __future__ import annotations

import csv
from pathlib import Path

from ..errors import FormatError

DATA = Path(__file__).resolve().parent / "data"


def read_table(name: str) -> list[dict[str, str]]:
    """Rows of ``data/<name>.csv`` by column name.

    Lines that start with ``#`` are the table's heading (what it is, its unit, its source) and are skipped.

    Raises
    ------
    FormatError
        When the file is missing (a damaged installation) or a row has a cell too many or too few.
    """
    path = DATA / f"{name}.csv"
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except OSError as error:
        raise FormatError(path, f"cannot be read ({error.strerror}): install Risorius again") from error
    numbers = [number for number, line in enumerate(lines, start=1) if line and not line.startswith("#")]
    cells = list(csv.reader(lines[number - 1] for number in numbers))
    columns = cells[0]
    for number, row in zip(numbers, cells, strict=True):
        if len(row) != len(columns):
            raise FormatError(path, f"has {len(row)} cells where the heading has {len(columns)}", line=number)
    return [dict(zip(columns, row, strict=True)) for row in cells[1:]]
