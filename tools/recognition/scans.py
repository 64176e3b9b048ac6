"""Scanned shapes combined as the facial action coding system combines action units, measured on seven people."""

from __future__ import annotations

import itertools
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
from fit.heads import SharedHeads
from risorius.api import Face
from risorius.arrays import Floats
from risorius.tables import read_csv

from .faces import IDENTITIES
from .poses import Measured

UNITS, COMBINATIONS = (Path(__file__).with_name(name) for name in ("units.csv", "combinations.csv"))

#: How far the shapes are carried; 1 is the scan itself.
STRENGTHS = (0.5, 0.75, 1.0)
PEOPLE = ("ict", *IDENTITIES)


@dataclass(frozen=True)
class Unit:
    """An action unit and the scan that shows it; shape "" where none does."""

    name: str
    shape: str
    weight: float


@dataclass(frozen=True)
class Combination:
    """Action units that go with an emotion: unit -> intensity."""

    emotion: str
    source: str
    units: Mapping[int, float]

    def __str__(self) -> str:
        """As it is written: 1+4*0.5."""
        return "+".join(f"{unit}" if size == 1.0 else f"{unit}*{size:g}" for unit, size in self.units.items())

    def missing(self) -> list[int]:
        """Units that no scan shows."""
        return [unit for unit in self.units if not units()[unit].shape]

    def weights(self) -> dict[str, float]:
        """Scan -> weight; of several units on one scan the strongest counts."""
        found: dict[str, float] = {}
        for number, size in self.units.items():
            unit = units()[number]
            if unit.shape:
                found[unit.shape] = max(found.get(unit.shape, 0.0), size * unit.weight)
        return found


@cache
def units() -> Mapping[int, Unit]:
    """units.csv by number."""
    return {
        row.integer("au"): Unit(row.text("name"), row.text("shape", ""), row.number("weight", 0.0))
        for row in read_csv(UNITS)
    }


@cache
def combinations() -> tuple[Combination, ...]:
    """combinations.csv in order."""
    return tuple(
        Combination(row.text("emotion"), row.text("source"), dict(_unit(text) for text in row.texts("units")))
        for row in read_csv(COMBINATIONS)
    )


def _unit(text: str) -> tuple[int, float]:
    """A unit and its intensity from "4" or "4*0.8"."""
    number, _, size = text.partition("*")
    return int(number), float(size or 1.0)


def shown() -> list[Combination]:
    """The combinations of which at least one unit has a scan."""
    return [each for each in combinations() if each.weights()]


def gather_scans(folder: Path, faces: Mapping[str, Callable[[], Face]], cache: Path) -> Measured:
    """All combinations on all people at all strengths, from the cache where they are there.

    Returns
    -------
    What was measured: `asked` is the emotion, `variants` the index in `shown()`, `shares` the strength.
    """
    path = cache / "scans.npz"
    if not path.exists():
        cache.mkdir(parents=True, exist_ok=True)
        found = _measure(_displacements(folder), {name: faces[name]() for name in PEOPLE})
        np.savez_compressed(path, **vars(found))
    with np.load(path) as arrays:
        return Measured(**{**arrays, "seconds": float(arrays["seconds"])})


def _displacements(folder: Path) -> list[Floats]:
    """(V, 3) what each combination does to the scanned head; scans without a plain name have a left and a right one."""
    heads, names = SharedHeads(folder), set(np.load(folder / "ict_expressions.npz")["names"].tolist())
    found = []
    for each in shown():
        weights = {
            name: weight
            for shape, weight in each.weights().items()
            for name in ((shape,) if shape in names else (f"{shape}_L", f"{shape}_R"))
        }
        found.append(heads.expression(str(each), weights).vertices - heads.shared("ict").vertices)
    return found


def _measure(displacements: list[Floats], people: Mapping[str, Face]) -> Measured:
    """Every displacement on every person at every strength."""
    begun = time.perf_counter()
    cases = list(itertools.product(range(len(displacements)), people, STRENGTHS))
    shapes = [(people[name], people[name].vertices + size * displacements[index]) for index, name, size in cases]
    return Measured(
        faps=np.array([face.measure(positions) for face, positions in shapes]),
        features=np.array([face.features(positions) for face, positions in shapes]),
        asked=np.array([shown()[index].emotion for index, _, _ in cases]),
        variants=np.array([index for index, _, _ in cases]),
        shares=np.array([size for _, _, size in cases]),
        faces=np.array([name for _, name, _ in cases]),
        seconds=time.perf_counter() - begun,
    )
