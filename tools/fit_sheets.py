"""Contact sheets of found points and of the faces that they make, in out/fit/: every head, six emotions, two views.

    make fit-sheets                                       every head; ARGS="..." passes options on
    python tools/fit_sheets.py --part known --only toon   some heads of one set

Needs a Python that has bpy, and the shared heads (RISORIUS_SHARED, default: ../shared). Known topologies are switched
off, as no stranger's mesh is known. One sheet per head: the neutral face with its points, coloured by confidence as in
Blender (blue: sure, yellow: look at it, red: probably wrong; black: where the true one is, more than 5 mm off), and six
emotions. overview-SET.png shows all heads of a set.
"""

from __future__ import annotations

import argparse
import multiprocessing
import os
import re
import time
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from fit_hard import hard_heads
from fit_heads import SharedHeads, TrueHead
from risorius.arrays import Floats

ROOT = Path(__file__).resolve().parent.parent
OUT = ROOT / "out" / "fit"
PARTS = ("known", "second", "hard", "reserved")
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
    heads = SharedHeads(folder)
    sets = {
        "known": heads.known,
        "second": heads.second,
        "hard": lambda: hard_heads(heads),
        "reserved": heads.reserved,
    }
    return (head for head in sets[part]() if len(head.vertices) <= LARGEST)


def picture(folder: Path, part: str, name: str, out: Path) -> Strip:
    """Write the sheet of one head; a job of its own."""
    _silence_blender()
    from fit_portrait import portrait

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


def main() -> None:
    """Picture the sets that are asked for."""
    parser = argparse.ArgumentParser(description="Contact sheets of found points and of the faces that they make.")
    default = Path(os.environ.get("RISORIUS_SHARED") or ROOT.parent / "shared") / "heads"
    parser.add_argument("--heads", type=Path, default=default)
    parser.add_argument("--part", nargs="*", choices=PARTS, default=PARTS)
    parser.add_argument("--only", default="", help="the heads whose names contain this, without an overview")
    parser.add_argument("--out", type=Path, default=OUT)
    parser.add_argument("--jobs", type=int, default=2, help="processes at once")
    given = parser.parse_args()
    out = given.out.resolve()
    out.mkdir(parents=True, exist_ok=True)
    names = [(part, head.name) for part in given.part for head in chosen(given.heads, part) if given.only in head.name]
    started = time.monotonic()
    done: dict[tuple[str, str], Strip] = {}
    with ProcessPoolExecutor(given.jobs, mp_context=multiprocessing.get_context("spawn")) as pool:
        futures = {pool.submit(picture, given.heads, part, name, out): (part, name) for part, name in names}
        for number, future in enumerate(as_completed(futures), 1):
            key = futures[future]
            done[key] = future.result()
            elapsed = time.monotonic() - started
            print(f"[{number:2d}/{len(names)}] {elapsed:4.0f} s  {key[0]}: {key[1]}  {done[key].remark}", flush=True)
    for part in given.part if not given.only else ():
        write_overview([done[key] for key in names if key[0] == part], part, out)


if __name__ == "__main__":
    main()
