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
import time
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path

from fit.sets import SETS
from fit.sheet import Strip, chosen, picture, write_overview
from places import OUT, shared_folder


def main() -> None:
    """Picture the sets that are asked for."""
    parser = argparse.ArgumentParser(description="Contact sheets of found points and of the faces that they make.")
    parser.add_argument("--heads", type=Path, default=shared_folder() / "heads")
    parser.add_argument("--part", nargs="*", choices=SETS, default=list(SETS))
    parser.add_argument("--only", default="", help="the heads whose names contain this, without an overview")
    parser.add_argument("--out", type=Path, default=OUT / "fit")
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
