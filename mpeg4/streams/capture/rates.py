"""The frame rate of rows in time: an even row behind rounded times, or the usual one of uneven times."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ....arrays import Floats

#: A gap is a step longer than this many usual ones; it says nothing of the rate.
LONGEST_STEP = 2.5

#: Rates that recordings have beside whole numbers: of colour television.
BROADCAST = tuple(rate * 1000.0 / 1001.0 for rate in (24.0, 30.0, 48.0, 60.0, 120.0, 240.0))

#: A rate of uneven times that is a whole number within this share is that number.
NEARLY = 0.01

#: Rates that are fitted to exact times are exact to this share.
EXACT = 1e-9

#: An even row may drift by so many intervals against a rate nearby, in all, and still be taken for a row at that rate.
MOST_DRIFT = 0.5

#: Rows from which the first guess of a rate is made; then twice as many, and so on.
FIRST = 8


@dataclass(frozen=True, eq=False)
class Row:
    """Rows in time.

    Attributes
    ----------
    seconds : (T,) from the first on. rate : frames per second. even : whether each is a frame of an even count.
    """

    seconds: Floats
    rate: float
    even: bool


def even_row(seconds: Floats, rounding: float, slack: float) -> Row:
    """The row that times (T,) are of.

    Parameters
    ----------
    seconds : rising, from 0 on.
    rounding : to which they were rounded when they were written, in seconds.
    slack : how far a time may lie from its place in an even row.
    """
    if len(seconds) < 2:
        return Row(seconds, 1.0, even=True)
    interval, counts = _fitted(seconds)
    usual = usual_rate(np.diff(seconds))
    if not (np.diff(counts) > 0).all() or _apart(seconds, counts * interval) > slack:
        return Row(seconds, usual, even=False)
    rate = _known_near(1.0 / interval, rounding / float(seconds[-1]))
    drifts = _apart(seconds, counts / rate) > max(slack, MOST_DRIFT / rate)
    return Row(seconds, usual, even=False) if drifts else Row(counts / rate, rate, even=True)


def _fitted(seconds: Floats) -> tuple[float, Floats]:
    """The interval of an even row near times (T,), and their (T,) places in it, fitted over longer and longer parts."""
    steps = np.diff(seconds)
    interval = float(steps[steps < 1.5 * np.median(steps)].mean())
    count = min(FIRST, len(seconds))
    while True:
        part = seconds[:count]
        places = np.round(part / interval)
        spread = places - places.mean()
        if (spread**2).sum() > 0.0:
            interval = float((spread * part).sum() / (spread**2).sum())
        if count == len(seconds):
            return interval, np.asarray(np.round(seconds / interval))
        count = min(2 * count, len(seconds))


def _apart(seconds: Floats, row: Floats) -> float:
    """How far times lie from a row that may begin a little earlier or later."""
    apart = seconds - row
    return float(np.ptp(apart)) / 2.0


def _known_near(rate: float, share: float) -> float:
    """The rate that a fitted one stands for: whole or of broadcast within `share`, else a whole one nearby."""
    whole = float(max(round(rate), 1))
    broadcast = min(BROADCAST, key=lambda other: abs(other - rate))
    for near, within in ((whole, max(share, EXACT)), (broadcast, max(share, EXACT)), (whole, NEARLY)):
        if abs(near - rate) <= within * rate:
            return near
    return rate


def usual_rate(steps: Floats) -> float:
    """Frames per second of uneven steps (T - 1,), in seconds, without the gaps."""
    usual = float(np.median(steps))
    rate = 1.0 / float(steps[steps <= LONGEST_STEP * usual].mean())
    return float(round(rate)) if abs(rate - round(rate)) < NEARLY * rate and rate >= 1.0 else rate


def shown_rate(rate: float) -> str:
    """A rate for people."""
    return f"{rate:.6g}"
