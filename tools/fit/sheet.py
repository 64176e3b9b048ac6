"""The contact sheet of one head, as a job of its own, and the overview of a set of heads."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from risorius.arrays import Floats

from .heads import SharedHeads, TrueHead
from .sets import SETS

EMOTIONS = ("joy", "surprise", "fear", "anger", "sadness", "disgust")

#: Meshes above this size take minutes a picture.
LARGEST = 100_000
#: Pixels of a picture; the overview's are half as large.
WIDTH, HEIGHT = 260, 312


@dataclass(frozen=True)
class Strip:
    """What the overview shows of a head: its name, a remark, and pictures (height, width, 3)."""

    name: str
    remark: str
    pictures: Sequence[Floats]


def chosen(folder: Path, part: str) -> Iterator[TrueHead]:
    """The heads of a set that can be pictured."""
    return (head for head in SETS[part](SharedHeads(folder)) if len(head.vertices) <= LARGEST)


def picture(folder: Path, part: str, name: str, out: Path) -> Strip:
    """Write the sheet of one head; a job of its own."""
    _silence_blender()
    from .portrait import portrait

    head = next(head for head in chosen(folder, part) if head.name == name)
    return portrait(
        head,
        EMOTIONS,
        out / (re.sub(r"[^\w.]+", "-", f"{part} {name}").strip("-") + ".png"),
        width=WIDTH,
        height=HEIGHT,
    )


def write_overview(strips: Sequence[Strip], part: str, out: Path) -> Path:
    """One sheet of all heads."""
    from faithful.sheet import Cell, write_grid

    high, wide = HEIGHT // 2, WIDTH // 2
    blank = np.zeros((high, wide, 3))
    cells = []
    for strip in strips:
        small = [p.reshape(high, 2, wide, 2, 3).mean(axis=(1, 3)) for p in strip.pictures]
        cells.append(Cell(strip.name, strip.remark, [*small, *[blank] * (len(EMOTIONS) + 1 - len(small))]))
    heading = f"{part}: points found, then {', '.join(EMOTIONS)}"
    return write_grid(cells, out / f"overview-{part}.png", columns=2, heading=heading)


def _silence_blender() -> None:
    """Blender tells of every picture on the process's own output."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    for stream in (1, 2):
        os.dup2(nowhere, stream)
