"""JSON files of MediaPipe's face tasks, in the shapes that its Python, JavaScript and mobile APIs give them.

A file is a list of frames, or an object with such a list under ``frames``, or one frame per line (JSON Lines). A frame
is an object; names may be in snake_case or camelCase. MediaPipe's lists over several faces hold one face here.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ....errors import FormatError
from ....files import read_bytes
from .times import Times

#: Names of one frame's entries: what it is -> how it is called.
NAMES: Mapping[str, tuple[str, ...]] = {
    "time": ("timestamp", "time", "t"),
    "time_ms": ("timestamp_ms", "timestampMs", "time_ms", "timeMs"),
    "blendshapes": ("blendshapes", "face_blendshapes", "faceBlendshapes", "blendShapes"),
    "landmarks": ("landmarks", "face_landmarks", "faceLandmarks", "multi_face_landmarks", "multiFaceLandmarks"),
    "matrix": (
        "facial_transformation_matrix", "facial_transformation_matrixes", "facialTransformationMatrixes", "matrix",
    ),
}  # fmt: skip


@dataclass(frozen=True)
class JsonFrame:
    """One frame of a JSON file: its place in it, and its entries."""

    path: Path
    number: int
    entries: Mapping[str, Any]

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
        """A finite number, or NaN for null."""
        if value is None:
            return math.nan
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
    listed = document.get("frames", [document]) if isinstance(document, dict) else document
    if not isinstance(listed, list) or not listed:
        raise FormatError(file, "must contain a list of frames, or an object with that list under 'frames'")
    frames = []
    for number, entries in enumerate(listed):
        if not isinstance(entries, dict):
            raise FormatError(file, f"must be an object, but it is {str(entries)[:40]!r}", key=f"frame {number}")
        frames.append(JsonFrame(file, number, entries))
    return frames


def read_json_document(path: str | Path) -> Any:
    """The whole file as JSON, or the list of its lines in JSON Lines; errors as `read_json_frames`."""
    file = Path(path)
    try:
        text = read_bytes(file).decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise FormatError(file, "is not UTF-8 text: save it as UTF-8", offset=error.start) from error
    try:
        return json.loads(text)
    except (json.JSONDecodeError, RecursionError) as error:
        lines = [(number, line) for number, line in enumerate(text.splitlines(), start=1) if line.strip()]
        if isinstance(error, json.JSONDecodeError) and len(lines) > 1 and _is_json(lines[0][1]):
            return [_line(file, number, line) for number, line in lines]
        where = error.lineno if isinstance(error, json.JSONDecodeError) else None
        raise FormatError(file, f"is not valid JSON ({error}): is the file cut off?", line=where) from error


def _is_json(line: str) -> bool:
    """Whether a line is an object of its own."""
    try:
        return isinstance(json.loads(line), dict)
    except (json.JSONDecodeError, RecursionError):
        return False


def _line(file: Path, number: int, line: str) -> Any:
    """One line of JSON Lines."""
    try:
        return json.loads(line)
    except (json.JSONDecodeError, RecursionError) as error:
        raise FormatError(file, f"is not valid JSON ({error}): is the file cut off here?", line=number) from error


def times_of(frames: list[JsonFrame], rate: float | None, usual: float) -> Times:
    """Times of each frame from the first on; where the file says none, as `Times.even`.

    Raises
    ------
    FormatError : some frames have a time and others not, or times that do not rise.
    """
    seconds = []
    for frame in frames:
        plain, thousandths = frame.entry("time"), frame.entry("time_ms")
        if plain is None and thousandths is None:
            seconds.append(math.nan)
        else:
            seconds.append(frame.number_at("time", plain if plain is not None else thousandths))
            seconds[-1] *= 1.0 if plain is not None else 1e-3
    if all(math.isnan(second) for second in seconds):
        return Times.even(len(frames), rate, usual)
    for number, frame in enumerate(frames):
        if math.isnan(seconds[number]) or (number > 0 and seconds[number] <= seconds[number - 1]):
            raise frame.refuse("time", "must be later than the frame before: sort the frames by time")
    return Times(np.array(seconds)).from_first()
