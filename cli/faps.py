"""FAPs for people and as JSON: those that have a value, each with its name."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from ..arrays import Floats

if TYPE_CHECKING:
    from ..api import FapStream


def fap_lines(faps: Floats) -> list[str]:
    """The FAPs (68,) that have a value, a line each."""
    from .. import api

    named = ((api.fap(index + 1), value) for index, value in enumerate(faps) if not math.isnan(value))
    return [f"F{fap.number:<3} {fap.name:<24} {value:8.1f}  {fap.unit}" for fap, value in named]


def named_faps(faps: Floats) -> dict[str, float]:
    """FAP name -> value, without the FAPs that have none."""
    from .. import api

    return {api.fap(index + 1).name: float(value) for index, value in enumerate(faps) if not math.isnan(value)}


def ranges_of(stream: FapStream) -> dict[int, tuple[float, float]]:
    """FAP number -> its least and greatest value in a stream, without the FAPs that have none."""
    found = {}
    for index, column in enumerate(stream.frames.T):
        values = column[~np.isnan(column)]
        if len(values):
            found[index + 1] = float(values.min()), float(values.max())
    return found


def range_lines(ranges: Mapping[int, tuple[float, float]]) -> list[str]:
    """Ranges of FAPs, a line each."""
    from .. import api

    return [
        f"F{number:<3} {api.fap(number).name:<24} {low:8.0f} .. {high:8.0f}" for number, (low, high) in ranges.items()
    ]
