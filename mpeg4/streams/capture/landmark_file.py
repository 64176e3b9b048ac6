"""Landmarks of a face mesh tracker (MediaPipe's 468, or 478 with irises), JSON or CSV.

JSON: as `json_file`, each landmark an object with x, y and z, or a list of three numbers. CSV: wide (a row per frame,
columns x_0, y_0, z_0, x_1, ... or 0_x, ..., with or without the underscore) or long (a row per landmark, columns frame,
landmark or index, x, y, z).
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import Any

import numpy as np

from ....arrays import Floats, Ints
from ....errors import FormatError, ParameterError
from .faces import name_of_frames, one_face
from .json_file import JsonFrame, chosen_face, json_times, of_one_face
from .rates import usual_rate
from .row_names import FACE_NAMES, first_named
from .stamps import table_times
from .table_file import TableFile
from .times import USUAL_RATE, Times

#: Landmarks beyond this are in pixels; within it they are shares of the picture (a face may stick out a little).
NORMALISED = 4.0

COLUMN = re.compile(
    r"(?:.*[_\W]|lm|pt|point|landmark)?(?:([xyz])[_\W]?(\d{1,5})\W?|(\d{1,5})\W?[_.]?([xyz]))", re.IGNORECASE
)
INDEX_NAMES = (
    "landmark", "landmark_id", "landmark_index", "landmark_idx", "point", "point_id", "keypoint", "vertex", "index",
    "id",
)  # fmt: skip
FEWEST, MOST, MOST_FACES = 468, 1000, 16


@dataclass(frozen=True, eq=False)
class Landmarks:
    """Landmarks over time.

    Attributes
    ----------
    times : (T,) seconds, rising.
    positions : (T, N, 3) to the right of the picture (the left of a subject who faces it), up, and towards the camera;
        the picture's height is 1, or it is in pixels. NaN where no face was seen.
    rows : what a file says of when they are; None where they are of no file.
    """

    times: Floats
    positions: Floats
    rows: Times | None = None

    @property
    def rate(self) -> float:
        """Frames per second: as the file says, else the usual rate of the times."""
        if self.rows is not None:
            return self.rows.rate
        return usual_rate(np.diff(self.times)) if len(self.times) > 1 else USUAL_RATE


def landmarks_from_json(
    frames: list[JsonFrame], *, aspect: float = 16.0 / 9.0, rate: float | None = None, face: int | None = None
) -> Landmarks:
    """The landmarks of a JSON file.

    Parameters
    ----------
    aspect : the picture's width over its height; x and z of MediaPipe are shares of the width.
    rate : frames per second, where the file says no times; None: 30.

    Raises
    ------
    FormatError : no landmarks; an entry that is none: names the frame and the landmark.
    """
    frames, face = of_one_face(frames, face)
    faces = [_faces(frame) for frame in frames]
    chosen = chosen_face(frames, [len(found) for found in faces], face)
    listed = [
        _listed(frame, found[chosen]) if chosen < len(found) else [] for frame, found in zip(frames, faces, strict=True)
    ]
    count = max((len(entries) for entries in listed), default=0)
    if count < FEWEST:
        problem = f"has {count} landmarks per frame, but a face mesh has {FEWEST} or more: is this the right file?"
        raise FormatError(frames[0].path, problem)
    if count > MOST:
        raise FormatError(frames[0].path, f"has {count} landmarks in one frame: keep one face")
    raw = np.full((len(frames), count, 3), np.nan)
    for frame, entries, row in zip(frames, listed, raw, strict=True):
        if entries and len(entries) != count:
            raise frame.refuse("landmarks", f"must be {count} as in other frames, but they are {len(entries)}")
        for number, entry in enumerate(entries):
            row[number] = _position(frame, number, entry)
    times = json_times(frames, rate)
    return Landmarks(times.seconds, _upright(raw, aspect)[times.rows], times)


def _faces(frame: JsonFrame) -> list[Any]:
    """The landmarks of each face of a frame; none where no face was seen."""
    found = frame.entry("landmarks")
    while isinstance(found, list) and len(found) == 1:
        found = found[0]
    if found is None:
        return []
    if isinstance(found, list) and len(found) <= MOST_FACES and all(_is_face(face) for face in found):
        return found
    return [found]


def _is_face(value: Any) -> bool:
    """Whether a value is the landmarks of one face of several."""
    if isinstance(value, dict):
        value = value.get("landmark", value.get("landmarks"))
    return isinstance(value, list) and len(value) >= FEWEST


def _listed(frame: JsonFrame, found: Any) -> list[Any]:
    """The landmarks of one face."""
    while isinstance(found, list) and len(found) == 1:
        found = found[0]
    if isinstance(found, dict):
        found = found.get("landmark", found.get("landmarks"))
    if not isinstance(found, list):
        raise frame.refuse("landmarks", "must be a list")
    if len(found) >= 3 * FEWEST and len(found) % 3 == 0 and all(isinstance(value, int | float) for value in found):
        return [found[place : place + 3] for place in range(0, len(found), 3)]
    return found


def _position(frame: JsonFrame, number: int, entry: Any) -> tuple[float, ...]:
    """x, y and z of one landmark."""
    if isinstance(entry, dict) and all(axis in entry for axis in "xyz"):
        values = [entry[axis] for axis in "xyz"]
    elif isinstance(entry, list) and len(entry) >= 3:
        values = entry[:3]
    else:
        raise frame.refuse(f"landmark {number}", f"must have x, y and z, but it is {str(entry)[:40]!r}")
    return tuple(frame.number_at(f"landmark {number}", value) for value in values)


def holds_landmarks(table: TableFile) -> bool:
    """Whether a CSV looks like landmarks."""
    return _is_long(table) or len(_wide_columns(table)) >= 2 * FEWEST


def landmarks_from_csv(
    table: TableFile, *, aspect: float = 16.0 / 9.0, rate: float | None = None, face: int | None = None
) -> Landmarks:
    """The landmarks of a CSV file; parameters and errors as `landmarks_from_json`."""
    if _is_long(table):
        table, raw, first = _long(table, face)
    else:
        table = one_face(table, face)
        raw, first = _wide(table), np.arange(len(table.rows))
    times = table_times(table.only(first), rate)
    return Landmarks(times.seconds, _upright(raw, aspect)[times.rows], times)


def _wide_columns(table: TableFile) -> dict[tuple[int, int], str]:
    """(landmark, axis) -> column."""
    found = {}
    for name in table.columns:
        match = COLUMN.fullmatch(name)
        if match is not None:
            axis, number = (match[1], match[2]) if match[1] else (match[4], match[3])
            found[int(number), "xyz".index(axis.lower())] = name
    return found


def _wide(table: TableFile) -> Floats:
    """(T, N, 3) landmarks of a table with a row per frame."""
    columns = _wide_columns(table)
    numbers = sorted({number for number, _ in columns})
    if numbers and numbers[0] == 1:  # counted from 1
        columns = {(number - 1, axis): name for (number, axis), name in columns.items()}
        numbers = [number - 1 for number in numbers]
    if len(numbers) < FEWEST or numbers != list(range(len(numbers))):
        problem = f"must have columns x_0, y_0, z_0 to x_{FEWEST - 1}, ..., but it has {len(numbers)} landmarks"
        raise FormatError(table.path, problem, line=1)
    missing = [f"{'xyz'[axis]}_{n}" for n in numbers for axis in range(3) if (n, axis) not in columns]
    if missing:
        remedy = ": depth is needed, too" if all(name.startswith("z") for name in missing) else ""
        raise FormatError(table.path, f"lacks the columns {', '.join(missing[:5])}{remedy}", line=1)
    return np.stack([np.stack([table.numbers(columns[n, a]) for a in range(3)], axis=1) for n in numbers], axis=1)


def _is_long(table: TableFile) -> bool:
    """Whether a table has a row per landmark."""
    return all(axis in table for axis in "xyz") and any(name in table for name in INDEX_NAMES)


def _long(table: TableFile, face: int | None) -> tuple[TableFile, Floats, Ints]:
    """One face of a table with a row per landmark, its (T, N, 3) landmarks and the (T,) first row of each frame."""
    table = one_face(table, face) if first_named(table.columns, FACE_NAMES) is not None else table
    which = table.numbers(next(name for name in INDEX_NAMES if name in table))
    frames = _frame_texts(table)
    for row, (landmark, frame) in enumerate(zip(which, frames, strict=True)):
        if not (0 <= landmark < MOST and landmark == int(landmark) and frame):
            raise FormatError(table.path, "must name its frame and its landmark (0, 1, ...)", line=table.lines[row])
    which = which - (which.min() == 1.0)  # counted from 1
    count = int(which.max()) + 1
    if count < FEWEST:
        raise FormatError(table.path, f"has {count} landmarks per frame, but a face mesh has {FEWEST} or more")
    order = {frame: place for place, frame in enumerate(dict.fromkeys(frames))}
    place, mark = np.array([order[frame] for frame in frames]), which.astype(np.int64)
    of_face = _which_time(place * MOST + mark)
    several = int(of_face.max()) + 1
    if several > 1 and face is None:
        problem = f"contains up to {several} faces in one frame: choose one (--face 0 to {several - 1})"
        raise FormatError(table.path, problem, line=table.lines[int((of_face == 1).argmax())])
    if face is not None and first_named(table.columns, FACE_NAMES) is None and face not in range(several):
        raise ParameterError("face", f"must be in 0..{several - 1}", face)
    if count * len(order) * several > 2 * len(which) + MOST * several:
        raise FormatError(table.path, "has frames with most landmarks missing: correct the column of frames")
    own = of_face == (face if face is not None and several > 1 else 0)
    raw = np.full((len(order), count, 3), np.nan)
    raw[place[own], mark[own]] = np.stack([table.numbers(axis) for axis in "xyz"], axis=1)[own]
    return table, raw, np.array([int((place == frame).argmax()) for frame in range(len(order))], dtype=np.int64)


def _frame_texts(table: TableFile) -> list[str]:
    """What tells the frame of each row: its number, else its time; one frame where neither does."""
    name = name_of_frames(table.columns)
    return table.texts(name) if name is not None else ["0"] * len(table.rows)


def _which_time(keys: Ints) -> Ints:
    """(T,) how often each key has been there before."""
    order = np.argsort(keys, kind="stable")
    first = np.r_[True, np.diff(keys[order]) != 0]
    begins = np.maximum.accumulate(np.where(first, np.arange(len(keys)), 0))
    times = np.empty(len(keys), dtype=np.int64)
    times[order] = np.arange(len(keys)) - begins
    return times


def _upright(raw: Floats, aspect: float) -> Floats:
    """Positions from x to the right, y down and z away, as shares of the picture or in pixels."""
    if not (math.isfinite(aspect) and aspect > 0.0):
        raise ParameterError("aspect", "must be the width of the image divided by its height", aspect)
    pixels = np.nanmax(np.abs(raw[..., :2]), initial=0.0) > NORMALISED
    wide = 1.0 if pixels else aspect
    positions: Floats = raw * np.array([wide, -1.0, -wide])
    return positions
