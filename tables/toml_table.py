"""TOML files as tables of checked cells."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ..errors import FormatError
from ..files import read_bytes
from .cells import Cells

#: Characters that a TOML text must not hold as they are.
ESCAPES = {"\\": "\\\\", '"': '\\"', "\n": "\\n", "\t": "\\t", "\r": "\\r"}


class TomlTable(Cells):
    """One table of a TOML file; `key` is its dotted key, empty for the whole file."""

    def __init__(self, path: Path, cells: Mapping[str, Any], key: str = "") -> None:
        super().__init__(path, cells)
        self.key = key

    def refuse(self, problem: str, name: str | None = None) -> FormatError:
        """The error for one cell, or for the whole table."""
        return FormatError(self.path, problem, key=(self.key or None) if name is None else self._dotted(name))

    def flag(self, name: str, default: bool | None = None) -> bool:
        """True or false."""
        if default is not None and name not in self:
            return default
        value = self.cells.get(name)
        if not isinstance(value, bool):
            raise self._broken(name, "true or false")
        return value

    def table(self, name: str, *, optional: bool = False) -> TomlTable:
        """A table inside this one; an absent one is empty where it is optional."""
        cells = self.cells.get(name, {} if optional else None)
        if not isinstance(cells, dict):
            raise self.refuse(f"must be a table: begin it with [{self._dotted(name)}]", name)
        return TomlTable(self.path, cells, self._dotted(name))

    def tables(self, name: str, *, optional: bool = False) -> dict[str, TomlTable]:
        """The tables inside a table, by name; at least one unless it is optional."""
        outer = self.table(name, optional=optional or name not in self)
        if not outer.cells and not optional:
            raise self.refuse(f"must have at least one table: begin it with [{self._dotted(name)}.NAME]", name)
        return {inner: outer.table(inner) for inner in outer}

    def listed(self, name: str) -> list[TomlTable]:
        """A list of tables, [[name]]; empty where there is none."""
        entries = self.cells.get(name, [])
        if not isinstance(entries, list) or not all(isinstance(entry, dict) for entry in entries):
            raise self.refuse(f"must be a list of tables: begin each with [[{self._dotted(name)}]]", name)
        return [TomlTable(self.path, entry, f"{self._dotted(name)}.{n}") for n, entry in enumerate(entries)]

    def _number(self, name: str) -> object:
        return self.cells.get(name)

    def _numbers(self, name: str) -> object:
        return self.cells.get(name)

    def _texts(self, name: str) -> object:
        return self.cells.get(name)

    def _dotted(self, name: str) -> str:
        """The dotted key of a cell."""
        part = name if re.fullmatch(r"[A-Za-z0-9_-]+", name) else toml_text(name)
        return f"{self.key}.{part}" if self.key else part


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


def toml_text(text: str) -> str:
    """A text as TOML has it."""
    letters = (ESCAPES.get(letter, letter) for letter in text)
    return '"' + "".join(c if len(c) > 1 or c.isprintable() else f"\\U{ord(c):08X}" for c in letters) + '"'


def toml_number(value: float) -> str:
    """A number as TOML has it, without the noise of single precision."""
    return repr(round(float(value), 6))
