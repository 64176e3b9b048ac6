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
import os
import time
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import fit_shapes
import numpy as np
import risorius.api as api
from fit_effect import measure_effect
from fit_hard import hard_heads
from fit_heads import SharedHeads, TrueHead
from fit_page import page
from fit_sides import wrong_sides
from risorius.arrays import Floats
from risorius.errors import ModelError
from risorius.face.fit.clicks import ASKED
from risorius.face.fit.doubt import DOUBTFUL_SCORE
from risorius.face.fit.find import locate_points
from risorius.face.mesh.checks import with_pupils
from risorius.face.mesh.fap_units import fapu
from risorius.face.mesh.head_frame import head_frame

ROOT = Path(__file__).resolve().parent.parent
PAGE, FIGURES = ROOT / "docs" / "fit.md", ROOT / "out" / "fit"
ERRORS = ROOT / "presets" / "anatomy" / "point_errors.csv"

#: Random poses of each head that is located again, and what they are made of.
POSES, SEED = 1, 20
LARGEST_SIZE, LARGEST_MOVE = 1e3, 5.0
#: How far clicks miss, metres per axis.
UNSTEADY = 1.5e-3


def moved(head: TrueHead, seed: int) -> tuple[Floats, Callable[[Floats], Floats], float]:
    """A head in a random direction, place and size: its vertices, the way to get there, and its size."""
    random = np.random.default_rng(seed)
    rotation, _ = np.linalg.qr(random.normal(size=(3, 3)))
    rotation *= np.sign(np.linalg.det(rotation))
    size = float(LARGEST_SIZE ** random.uniform(-1.0, 1.0))
    move = random.uniform(-LARGEST_MOVE, LARGEST_MOVE, 3) * size

    def there(places: Floats) -> Floats:
        return np.asarray(places @ rotation.T * size + move)

    return there(head.vertices), there, size


def measured(head: TrueHead, seed: int) -> dict[str, Any]:
    """Errors in mm, confidences, score and FAP units of one head in a random pose."""
    vertices, there, size = moved(head, seed)
    begun = time.process_time()
    try:
        found = api.find_points(vertices, head.polygons, topologies=())
    except ModelError as refused:
        return {"name": head.name, "refused": str(refused)}
    seconds = time.process_time() - begun
    errors = {
        name: 1000.0 * float(np.linalg.norm(place - there(head.points[name]))) / size
        for name, place in found.positions.items()
        if name in head.points
    }
    return {
        "name": head.name,
        "score": found.score,
        "vertices": len(vertices),
        "seconds": seconds,
        "errors": errors,
        "sides": _sides(head, vertices, there, found.positions),
        "confidence": {name: found.confidence[name] for name in errors},
        "units": _unit_errors(found.positions, {name: there(place) for name, place in head.points.items()}),
    }


def _sides(
    head: TrueHead, vertices: Floats, there: Callable[[Floats], Floats], found: Mapping[str, Floats]
) -> list[str] | None:
    """Lip and lid points on the wrong side; None where no face comes of the points."""
    moved_head = replace(head, vertices=vertices, points={name: there(place) for name, place in head.points.items()})
    try:
        return wrong_sides(moved_head, found)
    except ModelError:
        return None


def _unit_errors(found: Mapping[str, Floats], truth: Mapping[str, Floats]) -> dict[str, float]:
    """Relative error of each FAP unit of length; none where closed eyes leave no opening to measure."""
    units = []
    for points in (found, truth):
        whole = with_pupils(
            {name: place for name, place in points.items() if name not in ("3.5", "3.6")}, np.zeros((0, 3))
        )
        places = {name: np.asarray(place) for name, place in whole.items()}
        try:
            units.append(vars(fapu(places, head_frame(places).axes)))
        except ModelError:
            return {}
    return {name: abs(units[0][name] / units[1][name] - 1.0) for name in units[0]}


def measure_poses(heads: Iterable[TrueHead]) -> list[dict[str, Any]]:
    """Whether the frame is right in further poses: the unbent template's points lie near the true ones."""
    rows = []
    for number, head in enumerate(heads):
        for seed in range(POSES):
            vertices, there, size = moved(head, 1000 * SEED + 10 * number + seed)
            row: dict[str, Any] = {"name": head.name, "right": False}
            try:
                located = locate_points(vertices, head.polygons)
                errors = [
                    1000.0 * np.linalg.norm(place - there(head.points[name])) / size
                    for name, place in located.positions.items()
                    if name in head.points and not name.startswith(("10.", "11."))
                ]
                row |= {
                    "score": located.score,
                    "median": float(np.median(errors)),
                    "right": bool(np.median(errors) < 12.0),
                }
            except ModelError as refused:
                row["refused"] = str(refused)
            rows.append(row)
            print("pose", row, flush=True)
    return rows


def measure_shapes() -> list[dict[str, Any]]:
    """What is refused, and how clearly."""
    rows = []
    for name, build in fit_shapes.NON_FACES.items():
        vertices, polygons = build()
        begun = time.process_time()
        try:
            found = locate_points(vertices, polygons, refuse=False)
            score, relief = found.score, found.relief
        except ModelError:
            score, relief = None, None
        rows.append({"name": name, "score": score, "relief": relief, "seconds": time.process_time() - begun})
        print("shape", rows[-1], flush=True)
    return rows


def measure_clicks(heads: SharedHeads) -> list[dict[str, Any]]:
    """Errors of the points that were not clicked, with unsteady clicks, on heads that were doubtful or refused."""
    measured = {row["name"]: row for part in ("second", "reserved") for row in _figures(part)}
    random = np.random.default_rng(SEED)
    rows = []
    for head in [*heads.second(), *heads.reserved()]:
        row = measured[head.name]
        if row.get("score", np.inf) <= DOUBTFUL_SCORE:
            continue
        clicks = {name: head.points[name] + random.normal(scale=UNSTEADY, size=3) for name in ASKED}
        after = _distances(api.find_points(head.vertices, head.polygons, clicks, topologies=()), head)
        others = {name: error for name, error in after.items() if name not in ASKED}
        rows.append({"name": head.name, "before": row.get("errors", {}), "errors": others})
        print("clicks", head.name, f"{np.median(list(others.values())):.2f} mm", flush=True)
    return rows


def _figures(part: str) -> list[dict[str, Any]]:
    """What was measured of a part."""
    rows: list[dict[str, Any]] = json.loads((FIGURES / f"{part}.json").read_text())
    return rows


def _distances(found: api.FoundPoints, head: TrueHead) -> dict[str, float]:
    """Distance of each found point from the true one, mm."""
    names = found.positions.keys() & head.points.keys()
    return {name: 1000.0 * float(np.linalg.norm(found.positions[name] - head.points[name])) for name in names}


def main() -> None:
    """Measure the parts that are asked for; write the page when all are there."""
    parser = argparse.ArgumentParser(description=__doc__)
    default = Path(os.environ.get("RISORIUS_SHARED") or ROOT.parent / "shared") / "heads"
    parser.add_argument("--heads", type=Path, default=default)
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


SETS = ("known", "second", "hard", "reserved")
PARTS = (*SETS, "poses", "shapes", "clicks", "effect")


def _measure(part: str, heads: SharedHeads, only: str) -> list[dict[str, Any]]:
    """The rows of one part; of a set of heads, those whose names contain a text."""
    if part == "shapes":
        return measure_shapes()
    if part == "clicks":
        return measure_clicks(heads)
    if part == "effect":
        return measure_effect()
    if part == "poses":
        return measure_poses([*heads.known(), *heads.second(), *heads.reserved()])
    sets = {
        "known": heads.known,
        "second": heads.second,
        "hard": lambda: hard_heads(heads),
        "reserved": heads.reserved,
    }
    rows = []
    for number, head in enumerate(sets[part]()):
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
