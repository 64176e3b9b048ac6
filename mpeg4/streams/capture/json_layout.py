"""How JSON files lay out their frames: lists, lists in objects, keys "0", "1", a matrix with names, a list for a name.

Whatever the layout, `laid_out` gives a frame's entries by name, as `json_file` reads them.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from ....tables import parsed_number
from .json_names import ABOUT, names_beside, row_by_name, with_names
from .json_scores import category, frames_of_curves, frames_of_scores
from .row_names import RATE_NAMES, first_named, numbers_at_end, plain_name, time_name
from .shape_names import is_turn, shape_named

#: Objects around a result that loggers keep, by their plain names.
WRAPPERS = (
    "results", "result", "face", "faces", "facelandmarkerresult", "facelandmarker", "data", "payload", "detection",
    "detections", "prediction", "predictions", "output", "value", "tracking", "facedata", "arkit", "message", "frame",
)  # fmt: skip

#: Names of a list of frames; of the names of a matrix's columns, and of the matrix.
LISTS = (
    "frames",
    "data",
    "results",
    "recording",
    "samples",
    "takes",
    "poses",
    "animation",
    "records",
    "result",
    "items",
)
HEADINGS = (
    "facsnames",
    "names",
    "blendshapenames",
    "shapenames",
    "blendshapes",
    "channels",
    "columns",
    "keys",
    "poses",
)
MATRICES = ("weightmat", "weights", "values", "frames", "data", "scores", "coefficients", "blendshapeweights")

#: Names of what was seen of a face, in plain letters.
SEEN = ("blendshapes", "faceblendshapes", "landmarks", "facelandmarks", "keypoints", "scaledmesh")

#: Faces that an image shows at most.
MOST_FACES = 16

#: How deep objects are looked into.
DEEPEST = 4

Entries = Mapping[str, Any]


def laid_out(document: Any) -> list[tuple[float | None, Any]] | None:
    """Each frame's own number, where the file names frames so, and what it holds; None where there are no frames."""
    if isinstance(document, dict):
        return with_names(_of_object(document, DEEPEST), names_beside(document))
    if not isinstance(document, list) or not document:
        return None
    if len(document) == 1 and isinstance(document[0], dict):
        return laid_out(document[0])
    document = document[1:] if _is_heading(document[0]) and len(document) > 1 else document
    scores = frames_of_scores(document)
    if scores is not None:
        return scores
    if all(category(entry) is not None for entry in document):
        return [(None, {"blendshapes": document})]
    return [(None, entry) for entry in document]


def rate_stated(document: Any) -> float | None:
    """The frame rate that an object states beside its frames; None where it states none."""
    if isinstance(document, list) and document and (len(document) == 1 or _is_heading(document[0])):
        document = document[0]
    if not isinstance(document, dict):
        return None
    name = first_named(document, RATE_NAMES)
    rate = document[name] if name is not None else None
    rate = parsed_number(rate) if isinstance(rate, str) else rate
    if isinstance(rate, int | float) and not isinstance(rate, bool) and 0.0 < rate < float("inf"):
        return float(rate)
    inner = (document[name] for name in document if plain_name(name) in (*WRAPPERS, *ABOUT))
    return next((found for value in inner if (found := rate_stated(value)) is not None), None)


def _is_heading(entry: Any) -> bool:
    """Whether the first of several entries is no frame: it states the rate, and nothing that was seen or when."""
    if not isinstance(entry, dict) or rate_stated(entry) is None:
        return False
    telling = (*SEEN, *WRAPPERS, *HEADINGS, *LISTS)
    return not any(shape_named(name) or plain_name(name) in telling or time_name(name) for name in entry)


def _of_object(document: Entries, depth: int) -> list[tuple[float | None, Any]] | None:
    """The frames of an object: a matrix, a list by a name, frames by numbers, lists by names, or itself."""
    if not document:
        return None
    matrix = _matrix(document) or frames_of_curves(document)
    if matrix is not None:
        return matrix
    numbered = _numbered(document)
    if numbered is not None:
        return numbered
    if all(isinstance(value, dict) and value and all(map(_is_count, value)) for value in document.values()):
        keys = sorted({key for value in document.values() for key in value}, key=int)
        return [(float(key), {name: value.get(key) for name, value in document.items()}) for key in keys]
    columns = _columns(document)
    if columns is not None:
        return columns
    name = first_named(document, LISTS)
    inside = document[name] if name is not None else None
    frames_there = isinstance(inside, list) and all(isinstance(entry, dict | list) or entry is None for entry in inside)
    if isinstance(inside, list) and frames_there and (_are_frames(str(name), inside) or not _holds_faces(inside)):
        return [(None, entry) for entry in inside] or None
    if isinstance(inside, dict) and depth > 0 and inside and _numbered(inside) is not None:
        return _of_object(inside, depth - 1)
    wrapped = [name for name in document if plain_name(name) in WRAPPERS and isinstance(document[name], dict)]
    inner = _of_object(document[wrapped[0]], depth - 1) if depth > 0 and len(wrapped) == 1 else None
    return inner if inner is not None and inner[0][1] is not document[wrapped[0]] else [(None, document)]


def _is_count(key: str) -> bool:
    """Whether a key is a whole number that something may be counted by."""
    return key.isdecimal() and len(key) < 16


def _numbered(document: Entries) -> list[tuple[float | None, Any]] | None:
    """Frames by their numbers, "0" or "frame_0000"; None where the names are none."""
    numbers = [parsed_number(name) for name in document]
    found: Sequence[float | None] = numbers
    if None in numbers:
        holds = all(isinstance(value, dict | list) or value is None for value in document.values())
        found = (numbers_at_end(document) if holds and len(document) > 1 else None) or [None]
    known = [(number, value) for number, value in zip(found, document.values(), strict=False) if number is not None]
    return [(float(number), value) for number, value in sorted(known, key=lambda pair: pair[0])] or None


def _are_frames(name: str, inside: list[Any]) -> bool:
    """Whether a list of what was seen is one of frames by its name, or by its length: so many faces no image shows."""
    return plain_name(name) not in WRAPPERS or len(inside) > MOST_FACES


def _matrix(document: Entries) -> list[tuple[float | None, Any]] | None:
    """Frames of a list of names and a list of rows of numbers, as Audio2Face exports them."""
    for heading, names in document.items():
        if not isinstance(names, list) or not names or not all(isinstance(name, str) for name in names):
            continue
        named_shapes = any(shape_named(name) is not None for name in names)
        if not named_shapes and plain_name(heading) not in HEADINGS:
            continue
        for place, rows in document.items():
            if place == heading or not (named_shapes or plain_name(place) in MATRICES):
                continue
            if isinstance(rows, list) and len(rows) % len(names) == 0 and all(isinstance(v, int | float) for v in rows):
                rows = [rows[first : first + len(names)] for first in range(0, len(rows), len(names))]
            if not (isinstance(rows, list) and rows and all(isinstance(row, list) for row in rows)):
                continue
            if all(len(row) in (0, len(names)) for row in rows):
                times = _times_beside(document, len(rows))
                return [(None, {**times.get(number, {}), **row_by_name(names, row)}) for number, row in enumerate(rows)]
    return None


def _columns(document: Entries) -> list[tuple[float | None, Any]] | None:
    """Frames of a list of numbers for each name."""
    holder: Entries = document
    for value in document.values():
        if isinstance(value, dict) and any(shape_named(key) for key in value) and _count(value) is not None:
            holder = value
            break
    count = _count(holder)
    if count is None or not any(shape_named(name) for name in holder):
        return None
    times = _times_beside(document, count)
    lists = {name: values for name, values in holder.items() if isinstance(values, list) and len(values) == count}
    shapes = {name: values for name, values in lists.items() if time_name(name) is None}
    return [
        (None, {**times.get(number, {}), "blendshapes": {name: values[number] for name, values in shapes.items()}})
        for number in range(count)
    ]


def _count(holder: Entries) -> int | None:
    """How long the lists of numbers of blend shapes are, all of them; None where they are no such lists."""
    counts = {
        len(values) if isinstance(values, list) and not any(isinstance(value, dict | list) for value in values) else -1
        for name, values in holder.items()
        if shape_named(name) is not None
    }
    return counts.pop() if len(counts) == 1 and -1 not in counts and 0 not in counts else None


def _times_beside(document: Entries, count: int) -> dict[int, dict[str, Any]]:
    """What each frame's time is called and is, where a list beside the frames states them."""
    for name, values in document.items():
        if time_name(name) is not None and isinstance(values, list) and len(values) == count:
            return {number: {name: value} for number, value in enumerate(values)}
    return {}


def entries_of(frame: Entries) -> Entries:
    """A frame's entries, those inside what is wrapped round them too, faces in a list put together by name."""
    found: dict[str, Any] = {}
    _gather(frame, found, DEEPEST)
    if not any(plain_name(name) in ("blendshapes", "faceblendshapes") for name in found):
        scores = {name: value for name, value in found.items() if _is_seen(name) and not isinstance(value, list | dict)}
        if not any(shape_named(name) for name in scores):
            return found
        return {name: value for name, value in found.items() if name not in scores} | {"blendshapes": scores}
    return found


def _is_seen(name: str) -> bool:
    """Whether a name is of a blend shape or a turn of head or eyes."""
    return shape_named(name) is not None or is_turn(name)


def _gather(frame: Entries, found: dict[str, Any], depth: int) -> None:
    """Add a frame's entries to those found; what is outside counts."""
    wrapped = []
    for name, value in frame.items():
        if plain_name(name) in WRAPPERS and depth > 0 and isinstance(value, dict):
            wrapped.append(value)
        elif plain_name(name) in WRAPPERS and depth > 0 and isinstance(value, list) and _holds_faces(value):
            wrapped.append(dict(_together(value)))
        else:
            found.setdefault(name, value)
    for inner in wrapped:
        _gather(inner, found, depth - 1)


def _holds_faces(values: list[Any]) -> bool:
    """Whether a list holds what was seen of each of several faces, not frames."""
    return bool(values) and all(
        isinstance(value, dict) and not any(time_name(name) or plain_name(name) == "frame" for name in value)
        and any(plain_name(name) in SEEN for name in value)
        for value in values
    )  # fmt: skip


def _together(faces: list[Entries]) -> Entries:
    """Entries of several faces as lists over the faces; of a single one as they are."""
    if len(faces) == 1:
        return faces[0]
    return {
        name: [face.get(name) for face in faces if face.get(name)]
        for name in dict.fromkeys(n for f in faces for n in f)
    }


def bare_entries(held: Any) -> Any:
    """A frame that is a list without a name is one of landmarks where its parts are points, else of blend shapes."""
    if held is None:
        return {}
    if not isinstance(held, list):
        return held
    point: Any = held
    while isinstance(point, list) and point and isinstance(point[0], list | dict):
        point = point[0]
    is_point = "x" in point if isinstance(point, dict) else bool(point)
    return {"landmarks" if is_point else "blendshapes": held}
