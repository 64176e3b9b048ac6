"""Tables of sounds or visemes with their times: with a heading, or three columns as label files have them.

Sources of label files: HTK 3.4 book, section 6.2 (100 ns); TIMIT's documentation (samples at 16 kHz); Audacity's
manual, "Label tracks" (seconds).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from ...errors import FormatError
from ...mpeg4.streams.capture import TableFile, read_table_file
from ...tables import parsed_number
from ..phonemes import Phoneme
from .labels import Label, Timings, viseme_number

#: What columns and keys are called, in lower case without blanks, underscores and units.
STARTS = ("start", "begin", "onset", "from", "t0", "xmin", "tmin", "starttime", "begintime", "time", "offset")
ENDS = ("end", "stop", "to", "t1", "xmax", "tmax", "endtime", "stoptime", "finish")
DURATIONS = ("duration", "dur", "length")
SOUNDS = ("phoneme", "phone", "sound", "symbol", "segment", "ipa", "label", "text", "value", "mark", "name")
VISEMES = ("viseme", "visemeid", "visemenumber")
WORDS = ("word",)
KINDS = ("type", "tier", "kind", "tiername", "tiertype")
#: What one unit of a column of times is, in seconds, by what is written behind its name.
UNITS = {
    "ms": 0.001,
    "msec": 0.001,
    "milliseconds": 0.001,
    "us": 1e-6,
    "ns": 1e-9,
    "s": 1.0,
    "sec": 1.0,
    "seconds": 1.0,
}
#: Median length of a sound up to which its unit is a second, a millisecond, a sample at 16 kHz, 100 ns.
LENGTHS = (
    (4.0, 1.0, ""),
    (400.0, 0.001, "milliseconds"),
    (2e4, 1 / 16000, "samples at 16,000 per second"),
    (np.inf, 1e-7, "100 ns"),
)


def place_of(columns: Sequence[str], names: Sequence[str]) -> int | None:
    """The first column called one of some names, whatever its blanks, underscores and unit."""
    plain = [_plain(column)[0] for column in columns]
    return next((plain.index(name) for name in names if name in plain), None)


def unit_of(column: str) -> float | None:
    """Seconds in one unit of a column of times, where its name says so."""
    return UNITS.get(_plain(column)[1])


def _plain(column: str) -> tuple[str, str]:
    """A name in lower case without blanks and underscores, and the unit behind it."""
    words = (
        column.lower().replace("(", " ").replace(")", " ").replace("[", " ").replace("]", " ").replace("_", " ").split()
    )
    unit = words.pop() if len(words) > 1 and words[-1] in UNITS else ""
    return "".join(words), unit


def seconds_in(lengths: Sequence[float]) -> tuple[float, str]:
    """Seconds in the unit of some lengths of sounds, and its name; the name is empty for seconds."""
    median = float(np.median(lengths)) if len(lengths) else 0.0
    return next(((unit, name) for most, unit, name in LENGTHS if not median > most), LENGTHS[-1][1:])


def has_no_heading(lines: Sequence[tuple[int, str]]) -> bool:
    """Whether every line is two numbers and a text."""
    return bool(lines) and all(_parted(line) is not None for _, line in lines)


def _parted(line: str) -> tuple[float, float, str] | None:
    """Two numbers and what stands behind them; None where a line is otherwise."""
    cells = line.replace("\t", " ").split(maxsplit=2)
    if len(cells) < 2:
        return None
    start, end = (parsed_number(cell) for cell in cells[:2])
    if start is None or end is None:
        return None
    return float(start), float(end), cells[2].strip() if len(cells) > 2 else ""


def label_file(path: Path, lines: Sequence[tuple[int, str]]) -> Timings:
    """Lines of start, end and sound."""
    parted = [(number, found) for number, line in lines if (found := _parted(line)) is not None]
    unit, name = seconds_in([end - start for _, (start, end, _) in parted])
    labels = [Label(start * unit, end * unit, text, f"line {number}") for number, (start, end, text) in parted]
    said = (f"times are read as {name}",) if name else ()
    return Timings(path, labels, duration=max(label.end for label in labels), assumed=said)


def table_timings(path: Path) -> Timings:
    """A table with a heading.

    Raises
    ------
    FormatError : it lacks a column of times or of sounds; names what it has.
    """
    table = read_table_file(path)
    start, end = place_of(table.columns, STARTS), place_of(table.columns, ENDS)
    length, kind = place_of(table.columns, DURATIONS), place_of(table.columns, KINDS)
    viseme, sound, word = (place_of(table.columns, names) for names in (VISEMES, SOUNDS, WORDS))
    shown = sound if sound is not None else viseme
    if start is None or shown is None:
        columns = ", ".join(table.columns)
        raise FormatError(path, f"must have columns start, end and phoneme or viseme, but it has {columns}", line=1)
    starts = table.numbers(table.columns[start])
    ends = _ends(table, starts, end, length)
    if np.isnan(starts).any() or np.isnan(ends).any():
        row = int(np.flatnonzero(np.isnan(starts) | np.isnan(ends))[0])
        raise table.refusal(row, table.columns[start], "has no time: correct or remove the row")
    unit, said = unit_of(table.columns[start]), tuple[str, ...]()
    if unit is None:
        unit, name = seconds_in(np.asarray(ends - starts).tolist())
        said = (f"times are read as {name}",) if name else ()
    rows = [
        Label(float(s) * unit, float(e) * unit, row[shown], f"line {line}")
        for s, e, row, line in zip(starts, ends, table.rows, table.lines, strict=True)
    ]
    read = _numbers_or_sounds([label.text for label in rows]) if shown == viseme else None
    if kind is not None:
        kinds = [row[kind].lower() for row in table.rows]
        words = [label for label, what in zip(rows, kinds, strict=True) if what.startswith("word")]
        rows = [label for label, what in zip(rows, kinds, strict=True) if not what.startswith("word")]
    else:
        words = [] if word is None else _words(table, rows, word)
    return Timings(path, rows, words, read=read, assumed=said)


def _ends(table: TableFile, starts: np.ndarray, end: int | None, length: int | None) -> np.ndarray:
    """When rows end: as stated, by their length, or where the next one starts."""
    if end is not None:
        return np.asarray(table.numbers(table.columns[end]))
    if length is not None:
        return np.asarray(starts + table.numbers(table.columns[length]))
    return np.asarray(np.append(starts[1:], starts[-1:] + (np.median(np.diff(starts)) if len(starts) > 1 else 0.0)))


def _words(table: TableFile, rows: Sequence[Label], word: int) -> list[Label]:
    """Neighbouring rows with the same word as one."""
    words: list[Label] = []
    for label, row in zip(rows, table.rows, strict=True):
        if words and words[-1].text == row[word] and label.start - words[-1].end < 1e-3:
            words[-1] = Label(words[-1].start, label.end, row[word], words[-1].where)
        else:
            words.append(Label(label.start, label.end, row[word], label.where))
    return words


def _numbers_or_sounds(texts: Sequence[str]) -> Callable[[str], tuple[Phoneme, ...] | None] | None:
    """How visemes are read: as numbers of FAP 1 where all are numbers, else as sounds."""
    return viseme_number if all(parsed_number(text) is not None for text in texts if text) else None
