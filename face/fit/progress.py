"""How far the finding of feature points is."""

from __future__ import annotations

from collections.abc import Generator
from typing import NamedTuple, TypeVar

_T = TypeVar("_T")


class FitProgress(NamedTuple):
    """How far the finding is: `fraction` in [0, 1] and a `text` for people."""

    fraction: float
    text: str


def part_of(steps: Generator[FitProgress, None, _T], start: float, end: float) -> Generator[FitProgress, None, _T]:
    """Some work as the share [start, end] of a larger one."""
    while True:
        try:
            step = next(steps)
        except StopIteration as stop:
            result: _T = stop.value
            return result
        yield FitProgress(start + (end - start) * step.fraction, step.text)
