"""JSON files of MediaPipe's face tasks, in the shapes that its Python, JavaScript and mobile APIs give them.

A file is a list of frames, or an object with such a list under ``frames``, or one frame per line (JSON Lines). A frame
is an object; names may be in snake_case or camelCase. MediaPipe's lists over several faces hold one face here.
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from ....arrays import Floats
from ....errors import FormatError, ParameterError
from ....files import read_bytes
from ....tables import parsed_json, parsed_number
from .delimited import decoded
from .faces import name_of_frames, rows_of_face
from .json_layout import bare_entries, entries_of, laid_out, rate_stated
from .row_names import FACE_NAMES, NUMBER_NAMES, first_named, says_unseen, tells_of_a_row, time_named
from .timecode import date_seconds, is_timecode, timecode_stamps
from .times import Stamps, Times, placed

#: Names of one frame's entries: what it is -> how it is called.
NAMES: Mapping[str, tuple[str, ...]] = {
    "blendshapes": (
        "blendshapes", "face_blendshapes", "faceBlendshapes", "blendShapes", "blend_shapes", "BlendShapes", "shapes",
        "weights", "scores", "coefficients", "categories", "expressions", "blendshape_scores",
    ),
    "landmarks": (
        "landmarks", "face_landmarks", "faceLandmarks", "multi_face_landmarks", "multiFaceLandmarks", "landmark",
        "keypoints", "scaledMesh", "mesh", "face_mesh", "faceMesh",
    ),
    "matrix": (
        "facial_transformation_matrix", "facial_transformation_matrixes", "facialTransformationMatrixes", "matrix",
    ),
}  # fmt: skip


#: A dictionary as Python prints it.
PRINTED = re.compile(r"\s*\[?\s*\{\s*'")


@dataclass(frozen=True)
class JsonFrame:
    """One frame of a JSON file.

    Attributes
    ----------
    number : its place in the file. entries : by name.
    key : its number where the file names frames so. per_second : the frame rate that the file states.
    """

    path: Path
    number: int
    entries: Mapping[str, Any]
    key: float | None = None
    per_second: float | None = None

    def entry(self, what: str) -> Any:
        """An entry by what it is (`NAMES`); None where there is none, or no face was seen."""
        for name in NAMES[what]:
            if name in self.entries:
                value = self.entries[name]
                return None if value == [] or value == {} else value
        return None

    def refuse(self, what: str, problem: str) -> FormatError:
        """The error for one entry."""
        return FormatError(self.path, problem, key=f"frame {self.number}, {what}")

    def number_at(self, what: str, value: Any) -> float:
        """A finite number, also as a text; NaN for null and NaN."""
        if value is None or value != value:
            return math.nan
        value = parsed_number(value) if isinstance(value, str) and parsed_number(value) is not None else value
        if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
            raise self.refuse(what, f"must be a number, but it is {value!r}")
        return float(value)


def read_json_frames(path: str | Path) -> list[JsonFrame]:
    """The frames of a file.

    Raises
    ------
    FormatError : names the file, the line or the frame, and the remedy.
    """
    return frames_of(Path(path), read_json_document(path))


def frames_of(file: Path, document: Any) -> list[JsonFrame]:
    """The frames of a document that has been read; errors as `read_json_frames`."""
    listed = laid_out(document)
    if not listed:
        raise FormatError(file, "must contain a list of frames, or an object with that list under 'frames'")
    frames, per_second = [], rate_stated(document)
    for number, (key, held) in enumerate(listed):
        entries = bare_entries(held)
        if not isinstance(entries, dict):
            raise FormatError(file, f"must be an object, but it is {str(entries)[:40]!r}", key=f"frame {number}")
        frames.append(JsonFrame(file, number, _of_a_face(entries_of(entries)), key, per_second))
    return frames


def _of_a_face(entries: Mapping[str, Any]) -> Mapping[str, Any]:
    """A frame's entries; those that tell of the frame alone where it says that no face was seen in it."""
    if not any(says_unseen(name, value) for name, value in entries.items()):
        return entries
    return {name: value for name, value in entries.items() if tells_of_a_row(name)}


def read_json_document(path: str | Path) -> Any:
    """The whole file as JSON, or the list of its lines in JSON Lines; errors as `read_json_frames`."""
    file = Path(path)
    text = decoded(read_bytes(file))
    if text is None:
        raise FormatError(file, "is not UTF-8 text: save it as UTF-8")
    try:
        return parsed_json(text)
    except ValueError as error:
        lines = [(number, line) for number, line in enumerate(text.splitlines(), start=1) if line.strip()]
        if isinstance(error, json.JSONDecodeError) and len(lines) > 1 and _is_json(lines[0][1]):
            return [_line(file, number, line) for number, line in lines]
        where = error.lineno if isinstance(error, json.JSONDecodeError) else None
        remedy = "what Python prints: write it with json.dumps" if PRINTED.match(text) else "is the file cut off?"
        raise FormatError(file, f"is not valid JSON ({error}): {remedy}", line=where) from error


def _is_json(line: str) -> bool:
    """Whether a line is an object of its own."""
    try:
        return isinstance(parsed_json(line), dict)
    except ValueError:
        return False


def _line(file: Path, number: int, line: str) -> Any:
    """One line of JSON Lines."""
    try:
        return parsed_json(line)
    except ValueError as error:
        problem = f"is not valid JSON ({error}): is the file cut off here? Remove this line to read the rest"
        raise FormatError(file, problem, line=number) from error


def json_times(frames: list[JsonFrame], rate: float | None = None) -> Times:
    """When the frames are: by their times, by their numbers, or at the file's own rate.

    Raises
    ------
    FormatError : a time that is none, or not later than the frame before; names the frame.
    ParameterError : the rate.
    """
    named = time_named({name: None for frame in frames for name in frame.entries})
    number_name = first_named({name: None for frame in frames for name in frame.entries}, NUMBER_NAMES)
    numbers = None if number_name is None else np.array([_number(frame, number_name) for frame in frames])
    if numbers is None and any(frame.key is not None for frame in frames):
        numbers = np.array([math.nan if frame.key is None else frame.key for frame in frames])
    if numbers is not None and number_name is None and _are_times(numbers) and named is None:
        return placed(Stamps(len(frames), seconds=numbers, refuse=partial(_refuse, frames)), rate)
    stamps = Stamps(len(frames), numbers=numbers, counted=frames[0].per_second, refuse=partial(_refuse, frames))
    if named is not None:
        name, unit = named
        texts = [frame.entries.get(name) for frame in frames]
        if any(isinstance(text, str) and is_timecode(text) for text in texts):
            found = timecode_stamps([text if isinstance(text, str) else "" for text in texts], rate, stamps.refuse)
            return placed(found, rate)
        seconds = np.array([_seconds(frame, name) for frame in frames])
        stamps = replace(stamps, seconds=seconds, unit=unit)
    return placed(stamps, rate)


#: Keys of frames that lie further apart than this, or in parts of one, are times and no numbers.
FARTHEST = 10.0


def _are_times(keys: Floats) -> bool:
    """Whether the keys of frames are times rather than numbers."""
    steps = np.diff(keys)
    return len(steps) > 0 and (float(np.median(steps)) >= FARTHEST or bool((keys != np.floor(keys)).any()))


def of_one_face(frames: list[JsonFrame], face: int | None) -> tuple[list[JsonFrame], int | None]:
    """The frames of one face where each states whose it is, or several state one time; and the face still to choose.

    Raises
    ------
    FormatError : several faces and none chosen; says how many. ParameterError : there is no such face.
    """
    names = list(dict.fromkeys(name for frame in frames for name in frame.entries))
    of_face, of_frame = first_named(names, FACE_NAMES), name_of_frames(names)
    ids, times = (
        [_text(frame.entries.get(name)) for frame in frames] if name is not None else [] for name in (of_face, of_frame)
    )
    rows = rows_of_face(ids, times, face, lambda problem: FormatError(frames[0].path, problem))
    return (frames, face) if rows is None else ([frames[row] for row in rows], None)


def _text(value: Any) -> str:
    """A plain value as a text; of anything else nothing."""
    return str(value) if isinstance(value, str | int | float) else ""


def chosen_face(frames: list[JsonFrame], counts: list[int], face: int | None) -> int:
    """Which of several faces is read, from 0 on.

    Parameters
    ----------
    counts : faces of each frame.

    Raises
    ------
    FormatError : several and none chosen; says how many. ParameterError : there is no such face.
    """
    most = max(counts, default=0)
    if face is None and most > 1:
        where = counts.index(most)
        raise frames[where].refuse("faces", f"contains {most} faces: choose one (--face 0 to {most - 1})")
    if face is not None and face not in range(max(most, 1)):
        raise ParameterError("face", f"must be in 0..{max(most, 1) - 1}", face)
    return face or 0


def _number(frame: JsonFrame, name: str) -> float:
    """The number of a frame; NaN where it is none."""
    value = frame.entries.get(name)
    return float(value) if isinstance(value, int | float) and math.isfinite(value) else math.nan


def _seconds(frame: JsonFrame, name: str) -> float:
    """The time of one frame in the file's unit; NaN where it states none."""
    value = frame.entries.get(name)
    if isinstance(value, str):
        date, number = date_seconds(value), parsed_number(value)
        value = date if date is not None else number if number is not None else value
    return frame.number_at("time", value)


def _refuse(frames: list[JsonFrame], row: int, problem: str) -> FormatError:
    """The error for the time of one frame."""
    return frames[row].refuse("time", problem)
