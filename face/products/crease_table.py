"""The table of creases: where on the template squeezed skin wrinkles, how, and from which compression on."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path

import numpy as np

from ...arrays import Floats
from ...tables import TomlTable, read_toml
from ..figures import ANATOMY, Length, Pair, Share, read_figures
from ..mesh.template import MM

KEYS = (
    "sides", "look", "lines_mm", "of", "reason", "spacing_mm", "width_mm", "depth_mm", "onset", "full", "wander",
)  # fmt: skip


@dataclass(frozen=True)
class CreaseFigures:
    """Of all creases (presets/anatomy/creases.toml)."""

    averaged: Length
    ends: Share
    fades: Pair
    far: float


CREASES = read_figures("creases.every", CreaseFigures)


class Look(StrEnum):
    """How a crease looks."""

    LINES = "lines"
    PEBBLES = "pebbles"
    UNSEEN = "unseen"


@dataclass(frozen=True, eq=False)
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


def _lines(row: TomlTable, *, joined: bool) -> Iterator[Floats]:
    """The lines of a crease; those of a joined one on both sides."""
    entries = row.entries("lines_mm")
    for place in entries:
        line = entries.numbers(place, None, 3) * MM
        if len(line) < 2:
            raise entries.refuse("must be two or more points", place)
        mirrored = line * np.array([-1.0, 1.0, 1.0])
        if not joined:
            yield line
        elif line[0, 0] == 0.0:
            yield np.concatenate([mirrored[:0:-1], line])
        else:
            yield from (line, mirrored)


def _crease(name: str, row: TomlTable) -> CreaseRow:
    """The crease of a table's entry."""
    row.only(*KEYS)
    paired = row.choice("sides", ("pair", "joined")) == "pair"
    onset = row.number("onset", least=0.0)
    return CreaseRow(
        name=name,
        paired=paired,
        look=row.choice("look", Look),
        lines=tuple(_lines(row, joined=not paired)),
        spacing=MM * row.number("spacing_mm", above=0.0),
        width=MM * row.number("width_mm", above=0.0),
        depth=MM * row.number("depth_mm", above=0.0),
        onset=onset,
        full=row.number("full", above=onset),
        of=row.text("of"),
        wander=row.number("wander", least=0.0),
        reason=row.text("reason"),
    )


def read_creases(path: Path = ANATOMY / "creases.toml") -> list[CreaseRow]:
    """The creases of a table.

    Raises
    ------
    FormatError : names the file, the key and the rule that is broken.
    """
    entries = read_toml(path).tables("creases")
    for entry in entries.values():
        entry.choice("of", entries)
    return [_crease(name, entry) for name, entry in entries.items()]
