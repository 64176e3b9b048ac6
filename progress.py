"""How far long work is: one protocol for all of it.

Long work is a generator that yields `Progress` and returns its result (`Work`). Closing it before its end cancels it
and leaves everything as it was. A window steps it between events (`operators.base.WorkOperator`); scripts and the
command line drive it to its end with `run`, which calls back with each step. Functions that run straight through and
take `progress` call it in the same way.

    found = run(find_points_steps(vertices, polygons), lambda step: print(f"{step.fraction:.0%} {step.text}"))
"""

from __future__ import annotations

import math
from collections.abc import Callable, Generator
from typing import NamedTuple, Self, TypeAlias, TypeVar

from .errors import ParameterError

T = TypeVar("T")


class _Step(NamedTuple):
    """The fields of `Progress`."""

    fraction: float
    text: str


class Progress(_Step):
    """How far a long work has come: `fraction` in [0, 1], NaN where its end is not known, and a `text` for people."""

    __slots__ = ()

    def __new__(cls, fraction: float, text: str) -> Self:
        """Check the fraction."""
        if not (0.0 <= fraction <= 1.0 or math.isnan(fraction)):
            raise ParameterError("fraction", "must be in [0, 1]", fraction)
        return super().__new__(cls, fraction, text)

    @classmethod
    def counted(cls, done: int, count: int | None, things: str) -> Self:
        """So many things done of so many; of None nobody knows how many there are."""
        if count is None:
            return cls(math.nan, f"{done} {things}")
        return cls(done / count if count else 1.0, f"{done} of {count} {things}")


#: A generator that yields Progress and returns T. Closing it before its end undoes whatever it had begun.
Work: TypeAlias = Generator[Progress, None, T]

#: Called with each step of a work.
Report: TypeAlias = Callable[[Progress], None]


def run(work: Work[T], progress: Report | None = None) -> T:
    """Drive `work` to its end and return its result; `progress` is called with each step."""
    while True:
        try:
            step = next(work)
        except StopIteration as end:
            result: T = end.value
            return result
        if progress is not None:
            progress(step)


def part_of(work: Work[T], start: float, end: float) -> Work[T]:
    """Pass on `work` as the share [start, end] of a larger work: ``result = yield from part_of(...)``."""
    while True:
        try:
            step = next(work)
        except StopIteration as stop:
            result: T = stop.value
            return result
        try:
            yield Progress(start + (end - start) * step.fraction, step.text)
        except GeneratorExit:
            work.close()
            raise
