"""Reading tables of anatomy."""

from __future__ import annotations

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
