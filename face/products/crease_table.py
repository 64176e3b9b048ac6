"""The table of creases: where on the template squeezed skin wrinkles, how, and from which compression on."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Any

import numpy as np

from ...arrays import Floats
from ...errors import FormatError
from ..mesh.template import ANATOMY, MM
from ..tables import read_toml

_WORDS = ("sides", "look", "lines_mm", "of", "reason")
_FIGURES = ("spacing_mm", "width_mm", "depth_mm", "onset", "full", "wander")


class Look(StrEnum):
    """How a crease looks."""

    LINES = "lines"
    PEBBLES = "pebbles"
    UNSEEN = "unseen"


@dataclass(frozen=True)
class CreaseRow:
    """One row of the table of creases; lengths in metres of head space.

    Attributes
    ----------
    name : what it is called. paired : there is one on each side. look : how it looks.
    lines : each (k, 3) on the template, ordered across; of a pair the left ones.
    spacing, width, depth : from line to line; half width and depth of a valley.
    onset, full : compressions at which the crease begins and is full.
    of : the crease across whose lines compression is taken.
    wander : how far a line strays from its course, in widths.
    reason : why it lies there.
    """

    name: str
    paired: bool
    look: Look
    lines: tuple[Floats, ...]
    spacing: float
    width: float
    depth: float
    onset: float
    full: float
    of: str
    wander: float
    reason: str


def _line(points: Any, *, joined: bool) -> list[Floats]:
    """The one or two lines that an entry stands for."""
    line = np.array(points, dtype=np.float64) * MM
    if line.ndim != 2 or line.shape[1] != 3 or len(line) < 2:
        raise ValueError("a line needs two or more points of three numbers")
    if not joined:
        return [line]
    mirrored = line * np.array([-1.0, 1.0, 1.0])
    return [np.concatenate([mirrored[:0:-1], line])] if line[0, 0] == 0.0 else [line, mirrored]


def _row(path: Path, name: str, raw: Mapping[str, Any]) -> CreaseRow:
    """The crease of a table's entry."""
    key = f"creases.{name}"
    if set(raw) != {*_WORDS, *_FIGURES}:
        raise FormatError(path, f"a crease has {', '.join((*_WORDS, *_FIGURES))} and nothing else", key=key)
    if raw["sides"] not in ("pair", "joined"):
        raise FormatError(path, f'sides must be "pair" or "joined", not {raw["sides"]!r}', key=key)
    try:
        look = Look(raw["look"])
        lines = [line for points in raw["lines_mm"] for line in _line(points, joined=raw["sides"] == "joined")]
        spacing, width, depth, onset, full, wander = (float(raw[figure]) for figure in _FIGURES)
    except (ValueError, TypeError) as problem:
        raise FormatError(path, str(problem), key=key) from None
    if not lines or min(spacing, width, depth) <= 0.0 or not 0.0 <= onset < full or wander < 0.0:
        raise FormatError(path, "needs lines, positive spacing, width and depth, and onset below full", key=key)
    return CreaseRow(
        name=name,
        paired=raw["sides"] == "pair",
        look=look,
        lines=tuple(lines),
        spacing=spacing * MM,
        width=width * MM,
        depth=depth * MM,
        onset=onset,
        full=full,
        of=str(raw["of"]),
        wander=wander,
        reason=str(raw["reason"]),
    )


def read_creases(path: Path = ANATOMY / "creases.toml") -> list[CreaseRow]:
    """The creases of a table.

    Raises
    ------
    FormatError : names the file, the key and the rule that is broken.
    """
    rows = [_row(path, name, entry) for name, entry in read_toml(path).get("creases", {}).items()]
    names = {row.name for row in rows}
    for row in rows:
        if row.of not in names:
            raise FormatError(path, f"of must name a crease of the table, not {row.of!r}", key=f"creases.{row.name}")
    return rows
