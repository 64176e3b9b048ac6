"""Long work as generators: they yield Progress and return their result."""

from __future__ import annotations

from collections.abc import Callable, Generator
from dataclasses import dataclass
from typing import TypeAlias, TypeVar

from ..errors import ParameterError

T = TypeVar("T")


@dataclass(frozen=True)
class Progress:
    """How far a long work has come: `fraction` in [0, 1] and a `text` for people."""

    fraction: float
    text: str

    def __post_init__(self) -> None:
        if not 0.0 <= self.fraction <= 1.0:
            raise ParameterError("fraction", "must be in [0, 1]", self.fraction)


#: A generator that yields Progress and returns T. Closing it before its end undoes whatever it had begun.
Work: TypeAlias = Generator[Progress, None, T]


def run(work: Work[T], progress: Callable[[Progress], None] | None = None) -> T:
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
