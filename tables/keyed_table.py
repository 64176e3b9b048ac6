"""Tables inside tables, under dotted keys: what TOML and JSON have in common."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Self

from ..errors import FormatError
from .cells import Cells


class KeyedTable(Cells):
    """One table of a file; `key` is its dotted key, empty for the whole file."""

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

    def table(self, name: str, *, optional: bool = False) -> Self:
        """A table inside this one; an absent one is empty where it is optional."""
        cells = self.cells.get(name, {} if optional else None)
        if not isinstance(cells, dict):
            raise self.refuse("must be a table" + self._written("[{}]", name), name)
        return type(self)(self.path, cells, self._dotted(name))

    def tables(self, name: str, *, optional: bool = False) -> dict[str, Self]:
        """The tables inside a table, by name; at least one unless it is optional."""
        outer = self.table(name, optional=optional or name not in self)
        if not outer.cells and not optional:
            raise self.refuse("must have at least one table" + self._written("[{}.NAME]", name), name)
        return {inner: outer.table(inner) for inner in outer}

    def listed(self, name: str) -> list[Self]:
        """A list of tables; empty where there is none."""
        entries = self.cells.get(name, [])
        if not isinstance(entries, list) or not all(isinstance(entry, dict) for entry in entries):
            raise self.refuse("must be a list of tables" + self._written("[[{}]]", name), name)
        return [type(self)(self.path, entry, f"{self._dotted(name)}.{n}") for n, entry in enumerate(entries)]

    def entries(self, name: str) -> Self:
        """A list of anything but tables, as a table of its entries by place: "0", "1", ..."""
        entries = self.cells.get(name)
        if not isinstance(entries, list):
            raise self._broken(name, "a list")
        return type(self)(self.path, {str(n): entry for n, entry in enumerate(entries)}, self._dotted(name))

    def _number(self, name: str) -> object:
        return self.cells.get(name)

    def _numbers(self, name: str) -> object:
        return self.cells.get(name)

    def _texts(self, name: str) -> object:
        return self.cells.get(name)

    def _dotted(self, name: str) -> str:
        """The dotted key of a cell."""
        part = name if re.fullmatch(r"[A-Za-z0-9_-]+", name) else json.dumps(name, ensure_ascii=False)
        return f"{self.key}.{part}" if self.key else part

    def _written(self, brackets: str, name: str) -> str:
        """How such a table is written, as the end of a message."""
        return ""
