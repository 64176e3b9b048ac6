"""The measurements, each a job that a process of its own can do: what it takes and gives can be pickled."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from risorius.api import Drive, Mechanism

from .baselines import baselines
from .heads import load_face
from .requests import MET, Met, met, profiles
from .scans import drawn_shapes, explained, posed, scanned_shapes


@dataclass(frozen=True)
class Requests:
    """How well one face meets FAPs; errors are shares of the request (or of 100 units where less is asked).

    Attributes
    ----------
    exact : median, 95 % quantile and largest error of the exact drive over the 25 profiles.
    natural : kind of request -> median error of the natural drive over profiles and words, and the share that is met.
    """

    exact: tuple[float, float, float]
    natural: Mapping[str, tuple[float, float]]


def requests_met(head: str) -> Requests:
    """How well a head meets the profiles of Table 5 and the words of Table 6."""
    face, asked = load_face(head), profiles()
    archetypes = {name: profile for name, profile in asked.items() if ":" in name}
    exact = met(face, Drive.EXACT, archetypes).errors
    median, most, worst = (float(np.quantile(exact, share)) for share in (0.5, 0.95, 1.0))
    words = {name: profile for name, profile in asked.items() if name not in archetypes}
    return Requests((median, most, worst), _natural(met(face, Drive.NATURAL, archetypes), "profiles")
                    | _natural(met(face, Drive.NATURAL, words), "words"))  # fmt: skip


def _natural(found: Met, asked: str) -> dict[str, tuple[float, float]]:
    """Median error and share met, of the requests inside the range, and of those that pass unchanged."""
    chosen = {f"{asked}, in the range": found.possible, f"{asked}, in its unchanged part": found.moderate}
    return {
        kind: (float(np.median(found.errors[which])), float(np.mean(found.errors[which] <= MET)))
        for kind, which in chosen.items()
    }


def scans_explained(head: str, drive: Drive = Drive.EXACT) -> dict[str, float]:
    """Explained variance of the scanned shapes on a head of the ICT topology."""
    face = load_face(head)
    return explained(scanned_shapes(face), posed(face, drive))


def scans_explained_without(*mechanisms: Mechanism) -> dict[str, float]:
    """The same on the scanned head itself with mechanisms left out; the FAPs are measured on the whole face."""
    face = load_face("ict")
    return explained(scanned_shapes(face), posed(face.without(*mechanisms)))


def scans_explained_by_points() -> dict[str, dict[str, float]]:
    """Baseline -> explained variance of the scanned shapes."""
    face = load_face("ict")
    shapes = scanned_shapes(face)
    return {name: explained(shapes, model) for name, model in baselines(face).items()}


def drawings_explained() -> dict[str, float]:
    """Explained variance of MakeHuman's hand-drawn face units."""
    face = load_face("makehuman")
    return explained(drawn_shapes(face), posed(face))
