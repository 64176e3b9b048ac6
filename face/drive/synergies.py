"""The anatomy of the natural mode as data: ranges of FAPs, action units, emotions as sums of them.

In millimetres on the template face, so that figures of different FAPs compare; FAP units are carried to any face by its
own FAP units, so nothing is tuned again. Source of the figures: presets/anatomy/synergies.toml and ranges.csv.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np

from ...arrays import Floats, Ints
from ...mpeg4 import FAPS
from ...tables import TomlTable, read_csv, read_toml
from ..figures import ANATOMY
from ..mesh.fap_units import TEMPLATE_FAPU, unit_length
from ..mesh.template import MM

RANGE_COLUMNS = ("fap", "low_mm", "high_mm", "low_linear", "high_linear")

#: FAPs that point to one side and so change sign in the mirror.
SIDEWAYS = (15, 23, 24, 43, 49, 50, 64)

#: Spread of the prior amount of a unit, and of units that need a reason (nose wrinkler).
UNIT_PRIOR = 0.4
UNIT_PRIORS = {"AU9": 0.24}


def template_millimetres(number: int) -> float:
    """Millimetres on the template per unit of a displacement FAP."""
    return unit_length(FAPS[number].unit, TEMPLATE_FAPU) / MM


def mirror_fap(number: int) -> int:
    """The FAP of the other side, or the same in the middle."""
    return FAPS[number].mirror or number


def mirror_frame(frame: Floats) -> Floats:
    """A frame (68,) as seen in the mirror."""
    mirrored: Floats = frame[[mirror_fap(number) - 1 for number in range(1, len(frame) + 1)]]
    mirrored[np.array(SIDEWAYS) - 1] *= -1.0
    return mirrored


@dataclass(frozen=True)
class Synergies:
    """Everything the natural mode knows, over the FAPs that have a range (m of them).

    Attributes
    ----------
    numbers : (m,) FAP numbers. low, high : (m,) anatomical range, mm on the template.
    low_linear, high_linear : (m,) share of the range up to which a request passes unchanged.
    units : (m, k) mm per amount of each half unit; `unit_names` (k,) as "AU12_l", "AU27".
    sums : (k, s) amounts of half units per strength of each half sum; `sum_names` (s,) as "joy_l".
    hidden : unit -> muscle -> metres of muscle amount per amount of the unit.
    """

    numbers: Ints
    low: Floats
    high: Floats
    low_linear: Floats
    high_linear: Floats
    units: Floats
    unit_names: tuple[str, ...]
    unit_spread: Floats
    sums: Floats
    sum_names: tuple[str, ...]
    hidden: Mapping[str, Mapping[str, float]]

    @property
    def position(self) -> dict[int, int]:
        """FAP number -> row."""
        return {int(n): i for i, n in enumerate(self.numbers)}

    @property
    def per_fap(self) -> Floats:
        """(m,) mm on the template per FAP unit."""
        return np.array([template_millimetres(int(n)) for n in self.numbers])


def _ranges(path: Path) -> dict[str, Floats]:
    """Columns of the range table by name."""
    rows = read_csv(path, *RANGE_COLUMNS, "source")
    for row in rows:
        if row.integer("fap") not in FAPS:
            raise row.refuse("names a FAP that does not exist", "fap")
        if not row.number("low_mm") < 0.0 < row.number("high_mm"):
            raise row.refuse("low_mm and high_mm must reach below and above 0")
        if not (0.0 < row.number("low_linear") < 1.0 and 0.0 < row.number("high_linear") < 1.0):
            raise row.refuse("low_linear and high_linear must lie between 0 and 1")
    return {column: np.array([row.number(column) for row in rows]) for column in RANGE_COLUMNS}


def _halves(paired: bool) -> tuple[str, ...]:
    """Suffixes of a unit's halves."""
    return ("_l", "_r") if paired else ("",)


def _units(raw: TomlTable, row_of: Mapping[int, int]) -> dict[str, Floats]:
    """Half unit -> (m,) mm per amount."""
    columns: dict[str, Floats] = {}
    for unit, entry in raw.tables("units").items():
        faps = entry.table("faps")
        for half in _halves(entry.flag("paired")):
            column = np.zeros(len(row_of))
            for name in faps:
                fap = int(name) if name.isdigit() else 0
                target = mirror_fap(fap) if half == "_r" and fap in FAPS else fap
                if target not in row_of:
                    raise entry.refuse(f"names FAP {name}, which has no range", "faps")
                sign = -1.0 if half == "_r" and fap in SIDEWAYS else 1.0
                column[row_of[target]] += sign * faps.number(name) * template_millimetres(target)
            columns[unit + half] = column
    return columns


def _sums(raw: TomlTable, units: Sequence[str]) -> dict[str, Floats]:
    """Half sum -> (k,) amounts of half units; a unit in the middle gives half of itself to either half."""
    at = {name: i for i, name in enumerate(units)}
    columns: dict[str, Floats] = {}
    for emotion, amounts in raw.tables("sums").items():
        for half in ("_l", "_r"):
            column = np.zeros(len(units))
            for unit in amounts:
                if unit + half in at:
                    column[at[unit + half]] = amounts.number(unit)
                elif unit in at:
                    column[at[unit]] = amounts.number(unit) / 2.0
                else:
                    raise amounts.refuse(f"names unit {unit}, which is not in units", unit)
            columns[emotion + half] = column
    return columns


def _hidden(raw: TomlTable) -> dict[str, dict[str, float]]:
    """Unit -> muscle -> metres per amount."""
    return {
        unit: {muscle: MM * amounts.number(muscle) for muscle in amounts}
        for unit, amounts in raw.tables("hidden").items()
    }


@lru_cache(maxsize=1)
def load_synergies(folder: Path = ANATOMY) -> Synergies:
    """Read and check the tables once.

    Raises
    ------
    FormatError : names the file, key and rule.
    """
    ranges = _ranges(folder / "ranges.csv")
    numbers = ranges["fap"].astype(np.int64)
    raw = read_toml(folder / "synergies.toml")
    units = _units(raw, {int(n): i for i, n in enumerate(numbers)})
    sums = _sums(raw, tuple(units))
    return Synergies(
        numbers=numbers,
        low=ranges["low_mm"],
        high=ranges["high_mm"],
        low_linear=ranges["low_linear"],
        high_linear=ranges["high_linear"],
        units=np.column_stack(list(units.values())),
        unit_names=tuple(units),
        unit_spread=np.array([UNIT_PRIORS.get(name.split("_")[0], UNIT_PRIOR) for name in units]),
        sums=np.column_stack(list(sums.values())),
        sum_names=tuple(sums),
        hidden=_hidden(raw),
    )
