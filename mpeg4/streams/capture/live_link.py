"""ARKit blend shapes in CSV: Live Link Face's recordings, and any table with columns of ARKit's names.

Live Link Face writes ``Timecode`` (HH:MM:SS:FF.fraction), ``BlendShapeCount``, the 52 blend shapes in PascalCase and
nine rotations. Units and signs of the rotations are Unreal's (rad; yaw to the subject's right, pitch up, roll to the
right shoulder) and stand in presets/capture/live_link.toml, for versions of the app differ.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from ....arrays import Floats
from ....errors import FormatError, ParameterError
from ....tables import read_toml
from .columns import arkit_columns
from .samples import Samples
from .shapes import CAPTURE_PRESETS, fap_frame
from .table_file import TableFile
from .times import Times

TIMECODE = re.compile(r"(\d+):(\d{1,2}):(\d{1,2})[:;](\d+(?:\.\d+)?)")

#: Live Link Face's own frame rate, at which the frames of a timecode are counted unless it shows a higher one.
USUAL_RATE = 60.0

#: Columns of time in other tables, with the seconds of one unit; the first that is there counts.
TIME_COLUMNS = (("timestamp", 1.0), ("time", 1.0), ("timestamp_s", 1.0), ("timestamp_ms", 1e-3), ("time_ms", 1e-3))


def holds_arkit(table: TableFile) -> bool:
    """Whether a CSV has columns of ARKit's blend shapes."""
    return any(name in table for name in arkit_columns().gains)


def read_arkit(table: TableFile, *, rate: float | None = None, preset: Path | None = None) -> Samples:
    """The samples of a table of ARKit blend shapes.

    Parameters
    ----------
    rate : frames per second of the recording, in which its timecode counts; None: 60, or what the timecode shows.
    preset : the table of rotations; by default presets/capture/live_link.toml.

    Raises
    ------
    FormatError : no column of a blend shape; a timecode that is none; times that do not rise.
    """
    columns = arkit_columns()
    scores = table.several(name for name in table.columns if name.lower() in columns.gains)
    if not scores:
        raise FormatError(table.path, "has no column of an ARKit blend shape, such as jawOpen", line=1)
    frames = columns.frames(scores)
    turned = _rotations(table, preset or CAPTURE_PRESETS / "live_link.toml")
    frames = np.where(np.isnan(frames), turned, frames)
    times = _times(table, rate)
    return Samples(times.seconds, frames, times.assumed)


def _rotations(table: TableFile, preset: Path) -> Floats:
    """(T, 68) FAPs of the columns of rotations; NaN elsewhere."""
    frames = np.full((len(table.rows), 68), np.nan)
    for name, row in read_toml(preset).tables("rotations").items():
        if name not in table:
            continue
        gains = fap_frame(row)
        values = table.numbers(name)
        for place in np.flatnonzero(~np.isnan(gains)):
            frames[:, place] = values * gains[place]
    return frames


def _times(table: TableFile, rate: float | None) -> Times:
    """Times from the first row on."""
    if rate is not None and not (math.isfinite(rate) and rate > 0.0):
        raise ParameterError("rate", "must be a positive number of frames per second", rate)
    units: Mapping[str, float] = dict(TIME_COLUMNS)
    name = next((name for name in units if name in table), None)
    if "timecode" in table:
        times = _timecodes(table, rate)
    elif name is not None:
        times = Times(table.numbers(name) * units[name])
    else:
        times = Times.even(len(table.rows), rate, USUAL_RATE)
    for row in range(1, len(times.seconds)):
        if not times.seconds[row] > times.seconds[row - 1]:
            problem = "has a time that is not later than the one before: sort the rows by time"
            raise FormatError(table.path, problem, line=table.lines[row])
    return times.from_first()


def _timecodes(table: TableFile, rate: float | None) -> Times:
    """Times of the timecodes."""
    parts = []
    for text, line in zip(table.texts("timecode"), table.lines, strict=True):
        match = TIMECODE.fullmatch(text)
        if match is None:
            problem = f"column Timecode must be HH:MM:SS:FF or HH:MM:SS:FF.fraction, but it is {text[:40]!r}"
            raise FormatError(table.path, problem, line=line)
        parts.append([float(part) for part in match.groups()])
    hours, minutes, seconds, frames = np.array(parts).T
    counted = rate or max(USUAL_RATE, float(np.floor(frames.max())) + 1.0)
    assumed = () if rate is not None else (f"its timecode counts {counted:g} frames per second",)
    return Times(3600.0 * hours + 60.0 * minutes + seconds + frames / counted, assumed)
