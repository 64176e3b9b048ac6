"""Columns of scores as FAPs: action units and blend shapes of trackers, by the tables of presets/capture/.

A FAP is stated in a frame where columns that are there carry most of what the table gives it (by the squares of their
gains, so that those that matter decide); else it is unknown, for an absent column is no zero.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from types import MappingProxyType

import numpy as np

from ....arrays import Floats
from ....tables import read_toml
from ...standard import FAP_COUNT
from .shapes import CAPTURE_PRESETS, load_shapes

#: A FAP is stated where known columns carry more than this share of its squared gains.
MOST = 0.5


@dataclass(frozen=True, eq=False)
class ColumnTable:
    """What columns of scores say in FAPs.

    Attributes
    ----------
    gains : column, in lower case -> (68,) FAP units per unit of its score; 0 where it says nothing.
    """

    gains: Mapping[str, Floats]

    def frames(self, columns: Mapping[str, Floats]) -> Floats:
        """(T, 68) FAPs of columns (T,), by name in any case; NaN where unknown, as NaN is in a column."""
        known = {name.lower(): np.asarray(values, dtype=np.float64) for name, values in columns.items()}
        count = max((len(values) for values in known.values()), default=0)
        total, seen, all_of_it = np.zeros((count, FAP_COUNT)), np.zeros((count, FAP_COUNT)), np.zeros(FAP_COUNT)
        for name, gain in self.gains.items():
            all_of_it += gain**2
            if name not in known:
                continue
            there = ~np.isnan(known[name])
            total += np.where(there, known[name], 0.0)[:, None] * gain
            seen += there[:, None] * gain**2
        stated = (all_of_it > 0.0) & (seen > MOST * all_of_it)
        return np.where(stated, total, np.nan)


@lru_cache(maxsize=1)
def arkit_columns() -> ColumnTable:
    """The 52 blend shapes by their own names, at scores 0 to 1."""
    return ColumnTable(_by_lower_name({name: np.nan_to_num(shape.frame) for name, shape in load_shapes().items()}))


@lru_cache(maxsize=8)
def load_columns(path: Path = CAPTURE_PRESETS / "openface.toml") -> ColumnTable:
    """Columns made of blend shapes: rows ``[columns.NAME]`` with `full` (the score at full strength) and `shapes`.

    Raises
    ------
    FormatError : names the file, the key and the rule.
    """
    shapes, gains = load_shapes(), {}
    for name, row in read_toml(path).tables("columns").items():
        full, parts = row.number("full", above=0.0), row.table("shapes")
        gains[name] = np.zeros(FAP_COUNT)
        for shape in parts:
            if shape not in shapes:
                raise parts.refuse("is not a blend shape of arkit.toml", shape)
            gains[name] = gains[name] + np.nan_to_num(shapes[shape].frame) * (parts.number(shape) / full)
    return ColumnTable(_by_lower_name(gains))


def _by_lower_name(gains: Mapping[str, Floats]) -> Mapping[str, Floats]:
    """Trackers differ in the case of names ("EyeBlinkLeft", "eyeBlinkLeft")."""
    return MappingProxyType({name.lower(): gain for name, gain in gains.items()})
