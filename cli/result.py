"""What a verb has to say, for people and as JSON."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, is_dataclass


@dataclass(frozen=True)
class Result:
    """What a verb has to say: `data` for --json, `lines` for people; `code` is the exit code."""

    data: Mapping[str, object]
    lines: Sequence[str]
    code: int = 0


class UsageError(Exception):
    """Options that do not go together."""


def plain(value: object) -> object:
    """What json can write: paths as strings, arrays as lists, NaN as null, dataclasses as objects."""
    if is_dataclass(value) and not isinstance(value, type):
        return {field.name: plain(getattr(value, field.name)) for field in fields(value)}
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if hasattr(value, "tolist"):
        return plain(value.tolist())
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value if value is None or isinstance(value, str | int | float | bool) else str(value)
