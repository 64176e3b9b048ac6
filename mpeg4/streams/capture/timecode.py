"""Times as texts: timecodes of films, times of day, dates.

``HH:MM:SS:FF`` counts frames, ``HH:MM:SS:FF.fraction`` with parts of them, ``HH:MM:SS;FF`` leaves numbers out so that
it follows the clock at 29.97 (SMPTE 12M, drop frame). ``HH:MM:SS.fraction`` is a time of day, and so is
``HH:MM:SS:mmm`` and ``MM:SS.fraction``. Drop frame is also told where a plain count leaves out what it would.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Sequence
from dataclasses import replace
from datetime import datetime

import numpy as np

from ....arrays import Floats
from ....errors import FormatError, ParameterError
from .table_file import UNKNOWN
from .times import Stamps

TIMECODE = re.compile(r"(?:(\d+)[:;])?(\d{1,2})[:;](\d{1,2})(?:([:;.,])(\d+(?:[.,]\d+)?))?")

#: Counts of frames in a second that films and trackers have; 60 where a timecode shows none, which is Live Link Face's.
COUNTS, USUAL_COUNT = (24, 25, 30, 48, 50, 60, 100, 120, 240), 60

#: A field of more than this counts no frames but thousandths of a second.
MOST_FRAMES = 240

#: Wraps that must agree on a count that is none of the usual.
SURE = 3

DAY, SIXTY = 86400.0, 60
#: Seconds in a minute of loggers that count all fields of a timecode alike: the frames per second.
ODD_BASES = (24.0, 25.0, 30.0, 50.0)


def is_timecode(text: str) -> bool:
    """Whether a text is a timecode or a time of day."""
    return _parts(text) is not None


def _parts(text: str) -> re.Match[str] | None:
    """The parts of a timecode or a time of day: hours, if it has them, minutes, seconds, and what is last."""
    match = TIMECODE.fullmatch(text.strip())
    return None if match is None or (match[1] is None and match[4] not in (".", ",")) else match


def date_seconds(text: str) -> float | None:
    """Seconds of a date with its time (ISO 8601); None where it is none."""
    try:
        when = datetime.fromisoformat(text.strip())
    except ValueError:
        return None
    return (when - datetime(1970, 1, 1, tzinfo=when.tzinfo)).total_seconds()


def timecode_stamps(texts: Sequence[str], rate: float | None, refuse: Callable[[int, str], FormatError]) -> Stamps:
    """What a column of timecodes says; an empty one says nothing.

    Parameters
    ----------
    rate : frames per second that a caller names. refuse : the error for one row.
    """
    fields, marks = np.full((len(texts), 4), np.nan), set()
    widths = set()
    for row, text in enumerate(texts):
        if text.strip().lower() in UNKNOWN:
            continue
        match = _parts(text)
        if match is None:
            raise refuse(row, f"column Timecode must be HH:MM:SS:FF or HH:MM:SS:FF.fraction, but it is {text[:40]!r}")
        fields[row] = [float((match[place] or "0").replace(",", ".")) for place in (1, 2, 3, 5)]
        marks.add(match[4] or ".")
        widths.add(len(match[5] or ""))
    if not widths:
        return Stamps(len(texts), refuse=refuse)
    hours, minutes, seconds, frames = fields.T
    base = _base(minutes, seconds)
    clock = 3600.0 * hours + 60.0 * minutes + seconds if base == SIXTY else (hours * base + minutes) * base + seconds
    clock = _over_midnight(clock)
    if marks <= {".", ","} and (min(widths) != 2 or np.nanmax(frames) >= USUAL_COUNT):
        parts = frames / 10.0 ** _decimals(texts)
        return Stamps(len(texts), seconds=clock + parts, unit=1.0, clock=lambda text: _clock(text, None), refuse=refuse)
    if np.nanmax(frames) >= MOST_FRAMES or widths == {3}:
        said = ("its timecode counts milliseconds",)
        by_thousand = clock + frames / 1000.0
        return Stamps(
            len(texts),
            seconds=by_thousand,
            unit=1.0,
            clock=lambda text: _clock(text, 1000.0),
            assumed=said,
            refuse=refuse,
        )
    stamps = _counted(clock, frames, ";" in marks, rate, refuse)
    odd = (f"its timecode has {base} seconds in a minute",) if base != SIXTY else ()
    return replace(stamps, assumed=(*stamps.assumed, *odd))


def _base(minutes: Floats, seconds: Floats) -> int:
    """How many seconds a timecode has in a minute: the number after which they begin anew.

    Some loggers count seconds as they count frames. Only where each minute begins right after the same second below 59,
    and no second is above it.
    """
    known = np.isfinite(seconds)
    minutes, seconds = minutes[known], seconds[known]
    ends = np.flatnonzero((np.diff(minutes) == 1.0) & (seconds[1:] == 0.0))
    last = np.unique(seconds[ends])
    if len(last) != 1 or last[0] + 1.0 not in ODD_BASES or seconds.max() > last[0]:
        return SIXTY
    return int(last[0]) + 1


def _counted(
    clock: Floats, frames: Floats, drop: bool, rate: float | None, refuse: Callable[[int, str], FormatError]
) -> Stamps:
    """A timecode that counts frames."""
    shown = _wraps_after(clock, frames)
    most = math.floor(float(np.nanmax(frames))) + 1
    told = round(rate) if rate is not None and round(rate) >= most else None
    usual = max(30 if drop else USUAL_COUNT, most)
    count = shown or told or usual
    assumed: tuple[str, ...] = ()
    if shown is not None and shown != USUAL_COUNT:
        assumed = (f"its timecode begins anew after {count}: it counts {count} frames per second",)
    elif shown is None and told is None:
        assumed = (f"its timecode counts {count:g} frames per second",)
    numbers, counted = clock * count + frames, float(count)
    drop = drop or _leaves_out(clock, frames, count)
    if drop:
        numbers, counted = numbers - _left_out(clock, count), count * 1000.0 / 1001.0
        assumed = (*assumed, f"its timecode leaves numbers out: {counted:.2f} frames per second")
    elif shown is None and told is not None and rate is not None:
        counted = rate

    def seconds_of(text: str) -> float:
        match = _match(text)
        at, frame = _whole_seconds(match), float((match[5] or "0").replace(",", "."))
        return float((at * count + frame - (_left_out(np.array(at), count) if drop else 0.0)) / counted)

    return Stamps(len(clock), numbers=numbers, counted=counted, clock=seconds_of, assumed=assumed, refuse=refuse)


def _leaves_out(clock: Floats, frames: Floats, count: int) -> bool:
    """Whether a count goes on with the first number that drop frame has in a minute, wherever it runs into one."""
    known = np.isfinite(clock)
    minutes, seconds = np.divmod(clock[known], 60.0)
    number = np.floor(frames[known])
    begins = np.flatnonzero((np.diff(minutes) == 1.0) & (seconds[1:] == 0.0) & (seconds[:-1] == 59.0)) + 1
    begins = begins[(number[begins - 1] == count - 1) & (minutes[begins] % 10.0 != 0.0)]
    return len(begins) > 0 and count % 30 == 0 and bool((number[begins] == round(count / 15.0)).all())


def _left_out(clock: Floats, count: int) -> Floats:
    """The numbers that a drop-frame timecode has left out by then: two (of 30) each minute but each tenth."""
    left_out: Floats = np.round(count / 15.0) * (np.floor(clock / 60.0) - np.floor(clock / 600.0))
    return left_out


def _decimals(texts: Sequence[str]) -> Floats:
    """(T,) digits after the point or comma of times of day."""
    return np.array(
        [len(re.split(r"[.,]", text.strip(), maxsplit=1)[-1]) if re.search(r"[.,]", text) else 0 for text in texts]
    )


def _match(text: str) -> re.Match[str]:
    """The parts of a timecode that a caller names."""
    match = _parts(text)
    if match is None:
        raise ParameterError("start", "must be seconds, or a timecode HH:MM:SS:FF as the recording has", text)
    return match


def _whole_seconds(match: re.Match[str]) -> float:
    """Hours, minutes and seconds in seconds."""
    return 3600.0 * float(match[1] or 0.0) + 60.0 * float(match[2]) + float(match[3])


def _clock(text: str, parts: float | None) -> float:
    """Seconds of a time of day whose last field is a fraction, or counts so many parts of a second."""
    match = _match(text)
    last = match[5] or "0"
    return _whole_seconds(match) + (float(f"0.{last}") if parts is None else float(last) / parts)


def _over_midnight(clock: Floats) -> Floats:
    """Times of day in seconds, going on where a day ends."""
    known = np.flatnonzero(np.isfinite(clock))
    steps = np.diff(clock[known])
    going = clock.copy()
    going[known[1:]] += DAY * np.cumsum(steps < -DAY / 2.0)
    return going


def _wraps_after(clock: Floats, frames: Floats) -> int | None:
    """The number after which a count of frames begins anew each second; None where no second ends in between."""
    known = np.isfinite(clock)
    clock, frames = clock[known], frames[known]
    steps, ticks = np.diff(frames), np.diff(clock)
    within = steps[(ticks == 0.0) & (steps > 0.0)]
    ends = np.flatnonzero(ticks == 1.0)
    if not len(ends) or not len(within):
        return None
    step, most = float(np.median(within)), float(frames.max())
    after = np.round(frames[ends] + step - frames[ends + 1])
    values, votes = np.unique(after[after > most], return_counts=True)
    if len(values):
        best = int(values[votes.argmax()])
        if best in COUNTS or (votes.max() >= SURE and votes.max() > 0.5 * len(ends)):
            return best
    return next((count for count in COUNTS if count > most), None)
