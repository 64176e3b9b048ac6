"""How faithful the faces are: a page of tables and contact sheets, in out/faithful/.

    make bench-faithful                                     everything; ARGS="..." passes options on
    python tools/bench_faithful.py --no-pictures            tables alone: needs no Blender
    python tools/bench_faithful.py --no-tables --heads ict  the pictures of one head
    python tools/bench_faithful.py --page docs/faithful.md  write the tables there too

Pictures need a Python that has bpy. The heads are looked for where RISORIUS_SHARED says (default: ../shared); without
them `--no-tables --heads default` still works. What whole kinds of expression left out give takes a quarter of an hour
and is a command of its own: `python tools/calibrate.py fit`.
"""

from __future__ import annotations

import argparse
import importlib.util
import multiprocessing
import os
import sys
import time
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path
from typing import Any

from faithful.figures import (
    drawings_explained,
    requests_met,
    scans_explained,
    scans_explained_by_points,
    scans_explained_without,
)
from faithful.heads import HEADS, IDENTITIES, heads_folder, load_face
from faithful.report import Results, page
from places import OUT
from risorius.api import ADDITIONS, Drive, Mechanism
from risorius.errors import RisoriusError

SHEETS = OUT / "faithful"

#: Heads that are pictured: two identities stand for the others.
PICTURED = ("default", "ict", "makehuman", "identity-0", "identity-3")

#: Job -> what does it, and its arguments.
Jobs = dict[tuple[str, str], tuple[Callable[..., Any], tuple[Any, ...]]]


def table_jobs(heads: Sequence[str]) -> Jobs:
    """Everything that is measured on some heads."""
    jobs: Jobs = {}
    for head in heads:
        jobs["requests", head] = (requests_met, (head,))
        if head == "ict" or head in IDENTITIES:
            jobs["scans", head] = (scans_explained, (head,))
    if "ict" in heads:
        jobs["baselines", "points alone"] = (scans_explained_by_points, ())
        for drive in (Drive.NATURAL, Drive.MUSCLES):
            jobs["drives", f'nothing, drive="{drive}"'] = (scans_explained, ("ict", drive))
        for mechanism in Mechanism:
            jobs["without", mechanism.value] = (scans_explained_without, (mechanism,))
        jobs["without", "all but the second paper"] = (scans_explained_without, ADDITIONS)
    if "makehuman" in heads:
        jobs["drawings", "makehuman"] = (drawings_explained, ())
    return jobs


def picture_jobs(heads: Sequence[str], folder: Path, fine: bool) -> Jobs:
    """The sheets of some heads."""
    jobs: Jobs = {}
    for head in heads:
        jobs["apexes", head] = (picture_apexes, (head, folder, fine))
        if head != "default":
            jobs["comparison", head] = (picture_comparison, (head, folder))
    return jobs


def picture_apexes(head: str, folder: Path, fine: bool) -> list[Path]:
    """The six emotions and the fourteen words of a head."""
    _silence_blender()
    from faithful.apexes import write_apexes

    return write_apexes(head, load_face(head), folder, fine=fine)


def picture_comparison(head: str, folder: Path) -> list[Path]:
    """Expressions of a head beside the model."""
    _silence_blender()
    from faithful.comparison import write_comparison
    from faithful.scans import drawn_shapes, scanned_shapes

    face = load_face(head)
    return write_comparison(head, face, (drawn_shapes if head == "makehuman" else scanned_shapes)(face), folder)


def _silence_blender() -> None:
    """Blender tells of every picture on the process's own output."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    for stream in (1, 2):
        os.dup2(nowhere, stream)


def run(jobs: Jobs, workers: int) -> dict[str, dict[str, Any]]:
    """Kind -> name -> what the job gave, in the jobs' order; says what is done."""
    started = time.monotonic()
    done: dict[tuple[str, str], Any] = {}
    with ProcessPoolExecutor(workers, mp_context=multiprocessing.get_context("spawn")) as pool:
        futures = {pool.submit(job, *arguments): key for key, (job, arguments) in jobs.items()}
        try:
            for number, future in enumerate(as_completed(futures), 1):
                kind, name = key = futures[future]
                done[key] = future.result()
                print(f"[{number:2d}/{len(jobs)}] {time.monotonic() - started:4.0f} s  {kind}: {name}", flush=True)
        finally:
            pool.shutdown(cancel_futures=True)
    results: dict[str, dict[str, Any]] = {}
    for kind, name in jobs:
        results.setdefault(kind, {})[name] = done[kind, name]
    return results


def results_of(found: dict[str, dict[str, Any]]) -> Results:
    """The tables' figures from what the jobs gave."""
    return Results(
        scans=found.get("scans", {}),
        baselines=found.get("baselines", {}).get("points alone", {}),
        drives=found.get("drives", {}),
        without=found.get("without", {}),
        drawings=found.get("drawings", {}).get("makehuman", {}),
        requests=found.get("requests", {}),
    )


def main(arguments: Sequence[str]) -> int:
    """The command line of the module; returns the exit code."""
    parser = argparse.ArgumentParser(description="How faithful the faces are: tables and contact sheets.")
    parser.add_argument("--heads", nargs="+", choices=HEADS, help="these heads only")
    parser.add_argument("--no-tables", action="store_true")
    parser.add_argument("--no-pictures", action="store_true")
    parser.add_argument("--fine", action="store_true", help="smoother pictures of the apexes, in four times the time")
    parser.add_argument("--out", type=Path, default=SHEETS, help="folder for faithful.md and the pictures")
    parser.add_argument("--page", type=Path, help="write the tables to this file too")
    parser.add_argument("--jobs", type=int, default=min(os.cpu_count() or 1, 4), help="processes at once")
    given = parser.parse_args(arguments)
    pictured = given.heads or PICTURED
    if not given.no_pictures and importlib.util.find_spec("bpy") is None:
        parser.error("this Python has no bpy: use `make bench-faithful`, or leave pictures out with --no-pictures")
    try:
        if given.heads != ["default"]:
            heads_folder()
        given.out.mkdir(parents=True, exist_ok=True)
        jobs = {} if given.no_pictures else picture_jobs(pictured, given.out.resolve(), given.fine)
        jobs |= {} if given.no_tables else table_jobs(given.heads or HEADS)
        found = run(jobs, given.jobs)
    except RisoriusError as error:
        print(f"bench-faithful: {error}", file=sys.stderr)
        return 1
    if not given.no_tables:
        text = page(results_of(found))
        print("\n" + text)
        for path in filter(None, (given.out / "faithful.md", given.page)):
            path.write_text(text, encoding="utf-8")
    written = [path for kind in ("apexes", "comparison") for paths in found.get(kind, {}).values() for path in paths]
    print("".join(f"{path}\n" for path in written), end="")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
