"""FAP streams as JSON: everything that a stream knows, for scripts in any language.

    {"format": "risorius fap stream", "version": 1, "name": ..., "fps": 25.0, "file_version": "2.1", "first_frame": 0,
     "faps": ["open_jaw", ...], "frames": [[120.0, null], ...], "visemes": {"0": [4, 0, 63, 0]}, "expressions": {}}

`faps` names the columns of `frames`: those that any frame states. null is not stated.
"""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np

from ...arrays import Floats
from ...errors import FormatError, ParameterError
from ...files import write_whole
from ...tables import KeyedTable, checked_document, read_json
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

    Examples
    --------
    >>> api.write_fap_json("still.json", api.FapStream(np.zeros((3, 68)), fps=25.0))
    >>> api.read_fap_json("still.json").fps
    25.0
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

    Examples
    --------
    >>> api.write_fap_json("still.json", api.FapStream(np.zeros((3, 68)), fps=25.0))
    >>> len(api.read_fap_json("still.json").frames)
    3
    """
    return _stream(read_json(path, kind=FORMAT, version=VERSION))


def stream_of_document(path: str | Path, document: object) -> FapStream:
    """The stream of a JSON document that has been read; errors as `read_fap_json`."""
    return _stream(checked_document(path, document, kind=FORMAT, version=VERSION))


def _stream(document: KeyedTable) -> FapStream:
    """The stream of a checked document."""
    frames = _frames(document)
    visemes, expressions = _fields(document, "visemes"), _fields(document, "expressions")
    try:
        return FapStream(
            frames,
            fps=document.number("fps"),
            name=_text(document, "name"),
            visemes={index: VisemeField(*values) for index, values in visemes.items()},
            expressions={index: ExpressionField(*values) for index, values in expressions.items()},
            first_frame=int(document.number("first_frame")),
            version=_text(document, "file_version"),
        )
    except (ParameterError, TypeError, OverflowError, ValueError) as error:
        raise document.refuse(f"is inconsistent: {error}") from error


def _frames(document: KeyedTable) -> Floats:
    """(T, 68) frames."""
    names, rows = document.texts("faps"), document.cells.get("frames")
    unknown = [name for name in names if name not in NUMBERS]
    if unknown or len(set(names)) != len(names):
        raise document.refuse(f"must name low-level FAPs, each only once: check {unknown or list(names)!r:.60}", "faps")
    if not isinstance(rows, list):
        raise document.refuse("must be a list of rows", "frames")
    frames = np.full((len(rows), FAP_COUNT), np.nan)
    places = [NUMBERS[name] - 1 for name in names]
    for index, row in enumerate(rows):
        if not isinstance(row, list) or len(row) != len(names):
            raise FormatError(document.path, f"must be a list of {len(names)} numbers", key=f"frames.{index}")
        if not all(value is None or (isinstance(value, int | float) and math.isfinite(value)) for value in row):
            raise FormatError(document.path, "must contain finite numbers, or null", key=f"frames.{index}")
        frames[index, places] = [np.nan if value is None else float(value) for value in row]
    return frames


def _fields(document: KeyedTable, key: str) -> dict[int, list[Any]]:
    """Frame index -> the sub-fields of FAP 1 or 2; none where the key is left out."""
    entries = document.table(key, optional=True)
    for index, values in entries.cells.items():
        if not (index.isascii() and index.isdigit() and len(index) < 10):
            raise document.refuse(f"must have frame indices as keys, but there is {index!r:.40}", key)
        if not isinstance(values, list):
            raise entries.refuse("must be a list of sub-fields", index)
    return {int(index): values for index, values in entries.cells.items()}


def _text(document: KeyedTable, key: str) -> str:
    """A text, which may be empty but must be there."""
    return "" if document.cells.get(key) == "" else document.text(key)
