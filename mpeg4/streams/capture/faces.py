"""One face of a recording of several: the one that a caller chooses, or a refusal that tells how many there are."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from ....arrays import Ints
from ....errors import FormatError, ParameterError
from .row_names import FACE_NAMES, NUMBER_NAMES, first_named, time_named
from .table_file import TableFile

#: A file in which so large a share of the rows repeats the frame before, holds several faces in each.
SHARED = 0.34


def one_face(table: TableFile, face: int | None) -> TableFile:
    """The rows of one face, by its number in a column (`FACE_NAMES`) or by its place among the rows of its frame.

    Raises
    ------
    FormatError : several faces and none chosen; says how many.
    ParameterError : there is no such face.
    """
    name = first_named(table.columns, FACE_NAMES)
    ids = table.texts(name) if name is not None else []
    frame_name = name_of_frames(table.columns)
    frames = table.texts(frame_name) if frame_name is not None else []
    alone = _once(table)
    if len(alone) < len(table.rows):
        return one_face(table.only(alone), face)
    rows = rows_of_face(ids, frames, face, lambda problem: FormatError(table.path, problem))
    return chosen_of_one(table, face) if rows is None else table.only(rows)


def _once(table: TableFile) -> Ints:
    """The rows that are not the row before once more, to the letter: a logger was faster than its tracker."""
    same = [row for row in range(1, len(table.rows)) if table.rows[row] == table.rows[row - 1]]
    is_timed = name_of_frames(table.columns) is not None
    return np.setdiff1d(np.arange(len(table.rows)), same) if is_timed else np.arange(len(table.rows))


def name_of_frames(names: Sequence[str]) -> str | None:
    """What tells the frame of a row: its number, else its time; None where neither does."""
    number, timed = first_named(names, NUMBER_NAMES), time_named(names)
    return number or (timed[0] if timed is not None else None)


def rows_of_face(
    ids: Sequence[str], frames: Sequence[str], face: int | None, refuse: Callable[[str], FormatError]
) -> Ints | None:
    """The rows of one face of several; None where there is one face.

    Parameters
    ----------
    ids : the face of each row, empty where it states none; no ids where the file has none.
    frames : the frame of each row; none where the file does not say. refuse : the error for the file.

    Raises
    ------
    FormatError : several faces and none chosen; says how many. ParameterError : there is no such face.
    """
    there = sorted({text for text in ids if text}, key=_order)
    if len(there) > 1:
        if face is None:
            raise refuse(f"contains {len(there)} faces (face_id {', '.join(there[:8])}): choose one (--face)")
        chosen = [row for row, text in enumerate(ids) if _order(text) == (0, float(face), "")]
        if not chosen:
            raise ParameterError("face", f"must be one of {', '.join(there[:8])}", face)
        return np.array(chosen, dtype=np.int64)
    return _by_place(frames, face, refuse)


def _order(text: str) -> tuple[int, float, str]:
    """Numbers by size, then other names."""
    try:
        return (0, float(text), "")
    except ValueError:
        return (1, 0.0, text)


def _by_place(frames: Sequence[str], face: int | None, refuse: Callable[[str], FormatError]) -> Ints | None:
    """The rows of one face where each frame has a row for every face; None where it has not."""
    places, count = [], 0
    for row, frame in enumerate(frames):
        count = count + 1 if row and frame == frames[row - 1] else 0
        places.append(count)
    several = max(places, default=0) + 1
    repeated = sum(place > 0 for place in places)
    if several == 1 or len(set(frames)) == 1 or repeated < SHARED * len(frames):
        return None
    if face is None:
        raise refuse(f"contains up to {several} faces in one frame: choose one (--face)")
    if face not in range(several):
        raise ParameterError("face", f"must be in 0..{several - 1}", face)
    return np.array([row for row, place in enumerate(places) if place == face], dtype=np.int64)


def chosen_of_one(table: TableFile, face: int | None) -> TableFile:
    """The table of a single face, which alone can be chosen."""
    name = first_named(table.columns, FACE_NAMES)
    only = next((text for text in table.texts(name) if text), "0") if name is not None else "0"
    if face is not None and _order(only) != (0, float(face), ""):
        raise ParameterError("face", f"must be {only}, the only face of the recording", face)
    return table
