"""TOML files as tables of checked cells."""

from __future__ import annotations

import math
import re
import tomllib
from pathlib import Path

from ..errors import FormatError, ParameterError
from ..files import read_bytes
from .json_text import large
from .keyed_table import KeyedTable

#: Characters that a TOML text must not hold as they are.
ESCAPES = {"\\": "\\\\", '"': '\\"', "\n": "\\n", "\t": "\\t", "\r": "\\r"}


class TomlTable(KeyedTable):
    """One table of a TOML file."""

    def _written(self, brackets: str, name: str) -> str:
        return (
            ": begin "
            + ("each" if brackets.startswith("[[") else "it")
            + " with "
            + brackets.format(self._dotted(name))
        )


def read_toml(path: str | Path) -> TomlTable:
    """A TOML file.

    Raises
    ------
    FormatError : it cannot be read, or is not TOML; names the line.
    """
    file = Path(path)
    try:
        return TomlTable(file, tomllib.loads(read_bytes(file).decode("utf-8-sig")))
    except UnicodeDecodeError as error:
        raise FormatError(file, "is not UTF-8 text: save it as UTF-8", offset=error.start) from error
    except tomllib.TOMLDecodeError as error:
        place = re.search(r" \(at line (\d+), column \d+\)$", str(error))
        problem, line = (str(error)[: place.start()], int(place[1])) if place else (str(error), None)
        raise FormatError(file, f"is not valid TOML: {problem}", line=line) from error
    except (ValueError, RecursionError) as error:  # a number of thousands of digits, brackets a thousand deep
        raise FormatError(file, f"is not valid TOML: {error}") from error


def toml_text(text: str) -> str:
    """A text as TOML has it."""
    letters = (ESCAPES.get(letter, letter) for letter in text)
    return '"' + "".join(c if len(c) > 1 or c.isprintable() else f"\\U{ord(c):08X}" for c in letters) + '"'


def toml_number(value: float) -> str:
    """A number as TOML has it, without the noise of single precision.

    Raises
    ------
    ParameterError : one that no reader takes.
    """
    if not math.isfinite(large(float(value))):
        raise ParameterError("a number in a file", "must be finite, within any use", value)
    return repr(round(float(value), 6))
