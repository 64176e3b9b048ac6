"""How far off found points are, in any pose; what is refused; what clicks mend. A row of figures per head."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np
import risorius.api as api
from risorius.arrays import Floats
from risorius.errors import ModelError
from risorius.face.fit.clicks import ASKED
from risorius.face.fit.doubt import DOUBTFUL_SCORE
from risorius.face.fit.find import locate_points
from risorius.face.mesh.checks import with_pupils
from risorius.face.mesh.fap_units import fapu
from risorius.face.mesh.head_frame import head_frame_of

from . import shapes
from .heads import TrueHead
from .sides import wrong_sides

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
            units.append(vars(fapu(places, head_frame_of(places).axes)))
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
    for name, build in shapes.NON_FACES.items():
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


def measure_clicks(heads: Iterable[TrueHead], rows_before: Iterable[Mapping[str, Any]]) -> list[dict[str, Any]]:
    """Errors of the points that were not clicked, with unsteady clicks, on heads that were doubtful or refused.

    `rows_before` are what `measured` says of the heads without clicks.
    """
    before = {row["name"]: row for row in rows_before}
    random = np.random.default_rng(SEED)
    rows = []
    for head in heads:
        row = before[head.name]
        if row.get("score", np.inf) <= DOUBTFUL_SCORE:
            continue
        clicks = {name: head.points[name] + random.normal(scale=UNSTEADY, size=3) for name in ASKED}
        after = _distances(api.find_points(head.vertices, head.polygons, clicks, topologies=()), head)
        others = {name: error for name, error in after.items() if name not in ASKED}
        rows.append({"name": head.name, "before": row.get("errors", {}), "errors": others})
        print("clicks", head.name, f"{np.median(list(others.values())):.2f} mm", flush=True)
    return rows


def _distances(found: api.FoundPoints, head: TrueHead) -> dict[str, float]:
    """Distance of each found point from the true one, mm."""
    names = found.positions.keys() & head.points.keys()
    return {name: 1000.0 * float(np.linalg.norm(found.positions[name] - head.points[name])) for name in names}
