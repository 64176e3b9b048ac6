"""Give every reader of files damaged ones for a while; each must be read to finite numbers or refused in words.

    .venv/bin/python tools/fuzz.py [--seconds 60] [--seed 1] [--only READER ...]
    .venv/bin/python tools/fuzz.py --again out/fuzz/mesh-1-77.obj

A file that fails is saved in out/fuzz/; `--again` reads it once more. With a Python that has Blender's module, what
Risorius keeps in a .blend is read, too.
"""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path

from fuzzing.attempts import Reader, outcome
from fuzzing.readers import readers
from fuzzing.watch import watched
from places import OUT

FOLDER = OUT / "fuzz"


def main(arguments: list[str]) -> int:
    """Fuzz, or read files again; 1 where something failed."""
    parser = argparse.ArgumentParser(description="Give every reader damaged files.")
    parser.add_argument("--seconds", type=float, default=60.0, help="how long; every reader gets its seeds at least")
    parser.add_argument("--seed", type=int, help="another seed, other files; else one by the clock, which is printed")
    parser.add_argument("--only", nargs="+", metavar="READER", help="some readers alone")
    parser.add_argument("--out", type=Path, default=FOLDER, help="where failing files are saved")
    parser.add_argument("--again", nargs="+", type=Path, metavar="FILE", help="read saved files again")
    options = parser.parse_args(arguments)
    known = readers()
    if options.again:
        return again(options.again, {reader.name: reader for reader in known})
    seed = options.seed if options.seed is not None else int(time.time()) % 100_000
    chosen = [reader for reader in known if not options.only or reader.name in options.only]
    if not chosen:
        parser.error(f"no such reader; there are {', '.join(reader.name for reader in known)}")
    print(f"seed {seed}: {len(chosen)} readers for {options.seconds:g} s", flush=True)
    report = watched(chosen, options.out, seconds=options.seconds, seed=seed)
    for reader in chosen:
        counts = [report.counts[reader.name, came] for came in ("read", "refused", "bad")]
        print(f"{reader.name:<20}{counts[0]:>7} read {counts[1]:>7} refused {counts[2]:>5} failed")
    for path, wrong in report.failures:
        print(f"\n{path}\n{wrong}\nAgain: python tools/fuzz.py --again {path}")
    print(f"\n{sum(report.counts.values())} files, {len(report.failures)} failed")
    return 1 if report.failures else 0


def again(paths: list[Path], known: dict[str, Reader]) -> int:
    """Read saved files again, whose names begin with their reader's."""
    failed = 0
    for path in paths:
        reader = known[path.name.split("-")[0]]
        came, wrong = outcome(reader, path)
        print(f"{path}: {came}\n{wrong}")
        failed += came == "bad"
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
