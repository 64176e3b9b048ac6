"""When the rows of a recording are: one model of time for every format.

Rows state a time, a number, or nothing (`Stamps`). From these come the rate, the gaps and the order (`placed`), and
what had to be assumed, in words. Times that were rounded when they were written are put back into their even row.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from ....arrays import Floats, Ints
from ....errors import FormatError, ParameterError
from ....tables import large
from ...standard import check_fps
from .rates import LONGEST_STEP, Row, even_row, shown_rate

#: Frames per second where nothing says them, for every format.
USUAL_RATE = 30.0

#: Frames per second of a recording; others are no times.
SLOWEST, FASTEST = 1.0, 1000.0

#: Frames per second of recordings whose times are in another unit than they say: of cameras, and not of any clock.
SLOW, FAST = 5.0, 250.0

#: Units of time, in seconds, with their names.
UNITS = {1.0: "seconds", 1e-3: "milliseconds", 1e-6: "microseconds", 1e-9: "nanoseconds"}

#: Seconds from the beginning of a recording; more are of a clock.
LONGEST_TAKE = 86400.0

#: Rates that agree to this share are the same.
SAME = 1e-6

#: Parts of a count to which frame numbers are exact, without and with fractions.
EXACT, FINE = 1e-6, 0.02

#: Of the rows, this share may repeat the time before; more, and the times are none or the file holds several faces.
FEW = 0.34


def _refusal(row: int, problem: str) -> FormatError:
    """The error for a row of a file that has no name."""
    return FormatError("recording", problem, line=row + 1)


@dataclass(frozen=True, eq=False)
class Stamps:
    """What the rows of a file say of when they are.

    Attributes
    ----------
    count : rows.
    seconds : (T,) times, in `unit`; NaN where a row states none. None: the file has no times.
    unit : seconds of one unit of them; None: the file does not say.
    numbers : (T,) frame numbers, which may have fractions. None: the file has none.
    counted : frames per second in which they count; None: the file does not say.
    clock : seconds of a time by the file's own clock, where it is written as a text.
    assumed : what was assumed so far, in words for people.
    refuse : the error for one row.
    """

    count: int
    seconds: Floats | None = None
    unit: float | None = None
    numbers: Floats | None = None
    counted: float | None = None
    clock: Callable[[str], float] | None = None
    assumed: tuple[str, ...] = ()
    refuse: Callable[[int, str], FormatError] = _refusal


@dataclass(frozen=True, eq=False)
class Times:
    """When the rows of a recording are.

    Attributes
    ----------
    seconds : (T,) of the rows that were kept, rising, from the first on.
    rows : (T,) places of these rows in the file.
    rate : usual frames per second.
    even : whether every row is a frame of an even count; then what lies between others is missing.
    origin : seconds of the first row by the file's own clock. clock : as `Stamps.clock`.
    assumed : what the file does not say and was assumed, in words for people.
    """

    seconds: Floats
    rows: Ints
    rate: float
    even: bool
    origin: float = 0.0
    clock: Callable[[str], float] | None = None
    assumed: tuple[str, ...] = ()

    @property
    def begins(self) -> str | None:
        """What is to be said where the file's own times do not begin at 0 and are those of a recording; else None."""
        if self.clock is not None or not LONGEST_STEP / self.rate < self.origin < LONGEST_TAKE:
            return None
        return f"its times begin at {self.origin:.6g} s, which is frame 0"

    def since_first(self, start: float | str | None) -> float:
        """Seconds from the first row to a time of the file's own clock, as a number of seconds or a timecode.

        Raises
        ------
        ParameterError : it is neither, or the recording is over by then.
        """
        if start is None:
            return 0.0
        rule = "must be seconds, or a timecode where the recording has timecodes"
        try:
            clock = float(start)
        except ValueError:
            if self.clock is None:
                raise ParameterError("start", rule, start) from None
            clock = self.clock(str(start))
        if not math.isfinite(large(clock)):
            raise ParameterError("start", rule, start)
        if clock - self.origin > self.seconds[-1]:
            last = self.origin + float(self.seconds[-1])
            raise ParameterError("start", f"must not be later than the last row, which is at {last:.6g} s", start)
        return clock - self.origin


def placed(stamps: Stamps, rate: float | None = None) -> Times:
    """When the rows are.

    Parameters
    ----------
    rate : frames per second that a caller names; None: what the file says, or shows.

    Raises
    ------
    ParameterError : the rate is outside its rule.
    FormatError : a row is earlier than the one before; the times are none. Names the row and the remedy.
    """
    checked_rate(rate)
    if stamps.count == 0:
        raise stamps.refuse(0, "must be one of several rows: nothing was recorded")
    if stamps.seconds is None or not np.isfinite(stamps.seconds).any():
        return _by_number(stamps, rate)
    stated = stamps.seconds[np.isfinite(stamps.seconds)]
    steps = np.abs(np.diff(stated))
    steps = steps[steps > 0.0]
    if len(stated) > 1 and not len(steps):
        return _by_number(_all_the_same(stamps, rate), rate)
    if not len(steps):
        return _by_time(stamps, stamps.unit or 1.0, rate)
    usual = float(np.median(steps))
    counting = _counting(stamps, stated, usual)
    if counting is not None:
        return _by_number(counting, rate)
    unit = _unit_of(stamps, usual)
    if unit is not None:
        return _by_time(stamps, unit, rate)
    if rate is None:
        problem = (
            f"has times that are {usual:g} apart: that is no frame rate from {SLOWEST:g} to {FASTEST:g} per second;"
            " name the rate (--rate)"
        )
        raise stamps.refuse(int(np.flatnonzero(np.isfinite(stamps.seconds))[0]), problem)
    return _by_number(_without_times(stamps, f"its times, {usual:g} apart, are no times"), rate)


def checked_rate(rate: float | None) -> None:
    """Refuse a rate that is none."""
    if rate is not None:
        check_fps(rate, "rate")


def _without_times(stamps: Stamps, why: str) -> Stamps:
    """The stamps without times that are none."""
    return replace(stamps, seconds=None, assumed=(*stamps.assumed, why))


def _all_the_same(stamps: Stamps, rate: float | None) -> Stamps:
    """Times that do not go on are none: zeros are what single images have, all others want a rate."""
    assert stamps.seconds is not None
    stated = np.flatnonzero(np.isfinite(stamps.seconds))
    if rate is None and stamps.seconds[stated[0]] != 0.0:
        raise stamps.refuse(int(stated[1]), "must be later than the row before: name the rate (--rate)")
    return _without_times(stamps, f"its times are all {stamps.seconds[stated[0]]:g}")


def _counting(stamps: Stamps, stated: Floats, usual: float) -> Stamps | None:
    """Times that count images, by ones or by thousandths of a second, are their numbers."""
    for step, named in ((1.0, (None,)), (1e-3, (None, 1.0))):
        counts = np.asarray(stated) / step
        if stamps.unit in named and abs(usual / step - 1.0) < 1e-6 and _whole(counts) and counts[0] in (0.0, 1.0):
            if step != 1.0 and not (np.abs(np.diff(counts) - 1.0) < 1e-6).all():
                continue
            numbers = stamps.numbers if stamps.numbers is not None else np.asarray(stamps.seconds) / step
            why = f"its times are those of single images, {step:g} apart"
            return replace(_without_times(stamps, why), numbers=numbers)
    return None


def _unit_of(stamps: Stamps, usual: float) -> float | None:
    """The unit in which times that are usually so far apart make a frame rate: the file's own before others."""
    named = stamps.unit or 1.0
    if _is_rate(1.0 / (usual * named)):
        return named
    return next((unit for unit in UNITS if SLOW <= 1.0 / (usual * unit) <= FAST), None)


def _is_rate(rate: float) -> bool:
    """Whether frames per second are those of a recording."""
    return SLOWEST * (1.0 - SAME) <= rate <= FASTEST * (1.0 + SAME)


def _by_time(stamps: Stamps, unit: float, rate: float | None) -> Times:
    """Rows by their times."""
    seconds, assumed = np.asarray(stamps.seconds) * unit, stamps.assumed
    if unit != (stamps.unit or 1.0):
        assumed = (*assumed, f"its times are in {UNITS[unit]}")
    rounding = _rounding(seconds, unit)
    if stamps.numbers is not None and _agree(seconds, stamps.numbers, rounding):
        seconds = seconds[0] + (stamps.numbers - stamps.numbers[0]) * _slope(seconds, stamps.numbers)
    rows, left_out = _rising(stamps, seconds)
    origin = float(seconds[rows[0]])
    found = even_row(_since_first(stamps, rows, seconds), rounding, rounding)
    assumed = (*assumed, *left_out)
    return _finished(stamps, found, rows, origin, rate, assumed)


def _by_number(stamps: Stamps, rate: float | None) -> Times:
    """Rows by their numbers, or by their places."""
    numbers, assumed = stamps.numbers, stamps.assumed
    if numbers is None or not (np.diff(numbers[np.isfinite(numbers)]) != 0.0).any():
        numbers = np.arange(float(stamps.count))
    rows, left_out = _rising(stamps, numbers)
    kept, since = numbers[rows], _since_first(stamps, rows, numbers)
    assumed = (*assumed, *left_out)
    if stamps.counted is None and rate is None:
        assumed = (*assumed, f"the file contains no times: {USUAL_RATE:g} frames per second")
    counted = stamps.counted or rate or USUAL_RATE
    if rate is None and not _is_rate(counted):
        problem = f"is of a file that states {counted:g} frames per second: name the rate (--rate)"
        raise stamps.refuse(int(rows[0]), problem)
    whole = bool((kept == np.floor(kept)).all())
    exactness = (EXACT, FINE, 1.0) if whole and stamps.counted is not None else (EXACT, FINE)
    tried = (even_row(since / counted, parts / counted, parts / counted) for parts in exactness)
    found = next((row for row in tried if row.even), None) or even_row(since / counted, 0.0, 0.0)
    known = (found.rate, counted)
    agrees = rate is None or any(abs(rate / other - 1.0) < SAME for other in known)
    return _finished(stamps, found, rows, float(kept[0]) / counted, None if agrees else rate, assumed)


def _finished(
    stamps: Stamps, found: Row, rows: Ints, origin: float, rate: float | None, assumed: tuple[str, ...]
) -> Times:
    """Times of rows, at the rate that a caller names where it differs from the file's."""
    if len(rows) < 2:
        if rate is None and stamps.seconds is not None:
            assumed = (*assumed, f"a single row shows no frame rate: {USUAL_RATE:g} frames per second")
        return Times(found.seconds, rows, rate or USUAL_RATE, found.even, origin, stamps.clock, assumed)
    if rate is None or abs(rate / found.rate - 1.0) < SAME:
        return Times(found.seconds, rows, found.rate, found.even, origin, stamps.clock, assumed)
    said = f"its own {shown_rate(found.rate)} frames per second are overruled by the rate of {shown_rate(rate)}"
    return Times(found.seconds * (found.rate / rate), rows, rate, found.even, origin, stamps.clock, (*assumed, said))


def _rising(stamps: Stamps, values: Floats) -> tuple[Ints, tuple[str, ...]]:
    """Rows whose values rise, and what was left out, in words; one that falls back is refused."""
    kept, silent, repeated, last = [], 0, [], -math.inf
    for row, value in enumerate(values):
        if not math.isfinite(value):
            silent += 1
        elif value == last:
            repeated.append(row)
        elif value < last:
            raise stamps.refuse(row, "must be later than the row before: sort the rows by time")
        else:
            kept.append(row)
            last = value
    if len(repeated) > max(1.0, FEW * len(values)):
        problem = f"is one of {len(repeated)} rows that repeat the time before: keep one row per frame"
        raise stamps.refuse(repeated[0], problem)
    said = []
    if silent:
        said.append(f"{silent} row{'s state' if silent > 1 else ' states'} no time: left out")
    if repeated:
        said.append(f"{len(repeated)} row{'s repeat' if len(repeated) > 1 else ' repeats'} the time before: left out")
    return np.array(kept, dtype=np.int64), tuple(said)


def _since_first(stamps: Stamps, rows: Ints, values: Floats) -> Floats:
    """Values of rows from the first one on; one so far away that its neighbours run together is refused."""
    since = values[rows] - values[rows[0]]
    lost = np.flatnonzero(~(np.diff(since) > 0.0))
    if len(lost):
        problem = "is so far from the first row that rows cannot be told apart: correct the time of either"
        raise stamps.refuse(int(rows[lost[0] + 1]), problem)
    return np.asarray(since)


def _agree(seconds: Floats, numbers: Floats, rounding: float) -> bool:
    """Whether times are frame numbers at one rate, but for rounding."""
    if len(numbers) < 3 or not (np.isfinite(seconds).all() and (np.diff(numbers) > 0.0).all()):
        return False
    slope = _slope(seconds, numbers)
    apart = (seconds - seconds[0]) - slope * (numbers - numbers[0])
    return bool(slope > 0.0 and np.ptp(apart) <= rounding * (1.0 + 1e-3))


def _slope(seconds: Floats, numbers: Floats) -> float:
    """Seconds from one number to the next, by least squares."""
    away = numbers - numbers.mean()
    return float((away * (seconds - seconds.mean())).sum() / (away**2).sum())


def _rounding(seconds: Floats, unit: float) -> float:
    """The seconds that times were rounded to when they were written, at most."""
    if unit < 1.0 and _whole(seconds / unit):
        return unit
    return next((10.0**-digits for digits in range(7) if _whole(seconds * 10.0**digits)), 1e-6)


def _whole(values: Floats) -> bool:
    """Whether all are whole numbers, but for what double precision loses."""
    values = values[np.isfinite(values)]
    return bool(np.all(np.abs(values - np.round(values)) <= 1e-4 + 4e-16 * np.abs(values)))
