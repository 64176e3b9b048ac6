"""Values of controls over time as CSV: what an engine, or a script of your own, plays on a face with these keys."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from ...errors import ParameterError
from ...mpeg4 import check_fps
from ...tables import write_csv


def write_weight_csv(path: str | Path, names: Sequence[str], values: ArrayLike, *, fps: float) -> None:
    """Write values of controls as CSV, whole or not at all: a row per frame, with frame (from 1), timestamp (s), names.

    Names of ARKit's blend shapes make it a recording that every reader of such takes, `read_stream` among them.

    Parameters
    ----------
    names, values : K names and (T, K) numbers, such as `Retargeted.names` and `Retargeted.values`.
    fps : frames per second.

    Raises
    ------
    ParameterError : as many names as columns are needed, finite numbers, and a frame rate above 0.
    FormatError : the file cannot be written.

    Examples
    --------
    >>> api.write_weight_csv("take.csv", ["jawOpen", "eyeBlinkLeft"], [[0.0, 0.0], [0.5, 1.0]], fps=25.0)
    >>> round(float(api.read_stream("take.csv").frames[1, 2]) / 100.0) > 0  # open_jaw
    True
    """
    table = np.asarray(values, dtype=np.float64)
    if table.ndim != 2 or table.shape[1] != len(names) or not np.isfinite(table).all():
        raise ParameterError("values", f"must be finite (frames, {len(names)})", table.shape)
    check_fps(fps)
    rows = [[i + 1, f"{i / fps:.6f}", *(f"{value:.6g}" for value in row)] for i, row in enumerate(table)]
    write_csv(path, ["frame", "timestamp", *names], rows)
