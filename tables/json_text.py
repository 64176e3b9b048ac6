"""Text of JSON as Python's own values, within bounds that no file of use exceeds."""

from __future__ import annotations

import json
import math
import re
from typing import Any

import numpy as np

#: How deep lists and objects may lie inside one another: deeper than in any file of use, and no reader is lost in it.
DEEPEST = 100
#: Numbers beyond this are read as infinite, which all readers refuse: what is computed with it and less stays finite.
LARGEST = 1e30
#: Digits from which a whole number is beyond that; Python refuses thousands of them, and NumPy those beyond its own.
LONG = 31
#: Characters that are looked at together.
AT_ONCE = 1 << 20

MAY_BE_LARGE = re.compile(rf"[eE]\+?\d\d|\d{{{LONG}}}")
TEXTS = re.compile(r'"(?:[^"\\]|\\.)*"?', re.DOTALL)
STEPS = np.zeros(256, dtype=np.int8)
STEPS[[ord("["), ord("{")]] = 1
STEPS[[ord("]"), ord("}")]] = -1


def parsed_json(text: str) -> Any:
    """The value of a text.

    Raises
    ------
    ValueError : it is not JSON (json.JSONDecodeError, which knows the line), or nested too deeply.
    """
    if depth_of(text) > DEEPEST and depth_of(TEXTS.sub("", text)) > DEEPEST:
        raise ValueError(f"lists and objects lie more than {DEEPEST} deep inside one another")
    if MAY_BE_LARGE.search(text):
        return json.loads(text, parse_int=number_of_text, parse_float=number_of_text)
    return json.loads(text)


def depth_of(text: str) -> int:
    """How deep brackets lie inside one another; those inside texts count, too."""
    deepest = depth = 0
    for begin in range(0, len(text), AT_ONCE):
        letters = np.frombuffer(text[begin : begin + AT_ONCE].encode("ascii", errors="replace"), dtype=np.uint8)
        depths = depth + np.cumsum(STEPS[letters], dtype=np.int64)
        deepest, depth = max(deepest, int(depths.max(initial=0))), int(depths[-1])
    return deepest


def number_of_text(text: str) -> int | float:
    """The number that a text is.

    Raises
    ------
    ValueError : it is none.
    """
    try:
        return int(text) if len(text) < LONG else large(float(text))
    except ValueError:
        return large(float(text))


def large(value: float) -> float:
    """A number, infinite where it is larger than any of use."""
    return value if not abs(value) > LARGEST else math.copysign(math.inf, value)
