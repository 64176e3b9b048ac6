"""FAPs as CSV in OpenFace's manner, for statistics: a row per frame, a column per FAP, empty where unknown.

Columns: frame (from 1), timestamp (s), confidence and success (1 where the frame states anything, else 0), then
F03_open_jaw to F68_pull_r_ear in FAP units (1e-5 rad for angles).
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from ....tables import write_csv
from ...standard import FAP_COUNT, FAPS
from ..fap_stream import FapStream
from .faces import one_face
from .row_names import tells_of_a_row
from .samples import Samples
from .scores import unread_words
from .stamps import table_times
from .table_file import TableFile

COLUMNS = {number: f"F{number:02d}_{fap.name}" for number, fap in FAPS.items() if not fap.high_level}


def write_fap_csv(path: str | Path, stream: FapStream) -> None:
    """Write a stream as CSV, whole or not at all; FAP 1 and 2 are expanded to the FAPs that they stand for.

    Raises
    ------
    FormatError : the file cannot be written.

    Examples
    --------
    >>> api.write_fap_csv("still.csv", api.FapStream(np.zeros((3, 68)), fps=25.0))
    >>> api.read_stream("still.csv").fps
    25.0
    """
    rows = []
    for index, values in enumerate(stream.expanded()):
        known = int(not np.isnan(values).all())
        cells = ["" if np.isnan(values[n - 1]) else f"{values[n - 1]:.6g}" for n in COLUMNS]
        rows.append([index + 1, f"{index / stream.fps:.6f}", known, known, *cells])
    write_csv(path, ["frame", "timestamp", "confidence", "success", *COLUMNS.values()], rows)


def holds_faps(table: TableFile) -> bool:
    """Whether a CSV has columns of FAPs."""
    return any(name in table for name in COLUMNS.values())


def read_fap_csv(
    table: TableFile, *, rate: float | None = None, start: float | str | None = None, face: int | None = None
) -> Samples:
    """The samples of a CSV of FAPs.

    Raises
    ------
    FormatError : a cell that is no number, or times that do not rise.
    """
    table = one_face(table, face)
    frames = np.full((len(table.rows), FAP_COUNT), np.nan)
    for number, name in COLUMNS.items():
        if name in table:
            frames[:, number - 1] = table.numbers(name)
    times = table_times(table, rate)
    others = [name for name in table.columns if name not in COLUMNS.values() and not tells_of_a_row(name)]
    said = (*times.assumed, *unread_words(others))
    return Samples.at_times(replace(times, assumed=said), frames[times.rows], start=start)
