"""The tables of the natural drive: ranges of FAPs, action units, emotions as sums of them.

In metres on the template face, so that figures of different FAPs compare; FAP units are carried to any face by its own
FAP units, so nothing is tuned again. Source of the figures: presets/anatomy/synergies.toml and ranges.csv.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from pathlib import Path

import numpy as np

from ....arrays import Floats, Ints
from ....mpeg4 import FAP_COUNT, FAPS
from ....tables import CsvRow, KeyedTable, read_csv, read_toml
from ...figures import ANATOMY
from ...mesh.fap_units import TEMPLATE_FAPU, unit_length
from ...mesh.template import MM
from .symmetry import SIDEWAYS, mirror_fap

RANGE_COLUMNS = ("fap", "low_mm", "high_mm", "low_linear", "high_linear", "source")

#: The unit that is the mandible opening, and its FAP.
JAW, JAW_FAP = "AU27", 3


def template_unit(number: int) -> float:
    """Metres on the template per unit of a displacement FAP."""
    return unit_length(FAPS[number].unit, TEMPLATE_FAPU)


@dataclass(frozen=True, eq=False)
class Synergies:
    """Everything the natural drive knows, over the FAPs that have a range (m of them).

    Attributes
    ----------
    numbers : (m,) FAP numbers. low, high : (m,) anatomical range, metres on the template.
    low_linear, high_linear : (m,) share of the range up to which a request passes unchanged.
    units : (m, k) metres per amount of each half unit; `unit_names` (k,) as "AU12_l", "AU27".
    shown : (m, k) the same of units that an emotion word shows.
    unit_spread : unit -> usual amount, of units that need more of a reason than others.
    sums : (k, s) amounts of half units per strength of each half sum; `sum_names` (s,) as "joy_l".
    hidden : unit -> muscle -> metres of muscle amount per amount of the unit.
    """

    numbers: Ints
    low: Floats
    high: Floats
    low_linear: Floats
    high_linear: Floats
    units: Floats
    shown: Floats
    unit_names: tuple[str, ...]
    unit_spread: Mapping[str, float]
    sums: Floats
    sum_names: tuple[str, ...]
    hidden: Mapping[str, Mapping[str, float]]

    @cached_property
    def row_of(self) -> dict[int, int]:
        """FAP number -> row."""
        return {int(number): row for row, number in enumerate(self.numbers)}

    @cached_property
    def per_fap(self) -> Floats:
        """(m,) metres on the template per FAP unit."""
        return np.array([template_unit(int(number)) for number in self.numbers])


def _range(row: CsvRow) -> tuple[int, float, float, float, float]:
    """FAP number, range in metres, and the shares of it up to which a request passes unchanged."""
    number = row.integer("fap", least=3, most=FAP_COUNT)
    if FAPS[number].angular:
        raise row.refuse("must be a FAP that moves a point by a length", "fap")
    low, high = MM * row.number("low_mm"), MM * row.number("high_mm")
    if not low < 0.0 < high:
        raise row.refuse("must reach below and above 0", "low_mm")
    low_linear, high_linear = (row.number(name, above=0.0) for name in ("low_linear", "high_linear"))
    if not max(low_linear, high_linear) < 1.0:
        raise row.refuse("low_linear and high_linear must be between 0 and 1")
    return number, low, high, low_linear, high_linear


def _units(entries: Mapping[str, KeyedTable], row_of: Mapping[int, int], key: str = "faps") -> dict[str, Floats]:
    """Half unit -> (m,) metres per amount, from the figures under a key, or the usual ones where there are none."""
    columns: dict[str, Floats] = {}
    for unit, entry in entries.items():
        faps = entry.table(key if key in entry else "faps")
        for half in ("_l", "_r") if entry.flag("paired") else ("",):
            column = np.zeros(len(row_of))
            for name in faps:
                fap = int(name) if name.isdigit() else 0
                target = mirror_fap(fap) if half == "_r" and fap in FAPS else fap
                if target not in row_of:
                    raise faps.refuse(f"names FAP {name}, which has no range in ranges.csv", name)
                sign = -1.0 if half == "_r" and fap in SIDEWAYS else 1.0
                column[row_of[target]] += sign * faps.number(name) * template_unit(target)
            columns[unit + half] = column
    return columns


def _sums(table: KeyedTable, units: Sequence[str]) -> dict[str, Floats]:
    """Half sum -> (k,) amounts of half units; a unit in the middle gives half of itself to either half."""
    at = {name: i for i, name in enumerate(units)}
    columns: dict[str, Floats] = {}
    for emotion, entry in table.tables("sums").items():
        for half in ("_l", "_r"):
            column = np.zeros(len(units))
            for unit in entry:
                amount = entry.number(unit)
                if unit + half in at:
                    column[at[unit + half]] = amount
                elif unit in at:
                    column[at[unit]] = amount / 2.0
                else:
                    raise entry.refuse(f"names unit {unit}, which is not in units", unit)
            columns[emotion + half] = column
    return columns


def _hidden(table: KeyedTable) -> dict[str, dict[str, float]]:
    """Unit -> muscle -> metres per amount."""
    return {
        unit: {muscle: MM * entry.number(muscle) for muscle in entry} for unit, entry in table.tables("hidden").items()
    }


@lru_cache(maxsize=1)
def load_synergies(folder: Path = ANATOMY) -> Synergies:
    """Read and check the tables once.

    Raises
    ------
    FormatError : names the file, where in it, and the rule.
    """
    ranges = [_range(row) for row in read_csv(folder / "ranges.csv", *RANGE_COLUMNS)]
    numbers, low, high, low_linear, high_linear = (np.array(column) for column in zip(*ranges, strict=True))
    table = read_toml(folder / "synergies.toml")
    entries = table.tables("units")
    row_of = {int(number): row for row, number in enumerate(numbers)}
    units, shown = _units(entries, row_of), _units(entries, row_of, "shown")
    sums = _sums(table, tuple(units))
    return Synergies(
        numbers=numbers.astype(np.int64),
        low=low,
        high=high,
        low_linear=low_linear,
        high_linear=high_linear,
        units=np.column_stack(list(units.values())),
        shown=np.column_stack(list(shown.values())),
        unit_names=tuple(units),
        unit_spread={name: unit.number("spread", above=0.0) for name, unit in entries.items() if "spread" in unit},
        sums=np.column_stack(list(sums.values())),
        sum_names=tuple(sums),
        hidden=_hidden(table),
    )
