"""The anatomy of the natural mode as data: ranges of FAPs, action units, emotions as sums of them.

In millimetres on the template face, so that figures of different FAPs compare; FAP units are carried to any face by its
own FAP units, so nothing is tuned again. Source of the figures: presets/anatomy/synergies.toml and ranges.csv.
"""

from __future__ import annotations

import csv
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from ...arrays import Floats, Ints
from ...errors import FormatError
from ...mpeg4 import FAPS
from ..mesh.fap_units import TEMPLATE_FAPU, unit_length
from ..mesh.template import ANATOMY, MM
from ..tables import read_toml

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


def _number(path: Path, key: str, value: object) -> float:
    """A finite number of a table."""
    try:
        number = float(value) if isinstance(value, int | float | str) and not isinstance(value, bool) else np.nan
    except ValueError:
        number = np.nan
    if not np.isfinite(number):
        raise FormatError(path, f"must be a number, not {value!r}", key=key)
    return number


def _ranges(path: Path) -> dict[str, Floats]:
    """Columns of the range table by name."""
    with path.open(encoding="utf-8") as stream:
        rows = list(csv.DictReader(line for line in stream if not line.startswith("#")))
    for column in RANGE_COLUMNS:
        if not rows or column not in rows[0]:
            raise FormatError(path, f"needs the columns {', '.join(RANGE_COLUMNS)} and source", key=column)
    columns = {
        column: np.array([_number(path, f"FAP {row['fap']}, {column}", row[column]) for row in rows])
        for column in RANGE_COLUMNS
    }
    for number, below, above, low, high in zip(*columns.values(), strict=True):
        if number not in FAPS:
            raise FormatError(path, "names a FAP that does not exist", key=f"FAP {number:g}")
        if not below < 0.0 < above:
            raise FormatError(path, "must reach below and above 0", key=f"FAP {number:g}")
        if not (0.0 < low < 1.0 and 0.0 < high < 1.0):
            raise FormatError(path, "low_linear and high_linear must lie between 0 and 1", key=f"FAP {number:g}")
    return columns


def _table(path: Path, raw: Mapping[str, Any], key: str) -> Mapping[str, Any]:
    """A table under a dotted key."""
    found: Any = raw
    for part in key.split("."):
        found = found.get(part) if isinstance(found, dict) else None
    if not isinstance(found, dict):
        raise FormatError(path, "must be a table", key=key)
    return found


def _halves(paired: bool) -> tuple[str, ...]:
    """Suffixes of a unit's halves."""
    return ("_l", "_r") if paired else ("",)


def _units(path: Path, raw: Mapping[str, Any], row_of: Mapping[int, int]) -> dict[str, Floats]:
    """Half unit -> (m,) mm per amount."""
    columns: dict[str, Floats] = {}
    for unit, entry in _table(path, raw, "units").items():
        key = f"units.{unit}"
        if not isinstance(entry, dict) or not isinstance(entry.get("paired"), bool):
            raise FormatError(path, "needs paired = true or false", key=key)
        for half in _halves(entry["paired"]):
            column = np.zeros(len(row_of))
            for name, value in _table(path, raw, f"{key}.faps").items():
                fap = int(name) if name.isdigit() else 0
                target = mirror_fap(fap) if half == "_r" and fap in FAPS else fap
                if target not in row_of:
                    raise FormatError(path, f"names FAP {name}, which has no range", key=key)
                sign = -1.0 if half == "_r" and fap in SIDEWAYS else 1.0
                column[row_of[target]] += (
                    sign * _number(path, f"{key}.faps.{name}", value) * template_millimetres(target)
                )
            columns[unit + half] = column
    return columns


def _sums(path: Path, raw: Mapping[str, Any], units: Sequence[str]) -> dict[str, Floats]:
    """Half sum -> (k,) amounts of half units; a unit in the middle gives half of itself to either half."""
    at = {name: i for i, name in enumerate(units)}
    columns: dict[str, Floats] = {}
    for emotion in _table(path, raw, "sums"):
        key = f"sums.{emotion}"
        for half in ("_l", "_r"):
            column = np.zeros(len(units))
            for unit, value in _table(path, raw, key).items():
                amount = _number(path, f"{key}.{unit}", value)
                if unit + half in at:
                    column[at[unit + half]] = amount
                elif unit in at:
                    column[at[unit]] = amount / 2.0
                else:
                    raise FormatError(path, f"names unit {unit}, which is not in units", key=key)
            columns[emotion + half] = column
    return columns


def _hidden(path: Path, raw: Mapping[str, Any]) -> dict[str, dict[str, float]]:
    """Unit -> muscle -> metres per amount."""
    return {
        unit: {
            muscle: MM * _number(path, f"hidden.{unit}.{muscle}", value)
            for muscle, value in _table(path, raw, f"hidden.{unit}").items()
        }
        for unit in _table(path, raw, "hidden")
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
    path = folder / "synergies.toml"
    raw = read_toml(path)
    units = _units(path, raw, {int(n): i for i, n in enumerate(numbers)})
    sums = _sums(path, raw, tuple(units))
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
        hidden=_hidden(path, raw),
    )
