"""The anatomy of the natural mode as data: ranges of FAPs, action units, emotions as sums of them.

In millimetres on the template face, so that figures of different FAPs compare; FAP units are carried to any face by its
own FAP units, so nothing is tuned again. Source of the figures: presets/anatomy/synergies.toml and ranges.csv.
"""

from __future__ import annotations

import csv
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np

from ..arrays import Floats, Ints
from ..errors import FormatError, ParameterError
from ..mpeg4 import FAPS, Unit
from .template import ANATOMY

#: Millimetres per FAP unit on the template face.
TEMPLATE_UNITS: Mapping[Unit, float] = {
    Unit.IRISD: 9.997 / 1024,
    Unit.ES: 65.634 / 1024,
    Unit.ENS: 48.015 / 1024,
    Unit.MNS: 21.202 / 1024,
    Unit.MW: 50.698 / 1024,
}

#: FAPs that point to one side and so change sign in the mirror.
SIDEWAYS = (15, 64)

#: Spread of the prior amount of a unit, and of units that need a reason (nose wrinkler).
UNIT_PRIOR = 0.4
UNIT_PRIORS = {"AU9": 0.24}


def template_millimetres(number: int) -> float:
    """Millimetres on the template per unit of a displacement FAP."""
    unit = FAPS[number].unit
    if unit is None or unit not in TEMPLATE_UNITS:
        raise ParameterError("FAP", "must be one that moves a point by a length", number)
    return TEMPLATE_UNITS[unit]


def mirror_fap(number: int) -> int:
    """The FAP of the other side, or the same in the middle."""
    return FAPS[number].mirror or number


@dataclass(frozen=True)
class Synergies:
    """Everything the natural mode knows, over the FAPs that have a range (m of them).

    Attributes
    ----------
    numbers : (m,) FAP numbers. low, high : (m,) anatomical range, mm on the template.
    units : (m, k) mm per amount of each half unit; `unit_names` (k,) as "AU12_l", "AU27".
    sums : (k, s) amounts of half units per strength of each half sum; `sum_names` (s,) as "joy_l".
    hidden : unit -> muscle -> metres of muscle amount per amount of the unit.
    """

    numbers: Ints
    low: Floats
    high: Floats
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


def _ranges(path: Path) -> tuple[Ints, Floats, Floats]:
    """Numbers, lows and highs of the range table."""
    with path.open(encoding="utf-8") as stream:
        rows = list(csv.DictReader(line for line in stream if not line.startswith("#")))
    numbers = np.array([int(row["fap"]) for row in rows], dtype=np.int64)
    low = np.array([float(row["low_mm"]) for row in rows])
    high = np.array([float(row["high_mm"]) for row in rows])
    if (low >= 0).any() or (high <= 0).any():
        raise FormatError(path, "every range must reach below and above 0")
    return numbers, low, high


def _halves(paired: bool) -> tuple[str, ...]:
    """Suffixes of a unit's halves."""
    return ("_l", "_r") if paired else ("",)


@lru_cache(maxsize=1)
def load_synergies(folder: Path = ANATOMY) -> Synergies:
    """Read and check the tables once.

    Raises
    ------
    FormatError : names the file, key and rule.
    """
    numbers, low, high = _ranges(folder / "ranges.csv")
    path = folder / "synergies.toml"
    raw = tomllib.loads(path.read_text(encoding="utf-8"))
    row_of = {int(n): i for i, n in enumerate(numbers)}
    names, columns = [], []
    for unit, entry in raw["units"].items():
        for half in _halves(entry["paired"]):
            column = np.zeros(len(numbers))
            for key, value in entry["faps"].items():
                fap = int(key)
                target = mirror_fap(fap) if half == "_r" else fap
                if target not in row_of:
                    raise FormatError(path, f"names FAP {fap}, which has no range", key=f"units.{unit}")
                sign = -1.0 if half == "_r" and fap in SIDEWAYS else 1.0
                column[row_of[target]] += sign * float(value) * template_millimetres(target)
            names.append(unit + half)
            columns.append(column)
    at = {name: i for i, name in enumerate(names)}
    sum_names, sums = [], []
    for emotion, parts in raw["sums"].items():
        for half in ("_l", "_r"):
            column = np.zeros(len(names))
            for unit, amount in parts.items():
                if unit not in raw["units"]:
                    raise FormatError(path, f"names unit {unit}, which is not in units", key=f"sums.{emotion}")
                if raw["units"][unit]["paired"]:
                    column[at[unit + half]] = amount
                else:
                    column[at[unit]] = amount / 2.0
            sum_names.append(emotion + half)
            sums.append(column)
    spread = np.array([UNIT_PRIORS.get(name.split("_")[0], UNIT_PRIOR) for name in names])
    hidden = {unit: {m: float(v) * 1e-3 for m, v in entry.items()} for unit, entry in raw["hidden"].items()}
    return Synergies(
        numbers=numbers,
        low=low,
        high=high,
        units=np.column_stack(columns),
        unit_names=tuple(names),
        unit_spread=spread,
        sums=np.column_stack(sums),
        sum_names=tuple(sum_names),
        hidden=hidden,
    )
