"""Write docs/fit.md: how well feature points are found on heads in any pose, what is refused, how long it takes.

    .venv/bin/python tools/fit_report.py [--heads FOLDER] [--part known second ...] [--errors]

FOLDER holds the shared heads (`ict.npz` ...). Each part leaves its figures in out/fit/, so that parts can be measured
one at a time; the page is written when all are there. `--errors` also writes presets/anatomy/point_errors.csv from
the heads that are known: confidences are made of it. `--only` measures the heads whose names contain a text, and leaves
figures and page alone; `--json` writes a file of head -> point -> error in mm.
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import Any

import numpy as np
from fit.effect import measure_effect
from fit.heads import SharedHeads
from fit.measuring import SEED, measure_clicks, measure_poses, measure_shapes, measured
from fit.page import page
from fit.sets import SETS
from places import DOCS, OUT, PRESETS, shared_folder

PAGE, FIGURES = DOCS / "fit.md", OUT / "fit"
ERRORS = PRESETS / "anatomy" / "point_errors.csv"

PARTS = (*SETS, "poses", "shapes", "clicks", "effect")


def main() -> None:
    """Measure the parts that are asked for; write the page when all are there."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--heads", type=Path, default=shared_folder() / "heads")
    parser.add_argument("--part", nargs="*", choices=PARTS, default=PARTS)
    parser.add_argument("--errors", action="store_true", help="also write presets/anatomy/point_errors.csv")
    parser.add_argument(
        "--only", default="", help="the heads whose names contain this; figures and page stay as they are"
    )
    parser.add_argument("--json", type=Path, help="write head -> point -> error in mm there")
    arguments = parser.parse_args()
    heads = SharedHeads(arguments.heads)
    FIGURES.mkdir(parents=True, exist_ok=True)
    errors: dict[str, Any] = {}
    for part in arguments.part:
        rows = _measure(part, heads, arguments.only)
        errors |= {row["name"]: row["errors"] for row in rows if part in SETS and "errors" in row}
        if arguments.only:
            continue
        (FIGURES / f"{part}.json").write_text(json.dumps(rows, indent=1))
        if part == "known" and arguments.errors:
            write_errors(rows)
    if arguments.json:
        arguments.json.write_text(json.dumps(errors, indent=1), encoding="utf-8")
    if arguments.only:
        return
    if all((FIGURES / f"{part}.json").is_file() for part in PARTS):
        read = {part: _figures(part) for part in PARTS}
        PAGE.write_text(page(read), encoding="utf-8")


def _figures(part: str) -> list[dict[str, Any]]:
    """What was measured of a part."""
    rows: list[dict[str, Any]] = json.loads((FIGURES / f"{part}.json").read_text())
    return rows


def _measure(part: str, heads: SharedHeads, only: str) -> list[dict[str, Any]]:
    """The rows of one part; of a set of heads, those whose names contain a text."""
    if part == "shapes":
        return measure_shapes()
    if part == "clicks":
        return measure_clicks([*heads.second(), *heads.reserved()], [*_figures("second"), *_figures("reserved")])
    if part == "effect":
        return measure_effect()
    if part == "poses":
        return measure_poses([*heads.known(), *heads.second(), *heads.reserved()])
    rows = []
    for number, head in enumerate(SETS[part](heads)):
        if only not in head.name:
            continue
        rows.append(measured(head, SEED + number))
        errors = list(rows[-1].get("errors", {0: np.nan}).values())
        print(
            part,
            head.name,
            rows[-1].get("score"),
            f"{np.median(errors):.2f} mm",
            rows[-1].get("refused", ""),
            flush=True,
        )
    return rows


def write_errors(rows: list[dict[str, Any]]) -> None:
    """The median error of each point, for the confidences; MediaPipe's estimated points are left out."""
    chosen = [row["errors"] for row in rows if "errors" in row and row["name"] != "mediapipe"]
    names = dict.fromkeys(name for errors in chosen for name in errors)
    medians = {name: np.median([errors[name] for errors in chosen if name in errors]) for name in names}
    lines = [
        "# Median error of each feature point over the heads of docs/fit.md that the finding was tuned on.",
        "# Unit: mm of a real head. Source: own measurement, `make fit-report`.",
        "point,median_mm",
        *(f"{name},{median:.1f}" for name, median in medians.items()),
    ]
    ERRORS.write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
