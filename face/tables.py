"""Reading tables of anatomy."""

from __future__ import annotations

import math
import tomllib
from pathlib import Path
from typing import Any

from ..errors import FormatError


def read_toml(path: Path) -> dict[str, Any]:
    """The contents of a TOML table.

    Raises
    ------
    FormatError : a file that cannot be read, or is no TOML; names it.
    """
    try:
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except (OSError, tomllib.TOMLDecodeError) as error:
        raise FormatError(path, f"is not a readable TOML table: {error}") from error


def finite_number(path: Path, key: str, entry: object) -> float:
    """A finite number of a table.

    Raises
    ------
    FormatError : anything else; names the file and the key.
    """
    if isinstance(entry, bool) or not isinstance(entry, int | float) or not math.isfinite(entry):
        raise FormatError(path, f"must be a number, not {entry!r}", key=key)
    return float(entry)
