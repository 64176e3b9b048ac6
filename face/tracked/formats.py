"""The formats of streams and recordings, and which of them a file has: by what it contains, then by its ending."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path

from ...errors import FormatError, ParameterError
from ...files import read_bytes
from ...mpeg4.streams.capture import (
    JsonFrame,
    TableFile,
    arkit_columns,
    frames_of,
    holds_faps,
    holds_landmarks,
    load_columns,
    read_json_document,
    read_table_file,
)
from ...mpeg4.streams.fap_file import looks_like_fap
from ...mpeg4.streams.fba import begins_as_fba

#: Endings of files that are read, and that are written.
READABLE = (".fap", ".fba", ".json", ".jsonl", ".csv")
WRITABLE = (".fap", ".fba", ".json", ".csv")

#: Bytes at a file's beginning that tell FAP files, JSON and tables apart.
HEAD = 4096


class StreamFormat(StrEnum):
    """What a file of FAPs, or of what trackers saw, may be.

    fap, fba, json, faps : the standard's text and bit stream; FAPs as JSON and as a CSV table, as Risorius writes them.
    openface, arkit, mediapipe : scores of trackers, as CSV or JSON. landmarks : points of a face mesh.
    """

    FAP = "fap"
    FBA = "fba"
    JSON = "json"
    FAPS = "faps"
    OPENFACE = "openface"
    ARKIT = "arkit"
    MEDIAPIPE = "mediapipe"
    LANDMARKS = "landmarks"

    @classmethod
    def of(cls, name: str) -> StreamFormat:
        """The format of that name; ParameterError lists the names."""
        try:
            return cls(name)
        except ValueError:
            raise ParameterError("format", f"must be one of {', '.join(cls)}", str(name)) from None


@dataclass(frozen=True)
class Opened:
    """A file whose format is known, with what had to be read of it to know.

    Attributes
    ----------
    path, format : the file and what it is.
    document : of FAPs as JSON. recorded : the frames of a tracker's JSON. table : of a CSV file.
    """

    path: Path
    format: StreamFormat
    document: object = None
    recorded: list[JsonFrame] | None = None
    table: TableFile | None = None


def open_stream(path: str | Path, format: StreamFormat | None = None) -> Opened:
    """Recognise a file, or open it as what it is said to be.

    Raises
    ------
    FormatError : it cannot be read, or is none of the formats; says what it should contain.
    """
    file, data = Path(path), read_bytes(path)
    ending, head = file.suffix.lower(), data[:HEAD].decode("utf-8-sig", errors="replace")
    if format in (StreamFormat.FAP, StreamFormat.FBA):
        return Opened(file, format)
    if format is None and (begins_as_fba(data) or ending == ".fba"):
        return Opened(file, StreamFormat.FBA)
    if format is None and (looks_like_fap(head) or ending == ".fap"):
        return Opened(file, StreamFormat.FAP)
    if format is StreamFormat.JSON or head.lstrip().startswith(("{", "[")) or ending in (".json", ".jsonl"):
        return _json(file, format)
    if b"\0" in data[:HEAD]:
        problem = f"is binary, and not a FAP stream or a recording: use {', '.join(READABLE)}"
        raise FormatError(file, problem, offset=data.index(b"\0"))
    table = read_table_file(file)
    return Opened(file, format or _format_of_table(table), table=table)


def _json(file: Path, format: StreamFormat | None) -> Opened:
    """FAPs as JSON say so; all other JSON is a tracker's."""
    document = read_json_document(file)
    if format is StreamFormat.JSON or (format is None and isinstance(document, dict) and "format" in document):
        return Opened(file, StreamFormat.JSON, document=document)
    recorded = frames_of(file, document)
    if format is not None:
        return Opened(file, format, recorded=recorded)
    if any(frame.entry("blendshapes") is not None for frame in recorded):
        return Opened(file, StreamFormat.MEDIAPIPE, recorded=recorded)
    if any(frame.entry("landmarks") is not None for frame in recorded):
        return Opened(file, StreamFormat.LANDMARKS, recorded=recorded)
    raise FormatError(file, "has neither blend shapes nor landmarks in any frame")


def _format_of_table(table: TableFile) -> StreamFormat:
    """What the columns of a table tell."""
    if holds_faps(table):
        return StreamFormat.FAPS
    if holds_landmarks(table):
        return StreamFormat.LANDMARKS
    if "pose_Rx" in table or any(name in table for name in load_columns().gains):
        return StreamFormat.OPENFACE
    if any(name in table for name in arkit_columns().gains):
        return StreamFormat.ARKIT
    known = "OpenFace (AU01_r), ARKit (jawOpen), landmarks (x_0) or FAPs (F03_open_jaw)"
    raise FormatError(table.path, f"has none of the columns of {known}", line=1)
