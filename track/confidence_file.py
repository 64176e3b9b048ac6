"""How sure tracked values are, as a table beside the stream: what `recognise --confidence` weighs by."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from ..arrays import Floats
from ..errors import FormatError
from ..mpeg4 import FAP_COUNT
from ..tables import read_csv, write_csv

COLUMNS = tuple(f"F{number}" for number in range(1, FAP_COUNT + 1))

#: The first cell of rows that hold a way in which the neutral face may be wrong.
DOUBT = "doubt"


def write_confidence(path: str | Path, confidence: Floats, doubt: Floats) -> None:
    """Write a row per frame, a column per FAP; then a row for each way in which the neutral face may be wrong.

    Parameters
    ----------
    confidence : (T, 68) 0..1. doubt : (68, m) FAP units; see `Track.doubt`.

    Raises
    ------
    FormatError : the file cannot be written.
    """
    rows: list[Sequence[object]] = [[index, *(f"{value:.3f}" for value in row)] for index, row in enumerate(confidence)]
    rows += [[DOUBT, *(f"{value:.2f}" for value in column)] for column in doubt.T]
    write_csv(path, ["frame", *COLUMNS], rows)


def read_confidence(path: str | Path) -> tuple[Floats, Floats | None]:
    """(T, 68) confidence and (68, m) doubt, None where the neutral face is the person's own.

    Raises
    ------
    FormatError : no such table; names row and rule.
    """
    frames, modes = [], []
    for row in read_csv(Path(path), "frame", *COLUMNS):
        if row.text("frame") == DOUBT:
            modes.append([row.number(name) for name in COLUMNS])
        else:
            frames.append([row.number(name, least=0.0, most=1.0) for name in COLUMNS])
    if not frames:
        raise FormatError(path, "has no frames: write it with `risorius track --confidence`")
    return np.array(frames), np.array(modes).T if modes else None
