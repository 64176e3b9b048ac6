"""One face of a recording of several: the one that a caller chooses, or a refusal that tells how many there are."""

from __future__ import annotations

import numpy as np

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
    texts = table.texts(name) if name is not None else []
    there = sorted({text for text in texts if text}, key=_order)
    if len(there) > 1:
        if face is None:
            problem = f"contains {len(there)} faces ({name} {', '.join(there[:8])}): choose one (--face)"
            raise FormatError(table.path, problem)
        chosen = [row for row, text in enumerate(texts) if _order(text) == (0, float(face), "")]
        if not chosen:
            raise ParameterError("face", f"must be one of {', '.join(there[:8])}", face)
        return table.only(np.array(chosen, dtype=np.int64))
    return _by_place(table, face) if len(there) < 2 else table


def _order(text: str) -> tuple[int, float, str]:
    """Numbers by size, then other names."""
    try:
        return (0, float(text), "")
    except ValueError:
        return (1, 0.0, text)


def _by_place(table: TableFile, face: int | None) -> TableFile:
    """The rows of one face where each frame has a row for every face; the whole table where it has not."""
    name = first_named(table.columns, NUMBER_NAMES)
    if name is None:
        named = time_named(table.columns)
        name = named[0] if named is not None else None
    frames = table.texts(name) if name is not None else []
    places, count = [], 0
    for row, frame in enumerate(frames):
        count = count + 1 if row and frame == frames[row - 1] else 0
        places.append(count)
    several = max(places, default=0) + 1
    repeated = sum(place > 0 for place in places)
    if several == 1 or len(set(frames)) == 1 or repeated < SHARED * len(frames):
        return chosen_of_one(table, face)
    if face is None:
        raise FormatError(table.path, f"contains up to {several} faces in one frame: choose one (--face)")
    if face not in range(several):
        raise ParameterError("face", f"must be in 0..{several - 1}", face)
    return table.only(np.array([row for row, place in enumerate(places) if place == face], dtype=np.int64))


def chosen_of_one(table: TableFile, face: int | None) -> TableFile:
    """The table of a single face, which alone can be chosen."""
    name = first_named(table.columns, FACE_NAMES)
    only = next((text for text in table.texts(name) if text), "0") if name is not None else "0"
    if face is not None and _order(only) != (0, float(face), ""):
        raise ParameterError("face", f"must be {only}, the only face of the recording", face)
    return table
