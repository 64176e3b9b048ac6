"""Hold the muscle table against scanned expressions, with whole kinds of expression left out.

    python tools/calibrate.py                    explained variance per shape, and on the other identities
    python tools/calibrate.py fit --folds 5      one damped Gauss-Newton step over all figures of the table: what it
                                                 explains of kinds left out, and of all, per damping
    python tools/calibrate.py fit --save DIR     and the figures it moves, as DIR/<damping>.txt

Only a step whose held-out figures are better than the start's deserves to go into presets/anatomy/muscles/.

The heads are looked for where RISORIUS_SHARED says (default: ../shared). A shape's explained variance is
1 - sum |posed - scanned|^2 / sum |scanned|^2 over the skin, the face being posed (exact drive) from the FAPs
measured on the scan. Figures move within anatomical bounds (`STEPS`, `FARTHEST`), and moving costs.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from faithful.heads import ICT_SKIN, IDENTITIES, load_face
from faithful.scans import Shape, scanned_shapes
from risorius.api import Face
from risorius.arrays import Floats
from risorius.face.drive.plan import Plan
from risorius.face.drive.request import Drive, Request
from risorius.face.mesh.template import MM
from risorius.face.muscles.insertion import force_density
from risorius.face.muscles.placement import place_muscles
from risorius.face.muscles.row import MuscleRow
from risorius.face.muscles.sphincter import SphincterSkinRow
from risorius.face.muscles.table import read_muscles
from risorius.face.posture import Balance

#: Figure -> one step of a fit, its least and largest value; places may go `FARTHEST` from where anatomy has them.
STEPS = {
    "place": (2 * MM, -np.inf, np.inf),
    "angle": (np.radians(6.0), np.radians(10), np.radians(75)),
    "exponent": (0.5, 0.4, 5.0),
    "reach": (0.1, 1.02, 2.6),
    "radii": (0.1, 4 * MM, 70 * MM),
    "fall": (0.15, 0.2, 2.0),
    "power": (0.25, 0.6, 4.0),
    "reaction": (0.1, 0.0, 1.2),
    "reaction_at": (0.05, 0.05, 0.6),
    "bulge": (0.1, 0.0, 1.0),
    "direction": (0.12, -1.5, 1.5),
    "prior": (0.2, 1 * MM, 20 * MM),
}
FARTHEST = 8 * MM

#: A fit looks at every so many-th vertex.
THINNING = 3


class Bench:
    """One face whose muscles can be exchanged, and the scanned shapes to hold it against."""

    def __init__(self, face: Face) -> None:
        self.anatomy = face.anatomy
        self.shapes = scanned_shapes(face)
        self.balance = Balance(self.anatomy)
        self.anatomy.inverse.skin_responses = np.ascontiguousarray(self.anatomy.inverse.skin_responses)
        self.anatomy.actuators.fields = np.ascontiguousarray(self.anatomy.actuators.fields)
        alive = {m.row.name for m in self.anatomy.actuators.muscles}
        self.rows: dict[str, MuscleRow] = {n: row for n, row in read_muscles().items() if n in alive}
        self.place = {m.name: i for i, m in enumerate(self.anatomy.actuators.muscles)}

    def put(self, row: MuscleRow) -> None:
        """Exchange one muscle on both sides."""
        actuators, inverse, sheet, skin = (
            self.anatomy.actuators, self.anatomy.inverse, self.anatomy.sheet, self.anatomy.skin
        )  # fmt: skip
        old = self.rows[row.name]
        self.rows[row.name] = row
        placed = [m for m in place_muscles({row.name: row}, self.anatomy.warp) if m.name in self.place]
        still = inverse._still
        for muscle in placed:
            actuators.muscles[self.place[muscle.name]] = muscle
        if _same_field(old, row):
            return
        forces = np.stack([force_density(skin, m) * skin.areas[:, None] for m in placed])
        shown = sheet.show(sheet.relax(forces))
        for muscle, field in zip(placed, shown, strict=True):
            k = self.place[muscle.name]
            actuators.fields[k] = field / max(np.linalg.norm(field, axis=1).max(), 1e-12)
            still[:, k] = inverse.matrix @ actuators.fields[k].ravel()

    def explained(self, names: Iterable[str] | None = None) -> dict[str, float]:
        """Explained variance of each shape."""
        wanted = None if names is None else set(names)
        return {s.name: s.explained_by(self.moved(s)) for s in self.shapes if wanted is None or s.name in wanted}

    def residuals(self) -> Floats:
        """(shapes, r) what is left, thinned out, as shares whose squares sum up to 1 - explained variance."""
        rest = []
        for shape in self.shapes:
            left = (self.moved(shape) - shape.moved)[::THINNING]
            rest.append(left.ravel() / np.sqrt((shape.moved**2).sum() / THINNING))
        return np.array(rest)

    def moved(self, shape: Shape) -> Floats:
        """Displacement (ICT_SKIN, 3) that the shape's FAPs alone give."""
        posture = self.balance.posture(Plan.as_asked(Request(shape.frame, Drive.EXACT)))
        moved = np.zeros_like(self.anatomy.mesh.positions)
        moved[self.anatomy.given_skin.index] = np.asarray(self.anatomy.carry @ posture.displacement)
        self.anatomy.inner_skin.follow(moved)
        return moved[:ICT_SKIN]


def _same_field(a: MuscleRow, b: MuscleRow) -> bool:
    """Whether two rows differ in their prior alone."""
    left, right = replace(a, prior=0.0, amplitude=0.0), replace(b, prior=0.0, amplitude=0.0)
    return all(np.array_equal(x, y) for x, y in zip(vars(left).values(), vars(right).values(), strict=True))


@dataclass(frozen=True)
class Figure:
    """One figure that a fit may move: an entry of a muscle's row."""

    muscle: str
    field: str
    entry: int = 0

    @property
    def kind(self) -> str:
        """Its line in `STEPS`."""
        return "place" if self.field in ("attachment", "insertion", "centre") else self.field


def figures(rows: dict[str, MuscleRow]) -> list[Figure]:
    """Every figure of every row; a line of two places moves as one; midline muscles stay on the midline."""
    found = []
    for row in rows.values():
        for field in ("attachment", "insertion", "centre"):
            if hasattr(row, field):
                first = 1 if row.sides == "halves" else 0
                found += [Figure(row.name, field, axis) for axis in range(first, 3)]
        found += [Figure(row.name, f) for f in ("angle", "exponent", "reach") if hasattr(row, f)]
        found += [Figure(row.name, "radii", i) for i in range(len(getattr(row, "radii", ())))]
        found += [Figure(row.name, f) for f in ("fall", "power", "reaction", "reaction_at") if getattr(row, f, 0.0)]
        if isinstance(row, SphincterSkinRow):
            found.append(Figure(row.name, "bulge"))
        if hasattr(row, "direction"):
            found += [Figure(row.name, "direction", i) for i in range(row.sides == "halves", 3)]
        found.append(Figure(row.name, "prior"))
    return found


def moved_row(start: MuscleRow, figure_steps: Sequence[tuple[Figure, float]]) -> MuscleRow:
    """A row some steps away from its start, within bounds."""
    row = start
    for figure, steps in figure_steps:
        step, least, most = STEPS[figure.kind]
        value = getattr(row, figure.field)
        changed: dict[str, Any]
        if figure.kind == "place":
            reach = np.clip(steps * step, -FARTHEST, FARTHEST)
            changed = {figure.field: value + reach * np.eye(3)[figure.entry]}
        elif figure.kind == "direction":
            changed = {figure.field: value + np.eye(3)[figure.entry] * steps * step}
        elif figure.kind == "radii":
            radii = list(value)
            radii[figure.entry] = float(np.clip(radii[figure.entry] * np.exp(steps * step), least, most))
            changed = {figure.field: tuple(radii)}
        elif figure.kind == "prior":
            prior = float(np.clip(value * np.exp(steps * step), least, most))
            changed = {"prior": prior, "amplitude": max(prior, row.amplitude)}
        else:
            changed = {figure.field: float(np.clip(value + steps * step, least, most))}
        row = replace(row, **changed)
    return row


class Fit:
    """Damped Gauss-Newton steps over all figures, from an anatomical start."""

    def __init__(self, bench: Bench) -> None:
        self.bench, self.start = bench, dict(bench.rows)
        self.figures = figures(self.start)
        self.steps: Floats = np.zeros(len(self.figures))
        self.of = {n: [i for i, f in enumerate(self.figures) if f.muscle == n] for n in self.start}

    def go(self, steps: Floats) -> None:
        """Put every muscle where `steps` has it."""
        for name, own in self.of.items():
            if not np.array_equal(steps[own], self.steps[own]):
                self.bench.put(moved_row(self.start[name], [(self.figures[i], float(steps[i])) for i in own]))
        self.steps = steps.copy()

    def normal_equations(self) -> tuple[Floats, Floats]:
        """Per shape J'J (s, k, k) and J'r (s, k) of the unexplained share of its variance, k figures."""
        base = self.bench.residuals()
        slopes = np.zeros((len(self.figures), *base.shape), dtype=np.float32)
        here = self.steps.copy()
        for i in range(len(self.figures)):
            there = here.copy()
            there[i] += 0.5
            self.go(there)
            slopes[i] = (self.bench.residuals() - base) / 0.5
        self.go(here)
        squares = np.stack([slopes[:, s] @ slopes[:, s].T for s in range(base.shape[0])]).astype(np.float64)
        return squares, np.stack([slopes[:, s] @ base[s] for s in range(base.shape[0])]).astype(np.float64)

    def step(self, squares: Floats, slopes: Floats, kept: Sequence[int], damping: float) -> Floats:
        """Steps from the start that explain the kept shapes best, moving costing `damping` per squared step."""
        matrix = squares[kept].mean(axis=0) + damping * np.eye(len(self.figures))
        right = -(slopes[kept].mean(axis=0) - squares[kept].mean(axis=0) @ self.steps)
        return np.clip(np.linalg.solve(matrix, right), -4.0, 4.0)


def moves(fit: Fit) -> str:
    """One line per figure that has moved by more than a tenth of a step, the farthest first."""
    order = [i for i in np.argsort(-np.abs(fit.steps)) if abs(fit.steps[i]) > 0.1]
    named = [f"{f.muscle} {f.field}[{f.entry}]" for f in fit.figures]
    return "".join(f"{named[i]} {fit.steps[i]:+.2f} steps\n" for i in order)


def held_out(fit: Fit, folds: int, dampings: Sequence[float], folder: Path | None) -> None:
    """Print what one step explains of kinds it has not seen, and of all, per damping; write what it moves."""
    here, (squares, slopes) = fit.steps.copy(), fit.normal_equations()
    count = len(fit.bench.shapes)
    print("start   ", summary(fit.bench.explained()))
    for damping in dampings:
        unseen: dict[str, float] = {}
        for fold in range(folds):
            kept = [s for s in range(count) if s % folds != fold]
            fit.go(fit.step(squares, slopes, kept, damping))
            unseen |= fit.bench.explained(fit.bench.shapes[s].name for s in range(count) if s % folds == fold)
        fit.go(fit.step(squares, slopes, range(count), damping))
        seen = fit.bench.explained()
        print(f"damping {damping:.0e}: held out {summary(unseen)}; fitted {summary(seen)}", flush=True)
        print("   ", {n: (round(unseen[n], 3), round(seen[n], 3)) for n in seen}, flush=True)
        if folder is not None:
            (folder / f"{damping:.0e}.txt").write_text(moves(fit), encoding="utf-8")
        fit.go(here)


def summary(explained: dict[str, float]) -> str:
    """Median and mean."""
    values = np.array(list(explained.values()))
    return f"median {np.median(values):.3f} mean {values.mean():.3f} least {values.min():.3f}"


def report(identities: int) -> None:
    """Print explained variances."""
    explained = Bench(load_face("ict")).explained()
    for name, value in explained.items():
        print(f"{name:20s} {value:.3f}")
    print(f"{'scanned face':20s} {summary(explained)}")
    for name in IDENTITIES[:identities]:
        print(f"{name:20s} {summary(Bench(load_face(name)).explained())}")


def main() -> None:
    """The command line of the module."""
    parser = argparse.ArgumentParser(description="Hold the muscle table against scanned expressions.")
    parser.add_argument("what", nargs="?", choices=("report", "fit"), default="report")
    parser.add_argument("--identities", type=int, default=6, help="how many other identities to report")
    parser.add_argument("--folds", type=int, default=5, help="parts that the kinds of expression are left out in")
    parser.add_argument("--damping", type=float, nargs="+", default=[1e-3, 3e-3, 1e-2])
    parser.add_argument("--save", type=Path, help="folder for what a fit moves")
    given = parser.parse_args()
    if given.what == "report":
        report(given.identities)
    else:
        held_out(Fit(Bench(load_face("ict"))), given.folds, given.damping, given.save)


if __name__ == "__main__":
    main()
