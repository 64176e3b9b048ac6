"""How far long work is: one protocol for all of it.

Long work is a generator that yields `Progress` and returns its result (`Work`). Closing it before its end cancels it
and leaves everything as it was. A window steps it between events (`operators.base.WorkOperator`); scripts and the
command line drive it to its end with `run`, which calls back with each step. Functions that run straight through and
take `progress` call it in the same way.

    found = run(find_points_steps(vertices, polygons), lambda step: print(f"{step.fraction:.0%} {step.text}"))
"""

from __future__ import annotations

import math
from collections.abc import Callable, Generator, Iterator, Sequence
from typing import Any, Generic, NamedTuple, Self, TypeAlias, TypeVar, overload

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


class Writing(Progress):
    """The last step of work that computes first and writes last: what follows yields nothing more."""

    __slots__ = ()


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
            yield type(step)(start + (end - start) * step.fraction, step.text)
        except GeneratorExit:
            work.close()
            raise


def written_together(works: Sequence[Work[T]]) -> Work[list[T]]:
    """Several works that end with `Writing`: all are computed before any is written, so all are done or none."""
    results: list[T] = []
    try:
        for index, work in enumerate(works):
            step: Progress = Progress(0.0, "")
            while not isinstance(step, Writing):
                step = next(work)
                yield Progress((index + step.fraction) / len(works), step.text)
        for work in works:
            results.append(run(work))
    finally:
        for work in works:
            work.close()
    return results


class stepwise(Generic[T]):
    """A property that is worked out once, when first asked for: all at once, or bit by bit by `worked_out`.

    It decorates a method that is a `Work`.
    """

    def __init__(self, method: Callable[[Any], Work[T]]) -> None:
        self._method, self._name, self.__doc__ = method, method.__name__, method.__doc__

    @overload
    def __get__(self, owner: None, kind: type) -> Self: ...
    @overload
    def __get__(self, owner: object, kind: type) -> T: ...
    def __get__(self, owner: object | None, kind: type) -> Self | T:
        # What has been worked out stands in the object's own dictionary, which Python looks at first.
        return self if owner is None else run(self.steps(owner))

    def steps(self, owner: object) -> Work[T]:
        """Work it out for an object and keep it."""
        vars(owner)[self._name] = result = yield from self._method(owner)
        return result


def worked_out(owner: object, name: str) -> Work[None]:
    """Work out a property of an object, where that has not been done, bit by bit where it is `stepwise`."""
    if name in vars(owner):
        return
    found = getattr(type(owner), name)
    if isinstance(found, stepwise):
        yield from found.steps(owner)
    else:
        getattr(owner, name)


class Prepared(Iterator[T]):
    """Things one after the other, and the work that comes before the first of them.

    The work is done when the first is wanted; a window that must not stand still drives `prepare` before.
    """

    def __init__(self, work: Work[Iterator[T]]) -> None:
        self._work: Work[Iterator[T]] | None = work
        self._things: Iterator[T] = iter(())

    @classmethod
    def at_once(cls, things: Iterator[T]) -> Self:
        """Things that need nothing before the first."""

        def nothing() -> Work[Iterator[T]]:
            yield from ()
            return things

        return cls(nothing())

    def prepare(self) -> Work[None]:
        """Do what comes before the first; what goes wrong is raised here."""
        if self._work is not None:
            self._things = yield from self._work
            self._work = None

    def __next__(self) -> T:
        """The next of them."""
        run(self.prepare())
        return next(self._things)
