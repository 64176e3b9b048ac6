"""FAP streams as JSON: everything that a stream knows, for scripts in any language.

    {"format": "risorius fap stream", "version": 1, "name": ..., "fps": 25.0, "file_version": "2.1", "first_frame": 0,
     "faps": ["open_jaw", ...], "frames": [[120.0, null], ...], "visemes": {"0": [4, 0, 63, 0]}, "expressions": {}}

`faps` names the columns of `frames`: those that any frame states. null is not stated.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from ...arrays import Floats
from ...errors import FormatError, ParameterError
from ...files import read_document, write_whole
from ..high_level import ExpressionField, VisemeField
from ..standard import FAP_COUNT, FAPS
from .fap_stream import FapStream

FORMAT, VERSION = "risorius fap stream", 1
NUMBERS = {fap.name: number for number, fap in FAPS.items() if not fap.high_level}


def write_fap_json(path: str | Path, stream: FapStream) -> None:
    """Write a stream as JSON, whole or not at all.

    Raises
    ------
    FormatError : the file cannot be written.
    """
    used = [number for number in NUMBERS.values() if stream.mask[:, number - 1].any()]
    columns = stream.frames[:, [number - 1 for number in used]]
    document = {
        "format": FORMAT,
        "version": VERSION,
        "name": stream.name,
        "fps": stream.fps,
        "file_version": stream.version,
        "first_frame": stream.first_frame,
        "faps": [FAPS[number].name for number in used],
        "frames": [[None if math.isnan(value) else value for value in row] for row in columns.tolist()],
        "visemes": {str(index): field.values for index, field in stream.visemes.items()},
        "expressions": {str(index): field.values for index, field in stream.expressions.items()},
    }
    write_whole(path, json.dumps(document) + "\n")


def read_fap_json(path: str | Path) -> FapStream:
    """A stream out of a JSON file.

    Raises
    ------
    FormatError : names the file, the key and the rule it breaks.
    """
    file = Path(path)
    document = read_document(file, kind=FORMAT, version=VERSION)
    frames = _frames(file, document)
    name, file_version = (_text(file, document, key) for key in ("name", "file_version"))
    fields = {key: _fields(file, document, key) for key in ("visemes", "expressions")}
    try:
        return FapStream(
            frames,
            fps=float(_number(file, document, "fps")),
            name=name,
            visemes={index: VisemeField(*values) for index, values in fields["visemes"].items()},
            expressions={index: ExpressionField(*values) for index, values in fields["expressions"].items()},
            first_frame=int(_number(file, document, "first_frame")),
            version=file_version,
        )
    except (ParameterError, TypeError, OverflowError, ValueError) as error:
        raise FormatError(file, f"does not fit together: {error}") from error


def _frames(file: Path, document: Mapping[str, Any]) -> Floats:
    """(T, 68) frames."""
    names, rows = document.get("faps"), document.get("frames")
    if not isinstance(names, list) or not all(isinstance(name, str) for name in names):
        raise FormatError(file, "must be a list of FAP names", key="faps")
    unknown = [name for name in names if name not in NUMBERS]
    if unknown or len(set(names)) != len(names):
        raise FormatError(file, f"must name low-level FAPs, each once; look at {unknown or names!r:.60}", key="faps")
    if not isinstance(rows, list):
        raise FormatError(file, "must be a list of rows", key="frames")
    frames = np.full((len(rows), FAP_COUNT), np.nan)
    places = [NUMBERS[name] - 1 for name in names]
    for index, row in enumerate(rows):
        if not isinstance(row, list) or len(row) != len(names):
            raise FormatError(file, f"must be a list of {len(names)} numbers", key=f"frames.{index}")
        if not all(value is None or (isinstance(value, int | float) and math.isfinite(value)) for value in row):
            raise FormatError(file, "must hold finite numbers, or null", key=f"frames.{index}")
        frames[index, places] = [np.nan if value is None else float(value) for value in row]
    return frames


def _fields(file: Path, document: Mapping[str, Any], key: str) -> dict[int, list[Any]]:
    """Frame index -> the sub-fields of FAP 1 or 2; none where the key is left out."""
    entries = document.get(key, {})
    if not isinstance(entries, dict) or not all(isinstance(values, list) for values in entries.values()):
        raise FormatError(file, "must be an object of frame index and list of sub-fields", key=key)
    if not all(index.isascii() and index.isdigit() and len(index) < 10 for index in entries):
        raise FormatError(file, "must have frame indices as keys", key=key)
    return {int(index): values for index, values in entries.items()}


def _text(file: Path, document: Mapping[str, Any], key: str) -> str:
    """A text."""
    if not isinstance(document.get(key), str):
        raise FormatError(file, "must be a text", key=key)
    return str(document[key])


def _number(file: Path, document: Mapping[str, Any], key: str) -> int | float:
    """A number."""
    value = document.get(key)
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise FormatError(file, f"must be a number, but it is {value!r:.40}", key=key)
    return value
