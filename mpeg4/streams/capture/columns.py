"""Columns of scores as FAPs: action units and blend shapes of trackers, by the tables of presets/capture/.

A FAP is stated in a frame where columns that are there carry most of what the table gives it (by the squares of their
gains, so that those that matter decide); else it is unknown, for an absent column is no zero.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path
from types import MappingProxyType

import numpy as np

from ....arrays import Floats
from ....tables import read_toml
from ...standard import FAP_COUNT
from .shape_names import side_shares
from .shapes import CAPTURE_PRESETS, load_shapes

#: A FAP is stated where known columns carry more than this share of its squared gains.
MOST = 0.5


@dataclass(frozen=True, eq=False)
class ColumnTable:
    """What columns of scores say in FAPs.

    Attributes
    ----------
    gains : column, in lower case -> (68,) FAP units per unit of its score; 0 where it says nothing.
    halves : columns that stand for one side of another: that one, and (68,) the shares of its gains.
    """

    gains: Mapping[str, Floats]
    halves: Mapping[str, tuple[str, Floats]] = field(default_factory=dict)

    def frames(self, columns: Mapping[str, Floats]) -> Floats:
        """(T, 68) FAPs of columns (T,), by name in any case; NaN where unknown, as NaN is in a column."""
        known = {name.lower(): np.asarray(values, dtype=np.float64) for name, values in columns.items()}
        count = max((len(values) for values in known.values()), default=0)
        total, seen, all_of_it = np.zeros((count, FAP_COUNT)), np.zeros((count, FAP_COUNT)), np.zeros(FAP_COUNT)
        for name, gain in self.gains.items():
            all_of_it += gain**2
            parts = [(name, np.ones(FAP_COUNT))] + [
                (half, shares) for half, (whole, shares) in self.halves.items() if whole == name and name not in known
            ]
            for part, shares in parts:
                if part in known:
                    there = ~np.isnan(known[part])
                    total += np.where(there, known[part], 0.0)[:, None] * (gain * shares)
                    seen += there[:, None] * (gain**2 * shares)
        stated = (all_of_it > 0.0) & (seen > MOST * all_of_it)
        return np.where(stated, total, np.nan)


@lru_cache(maxsize=1)
def arkit_columns() -> ColumnTable:
    """The 52 blend shapes, and single sides of those without sides ("browinnerup_l"), at scores from 0 to 1."""
    shapes = load_shapes()
    sideless = [name for name in shapes if not name.endswith(("Left", "Right"))]
    halves = {
        f"{name.lower()}_{side[0]}": (name.lower(), side_shares(side))
        for name in sideless
        for side in ("left", "right")
    }
    gains = {name: np.nan_to_num(shape.frame) for name, shape in shapes.items()}
    return ColumnTable(_by_lower_name(gains), MappingProxyType(halves))


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
