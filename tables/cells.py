"""Named cells of one place in a file, each read by the rule that it must keep."""

from __future__ import annotations

import difflib
import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any, TypeGuard, TypeVar

import numpy as np

from ..arrays import Floats
from ..errors import FormatError, ParameterError
from .json_text import LARGEST

T = TypeVar("T")
S = TypeVar("S", bound=str)

#: Characters of a wrong cell that a message shows.
SHOWN = 40
#: No whole number is larger: NumPy has none.
LONGEST = (1 << 63) - 1


class Cells(ABC):
    """The cells of a table of TOML or JSON, or of a row of CSV.

    Every reader takes the cell's name. A cell that is absent, or empty in CSV, gives the reader's default; without a
    default it is refused.
    """

    def __init__(self, path: Path, cells: Mapping[str, Any]) -> None:
        self.path, self.cells = path, cells

    def __contains__(self, name: object) -> bool:
        """Whether the cell is there and holds something."""
        return name in self.cells and self.cells[str(name)] != ""

    def __iter__(self) -> Iterator[str]:
        """Names of all cells, in the file's order."""
        return iter(self.cells)

    @abstractmethod
    def refuse(self, problem: str, name: str | None = None) -> FormatError:
        """The error for one cell, or for the whole place."""

    @abstractmethod
    def _number(self, name: str) -> object:
        """A cell as a number, where it can be read so."""

    @abstractmethod
    def _numbers(self, name: str) -> object:
        """A cell as a list of numbers, where it can be read so."""

    @abstractmethod
    def _texts(self, name: str) -> object:
        """A cell as a list of texts, where it can be read so."""

    def number(
        self,
        name: str,
        default: float | None = None,
        *,
        above: float | None = None,
        least: float | None = None,
        most: float | None = None,
    ) -> float:
        """A finite number: above `above`, from `least` on, to `most`."""
        if default is not None and name not in self:
            return default
        value = self._number(name)
        found = float(value) if is_number(value) else math.nan
        if math.isnan(found) or not _within(found, above, least, most):
            raise self._broken(name, "a number" + _bounds(above, least, most))
        return found

    def integer(
        self, name: str, default: int | None = None, *, least: int | None = None, most: int | None = None
    ) -> int:
        """A whole number, from `least` to `most`."""
        if default is not None and name not in self:
            return default
        value = self._number(name)
        if isinstance(value, bool) or not isinstance(value, int) or not -LONGEST <= value <= LONGEST:
            raise self._broken(name, "a whole number" + _bounds(None, least, most))
        if not _within(value, None, least, most):
            raise self._broken(name, "a whole number" + _bounds(None, least, most))
        return value

    def text(self, name: str, default: str | None = None) -> str:
        """A text; without a default it must say something."""
        if default is not None and name not in self:
            return default
        value = self.cells.get(name)
        if not isinstance(value, str) or not value.strip():
            raise self._broken(name, "a text")
        return value

    def choice(self, name: str, options: Iterable[S], default: S | None = None) -> S:
        """One of some texts, or of the members of a StrEnum."""
        if default is not None and name not in self:
            return default
        known = list(options)
        for option in known:
            if self.cells.get(name) == option:
                return option
        raise self._broken(name, "one of " + ", ".join(known))

    def numbers(self, name: str, *shape: int | None) -> Floats:
        """Finite numbers of a shape, of which None is any length; any count without one. In CSV with blanks between."""
        wanted = shape or (None,)
        try:
            found = np.array(self._numbers(name))
        except ValueError:  # a ragged list
            found = np.array(None)
        if found.shape == (0,) and wanted[0] in (None, 0):  # an empty list has no inner lists to count
            return np.zeros([size or 0 for size in wanted])
        fits = found.ndim == len(wanted) and all(n in (None, m) for n, m in zip(wanted, found.shape, strict=True))
        if not fits or found.dtype.kind not in "if" or not (np.abs(found) <= LARGEST).all():
            sizes = " x ".join("N" if n is None else str(n) for n in wanted)
            raise self._broken(name, f"{sizes} finite numbers")
        return found.astype(np.float64)

    def texts(self, name: str) -> tuple[str, ...]:
        """Texts; in CSV words with blanks between."""
        value = self._texts(name)
        if not isinstance(value, list) or not all(isinstance(part, str) for part in value):
            raise self._broken(name, "a list of texts")
        return tuple(value)

    def only(self, *names: str) -> None:
        """Refuse cells of any other name: a misspelt one would say nothing."""
        for name in self:
            if name not in names:
                near = difflib.get_close_matches(name, names, n=1)
                hint = f"did you mean {near[0]}?" if near else f"use one of {', '.join(names)}"
                raise self.refuse(f"is unknown: {hint}", name)

    def made(self, make: Callable[[], T], name: str | None = None) -> T:
        """What `make` makes of the cells; where it refuses a parameter, the error says where in the file it stands.

        That is the cell of the parameter's name, or else the cell `name`, or the whole place.
        """
        try:
            return make()
        except ParameterError as error:
            told = f"{error.rule}, but it is {error.value!r}"
            if error.name in self:
                raise self.refuse(told, error.name) from error
            raise self.refuse(f"{error.name} {told}", name) from error

    def _broken(self, name: str, rule: str) -> FormatError:
        """The error for a cell that is absent or is not what it must be."""
        if name not in self:
            return self.refuse(f"is missing: it must be {rule}", name)
        return self.refuse(f"must be {rule}, but it is {repr(self.cells[name])[:SHOWN]}", name)


def is_number(value: object, *, most: float = LARGEST) -> TypeGuard[int | float]:
    """Whether it is a number, no truth value, neither NaN nor beyond `most` on either side."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        return False
    return abs(value) <= most


def _within(value: float, above: float | None, least: float | None, most: float | None) -> bool:
    """Whether a number keeps its bounds."""
    return (above is None or value > above) and (least is None or value >= least) and (most is None or value <= most)


def _bounds(above: float | None, least: float | None, most: float | None) -> str:
    """The bounds of a number, in words."""
    if least is not None and most is not None:
        return f" from {least:.12g} to {most:.12g}"
    told = [f"above {above:.12g}"] if above is not None else []
    told += [f"{least:.12g} or more"] if least is not None else []
    told += [f"{most:.12g} or less"] if most is not None else []
    return (" " if above is not None else ", ") + ", ".join(told) if told else ""
