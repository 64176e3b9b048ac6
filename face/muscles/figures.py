"""How tables of muscles write the figures of a row: by the types of a row's fields."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields, replace
from enum import StrEnum
from functools import cache
from pathlib import Path
from types import MappingProxyType
from typing import Annotated, Any, TypeAlias, get_origin, get_type_hints

import numpy as np

from ...arrays import Floats
from ...errors import FormatError
from ..mesh.fap_units import TEMPLATE_FAPU
from ..mesh.template import MM, TEMPLATE_POINTS, TemplateWarp
from ..tables import finite_number

#: Offsets in the table are given in these units of the template: ES0, ENS0, ENS0 (metres).
OFFSET_UNITS: Floats = np.array([TEMPLATE_FAPU.es0, TEMPLATE_FAPU.ens0, TEMPLATE_FAPU.ens0])


def _kept(value: Any, turn: Floats, warp: TemplateWarp) -> Any:
    """A figure that is the same on every face."""
    return value


def _warped(value: Floats, turn: Floats, warp: TemplateWarp) -> Floats:
    """Places of the left side on a side of a face."""
    return warp(value * turn)


def _turned(value: Floats, turn: Floats, warp: TemplateWarp) -> Floats:
    """A direction of the left side on a side of a face."""
    return value * turn


@dataclass(frozen=True)
class Figure:
    """One figure of a row.

    Attributes
    ----------
    read : (file, key, entry) -> value in SI units; raises a FormatError.
    carry : (value, mirror (3,) of the side, warp) -> value on a face.
    unit : what the table's key has after the field's name, such as "_mm".
    field : name of the row's field.
    """

    read: Callable[[Path, str, Any], Any]
    carry: Callable[[Any, Floats, TemplateWarp], Any] = _kept
    unit: str = ""
    field: str = ""


def _text(path: Path, key: str, entry: Any) -> str:
    """Words."""
    if not isinstance(entry, str):
        raise FormatError(path, f"must be words, not {entry!r}", key=key)
    return entry


def _angle(path: Path, key: str, entry: Any) -> float:
    """Degrees, as radians."""
    return float(np.radians(finite_number(path, key, entry)))


def _length(path: Path, key: str, entry: Any) -> float:
    """Millimetres above 0, as metres."""
    if not finite_number(path, key, entry) > 0.0:
        raise FormatError(path, f"must be positive, not {entry!r}", key=key)
    return MM * float(entry)


def _listed(path: Path, key: str, entry: Any, count: int, what: str) -> list[Any]:
    """A list of so many entries."""
    if not isinstance(entry, list) or len(entry) != count:
        raise FormatError(path, f"needs {what}", key=key)
    return entry


def _radii(path: Path, key: str, entry: Any) -> tuple[float, float]:
    """Two lengths."""
    wide, high = _listed(path, key, entry, 2, "two lengths, to the side and up")
    return _length(path, key, wide), _length(path, key, high)


def _numbers(path: Path, key: str, entry: Any, what: str) -> Floats:
    """(3,) numbers."""
    return np.array([finite_number(path, key, one) for one in _listed(path, key, entry, 3, what)])


def _direction(path: Path, key: str, entry: Any) -> Floats:
    """(3,) left, up, forward."""
    return _numbers(path, key, entry, "a direction of three numbers")


def _place(path: Path, key: str, entry: Any) -> Floats:
    """(3,) a feature point of the template and an offset from it."""
    point = entry.get("point") if isinstance(entry, dict) else None
    if not isinstance(point, str) or point not in TEMPLATE_POINTS:
        raise FormatError(path, f"names feature point {point!r}, which the template lacks", key=key)
    offset = _numbers(path, key, entry.get("offset"), "an offset of three numbers in units of ES0, ENS0, ENS0")
    return TEMPLATE_POINTS[point] + offset * OFFSET_UNITS


def _line(path: Path, key: str, entry: Any) -> Floats:
    """(2, 3) two places."""
    return np.stack([_place(path, key, one) for one in _listed(path, key, entry, 2, "a line of two places")])


Angle: TypeAlias = Annotated[float, Figure(_angle, unit="_deg")]
"""In degrees in a table, in radians in a row."""

Length: TypeAlias = Annotated[float, Figure(_length, unit="_mm")]
"""Above 0; in millimetres in a table, in metres in a row."""

Radii: TypeAlias = Annotated[tuple[float, float], Figure(_radii, unit="_mm")]
"""To the side and up, as `Length`."""

Place: TypeAlias = Annotated[Floats, Figure(_place, _warped)]
"""(3,) metres of head space; in a table a feature point and an offset. A face has it where the warp carries it."""

Line: TypeAlias = Annotated[Floats, Figure(_line, _warped)]
"""(2, 3) two places."""

Direction: TypeAlias = Annotated[Floats, Figure(_direction, _turned)]
"""(3,) left, up, forward: the same on every face."""


def _choice(options: type[StrEnum]) -> Callable[[Path, str, Any], Any]:
    """Reads a name of an enum."""

    def read(path: Path, key: str, entry: Any) -> Any:
        if entry not in list(options):
            raise FormatError(path, f"must be one of {', '.join(options)}, not {entry!r}", key=key)
        return options(entry)

    return read


def _figure(hint: Any) -> Figure:
    """How a table writes a field of a type."""
    if get_origin(hint) is Annotated:
        figure: Figure = hint.__metadata__[0]
        return figure
    if hint is float:
        return Figure(finite_number)
    if hint is str:
        return Figure(_text)
    if isinstance(hint, type) and issubclass(hint, StrEnum):
        return Figure(_choice(hint))
    raise TypeError(f"no table writes a {hint}")


@cache
def figures_of(row: type, besides: tuple[str, ...]) -> Mapping[str, Figure]:
    """Key in a table -> figure of a kind of row, but for some fields that no table gives."""
    hints = get_type_hints(row, include_extras=True)
    found = {}
    for field in fields(row):
        if field.name not in besides:
            figure = replace(_figure(hints[field.name]), field=field.name)
            found[field.name + figure.unit] = figure
    return MappingProxyType(found)
