"""Figures of anatomy: rows of the tables in presets/anatomy, read and checked once into frozen dataclasses.

    @dataclass(frozen=True)
    class TongueFigures:
        sinks: Share
        sinks_by: Length

    TONGUE = read_figures("bodies.tongue", TongueFigures)

reads [tongue] of bodies.toml, which has a row for each field and no others:

    [tongue.sinks_by]
    value = 14
    unit = "mm"
    meaning = "what it is"
    source = "where it is from; stands in [tongue] once where it is the same for all rows"

What is read is in SI units; lengths are metres of head space, as the template is large.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from functools import cache
from pathlib import Path
from typing import Annotated, Any, TypeAlias, TypeVar, get_type_hints

import numpy as np

from ..arrays import Floats
from ..resources import PRESETS
from ..tables import KeyedTable, read_toml

T = TypeVar("T")

ANATOMY = PRESETS / "anatomy"
"""The tables of anatomy."""

UNITS: Mapping[str, float] = {"1": 1.0, "mm": 1e-3, "1/mm^2": 1e6, "deg": float(np.pi / 180.0), "FAP units": 1.0}
"""How much of the SI unit each unit of a row is."""


@dataclass(frozen=True)
class _Shape:
    """What a figure must be: how many numbers (None: one alone), and their bounds, in the row's own unit."""

    count: int | None = None
    above: float | None = None
    least: float | None = None
    most: float | None = None


Length: TypeAlias = Annotated[float, _Shape(above=0.0)]
"""Above 0: a distance, a radius, the width of a change."""

Share: TypeAlias = Annotated[float, _Shape(least=0.0, most=1.0)]
"""From 0 to 1."""

Pair: TypeAlias = Annotated[tuple[float, float], _Shape(count=2)]
"""Two numbers: from and to, or a place and a width, as the row says."""

Place: TypeAlias = Annotated[Floats, _Shape(count=3)]
"""(3,) left, up, forward: on the template's left side, or from what the row names."""

Extent: TypeAlias = Annotated[Floats, _Shape(count=3, above=0.0)]
"""(3,) radii to the side, up and forward, above 0."""

_PLAIN = _Shape()


def read_figures(key: str, kind: type[T], folder: Path = ANATOMY) -> T:
    """One section of a table of anatomy, as a dataclass of that section's figures.

    Parameters
    ----------
    key : file and section, such as "jaw.hinge".
    kind : a frozen dataclass with a field for each row of the section: `float` or one of the types above.

    Raises
    ------
    FormatError : names the file, the key and the rule that is broken.
    """
    file, _, name = key.partition(".")
    section = _read(folder / f"{file}.toml").table(name)
    shapes = _shapes(kind)
    section.only("source", *shapes)
    source = section.text("source", "")
    return kind(**{field: _value(section.table(field), shape, source) for field, shape in shapes.items()})


@cache
def _read(path: Path) -> KeyedTable:
    """A file, read once."""
    return read_toml(path)


def _shapes(kind: type[Any]) -> Mapping[str, _Shape]:
    """Field -> what it must be."""
    hints = get_type_hints(kind, include_extras=True)
    return {f.name: getattr(hints[f.name], "__metadata__", (_PLAIN,))[0] for f in fields(kind)}


def _value(row: KeyedTable, shape: _Shape, source: str) -> Any:
    """A figure in SI units."""
    row.only("value", "unit", "meaning", "source")
    row.text("meaning")
    row.text("source", source or None)
    unit = UNITS[row.choice("unit", UNITS)]
    if shape.count is None:
        return row.number("value", above=shape.above, least=shape.least, most=shape.most) * unit
    values = row.numbers("value", shape.count)
    if shape.above is not None and values.min() <= shape.above:
        raise row.refuse(f"must be numbers above {shape.above:g}", "value")
    return values * unit if shape.count == 3 else tuple((values * unit).tolist())
