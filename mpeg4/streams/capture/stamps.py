"""When the rows of a table are, as its columns say."""

from __future__ import annotations

import math
from functools import partial

import numpy as np

from ....arrays import Floats
from ....errors import FormatError
from .row_names import IMAGE_NAMES, INDEX_NAMES, NUMBER_NAMES, RATE_NAMES, first_named, numbers_at_end, time_named
from .table_file import TableFile
from .timecode import date_seconds, is_timecode, timecode_stamps
from .times import Stamps, Times, placed


def table_times(table: TableFile, rate: float | None = None) -> Times:
    """When the rows of a table are, by any habit of naming that.

    Raises
    ------
    FormatError : a time that is none, or not later than the one before; names line and column.
    ParameterError : the rate.
    """
    return placed(table_stamps(table, rate), rate)


def table_stamps(table: TableFile, rate: float | None = None) -> Stamps:
    """What the columns of a table say of when its rows are."""
    named = time_named(table.columns)
    numbers = _numbers(table)
    if named is None:
        column = first_named(table.columns, (*NUMBER_NAMES, *INDEX_NAMES)) or ""
        refuse = partial(_refuse, table, column)
        return Stamps(len(table.rows), numbers=numbers, counted=_rate_beside(table), refuse=refuse)
    column, unit = named
    refuse, texts = partial(_refuse, table, column), table.texts(column)
    if any(is_timecode(text) for text in texts):
        return timecode_stamps(texts, rate, refuse)
    dates = [date_seconds(text) if "-" in text[1:] and ":" in text else None for text in texts]
    if any(date is not None for date in dates):
        seconds = np.array([math.nan if date is None else date for date in dates])
        return Stamps(len(texts), seconds=seconds, unit=1.0, numbers=numbers, refuse=refuse)
    return Stamps(len(texts), seconds=table.numbers(column), unit=unit, numbers=numbers, refuse=refuse)


def _rate_beside(table: TableFile) -> float | None:
    """The rate that a column states, the same in every row; None where none does."""
    name = first_named(table.columns, RATE_NAMES)
    stated = np.unique(table.numbers(name)) if name is not None else np.zeros(0)
    return float(stated[0]) if len(stated) == 1 and stated[0] > 0.0 else None


def _numbers(table: TableFile) -> Floats | None:
    """(T,) numbers of the rows' frames; None where there are none, or they are no numbers that rise."""
    name = first_named(table.columns, NUMBER_NAMES)
    if name is not None:
        named = numbers_at_end(table.texts(name))
        return table.numbers(name) if named is None else np.array(named)
    name = first_named(table.columns, (*INDEX_NAMES, *IMAGE_NAMES))
    if name is None:
        return None
    named = numbers_at_end(table.texts(name))
    try:
        numbers = table.numbers(name) if named is None else np.array(named)
    except FormatError:
        return None
    return numbers if (np.diff(numbers) > 0.0).all() else None


def _refuse(table: TableFile, column: str, row: int, problem: str) -> FormatError:
    """The error for the time of one row."""
    line = table.lines[row] if row < len(table.lines) else None
    return FormatError(table.path, problem, line=line, column=column or None)
