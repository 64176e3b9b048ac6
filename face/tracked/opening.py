"""Which format a file has: told by what it contains, then by its ending."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from ...errors import FormatError
from ...files import read_bytes
from ...mpeg4.streams.capture import Samples, frame_by_frame, frames_of, read_json_document, read_table_file
from ...mpeg4.streams.capture.delimited import decoded
from ...mpeg4.streams.capture.seeming import names_in, what_begins_so, what_it_seems
from ...mpeg4.streams.capture.text_logs import begins_as_json, is_text_log, read_text_log
from ...mpeg4.streams.fap_file import looks_like_fap
from ...mpeg4.streams.fap_json import FORMAT
from ...mpeg4.streams.fba import begins_as_fba
from .formats import READABLE, StreamFormat
from .trackers import RECORDINGS, TABLES, Content, Told, Tracker

#: Bytes at a file's beginning that tell FAP files, JSON and tables apart.
HEAD = 4096
#: What FAPs as JSON say at their beginning.
STREAM_AS_JSON = f'"{FORMAT}"'


@dataclass(frozen=True)
class Opened:
    """A file whose format is known, with what had to be read of it to know.

    Attributes
    ----------
    path, format : the file and what it is.
    document : of FAPs as JSON. samples : what a tracker's file says, as FAPs.
    """

    path: Path
    format: StreamFormat
    document: object = None
    samples: Callable[[Told], Samples] | None = None


def open_stream(path: str | Path, format: StreamFormat | None = None) -> Opened:
    """Recognise a file, or open it as what it is said to be.

    Raises
    ------
    FormatError : it cannot be read, or is none of the formats; says what it should contain.
    """
    file, data = Path(path), read_bytes(path)
    ending, head = file.suffix.lower(), (decoded(data) or data[:HEAD].decode("utf-8-sig", errors="replace"))[:HEAD]
    if format in (StreamFormat.FAP, StreamFormat.FBA):
        return Opened(file, format)
    if format is None and (begins_as_fba(data) or ending == ".fba"):
        return Opened(file, StreamFormat.FBA)
    if format is None and (looks_like_fap(head) or ending == ".fap"):
        return Opened(file, StreamFormat.FAP)
    if format is StreamFormat.JSON or begins_as_json(head) or ending in (".json", ".jsonl"):
        return _json(file, format)
    if "\0" in head:
        seems = what_begins_so(data)
        problem = f"is binary, and not a FAP stream or a recording: use {', '.join(READABLE)}"
        problem += f"; it seems to be {seems}" if seems is not None else ""
        raise FormatError(file, problem, offset=max(data.find(b"\0"), 0))
    table = read_text_log(file) if is_text_log(head) else frame_by_frame(read_table_file(file))
    problem = f"has none of the columns of {_listed(TABLES)}: {what_it_seems(table.columns)}"
    unknown = FormatError(file, problem, line=1)
    return _recognised(file, format, table, TABLES, unknown)


def states_all(path: str | Path) -> bool:
    """Whether a file begins as a stream of FAPs by the standard, or as JSON: those leave no rate, face or sign open.

    Raises
    ------
    FormatError : it cannot be read.
    """
    head = read_bytes(path)[:HEAD]
    text = (decoded(head) or head.decode("utf-8-sig", errors="replace"))[:HEAD]
    return begins_as_fba(head) or looks_like_fap(text) or STREAM_AS_JSON in text


def _json(file: Path, format: StreamFormat | None) -> Opened:
    """FAPs as JSON say so; all other JSON is a tracker's."""
    document = read_json_document(file)
    if format is StreamFormat.JSON or (format is None and isinstance(document, dict) and "format" in document):
        return Opened(file, StreamFormat.JSON, document=document)
    unknown = FormatError(file, f"has no {_listed(RECORDINGS)} in any frame: {what_it_seems(names_in(document))}")
    return _recognised(file, format, frames_of(file, document), RECORDINGS, unknown)


def _recognised(
    file: Path,
    format: StreamFormat | None,
    content: Content,
    trackers: Sequence[Tracker[Content]],
    unknown: FormatError,
) -> Opened:
    """The file of the tracker that its content tells, or that it is said to be of."""
    for tracker in trackers:
        if tracker.holds(content) if format is None else format in tracker.formats:
            return Opened(file, format or tracker.formats[0], samples=partial(tracker.samples, content))
    if format is None:
        raise unknown
    raise FormatError(file, f"is not a file of the format {format}: leave the format out")


def _listed(trackers: Sequence[Tracker[Content]]) -> str:
    """What files are recognised by, in a sentence."""
    last, *others = dict.fromkeys(tracker.example for tracker in reversed(trackers))
    others.reverse()
    return f"{', '.join(others)} or {last}"
