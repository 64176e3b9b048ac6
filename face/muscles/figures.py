"""How tables of muscles write the figures of a row: by the types of a row's fields."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields, replace
from enum import StrEnum
from functools import cache
from types import MappingProxyType
from typing import Annotated, Any, TypeAlias, get_origin, get_type_hints

import numpy as np

from ...arrays import Floats
from ...tables import KeyedTable
from ..mesh.fap_units import TEMPLATE_FAPU
from ..mesh.template import MM, TEMPLATE_POINTS, TemplateWarp

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


@dataclass(frozen=True, eq=False)
class Figure:
    """One figure of a row.

    Attributes
    ----------
    read : (row of a table, key) -> value in SI units; raises a FormatError.
    carry : (value, mirror (3,) of the side, warp) -> value on a face.
    unit : what the table's key has after the field's name, such as "_mm".
    field : name of the row's field.
    """

    read: Callable[[KeyedTable, str], Any]
    carry: Callable[[Any, Floats, TemplateWarp], Any] = _kept
    unit: str = ""
    field: str = ""


def _angle(raw: KeyedTable, key: str) -> float:
    """Degrees, as radians."""
    return float(np.radians(raw.number(key)))


def _length(raw: KeyedTable, key: str) -> float:
    """Millimetres above 0, as metres."""
    return MM * raw.number(key, above=0.0)


def _radii(raw: KeyedTable, key: str) -> tuple[float, float]:
    """Two lengths."""
    wide, high = raw.numbers(key, 2).tolist()
    if min(wide, high) <= 0.0:
        raise raw.refuse("must be two lengths above 0, to the side and up", key)
    return MM * wide, MM * high


def _direction(raw: KeyedTable, key: str) -> Floats:
    """(3,) left, up, forward."""
    return raw.numbers(key, 3)


def _place(raw: KeyedTable, key: str) -> Floats:
    """(3,) a feature point of the template and an offset from it."""
    return _at(raw.table(key))


def _line(raw: KeyedTable, key: str) -> Floats:
    """(2, 3) two places."""
    places = raw.listed(key)
    if len(places) != 2:
        raise raw.refuse("must be a line of two places", key)
    return np.stack([_at(place) for place in places])


def _at(place: KeyedTable) -> Floats:
    """(3,) where a place lies on the template."""
    place.only("point", "offset")
    point = place.text("point")
    if point not in TEMPLATE_POINTS:
        raise place.refuse(f"names feature point {point}, which the template lacks", "point")
    return TEMPLATE_POINTS[point] + place.numbers("offset", 3) * OFFSET_UNITS


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


def _figure(hint: Any) -> Figure:
    """How a table writes a field of a type."""
    if get_origin(hint) is Annotated:
        figure: Figure = hint.__metadata__[0]
        return figure
    if hint is float:
        return Figure(lambda raw, key: raw.number(key))
    if hint is str:
        return Figure(lambda raw, key: raw.text(key, "" if key in raw.cells else None))
    if isinstance(hint, type) and issubclass(hint, StrEnum):
        return Figure(lambda raw, key: raw.choice(key, hint))
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
