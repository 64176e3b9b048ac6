"""A person's neutral face guessed from pictures that may show none, and how wrong the guess may be.

What is known of people: the generic face and the ways in which neutral faces differ from it
(presets/capture/people.csv). What is seen: points that expression does not move, which tell something of the others
(wide eyes, a wide mouth); and of several pictures where each point usually is.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from ..arrays import Floats, Ints
from ..errors import FormatError, ModelError
from ..face.mesh.template import MM
from ..face.tracked.landmarks import fit_poses
from ..face.tracked.mediapipe_landmarks import landmark_numbers, stable_points
from ..mpeg4.streams.capture import CAPTURE_PRESETS, Landmarks
from ..tables import read_csv
from .face_mesh import LANDMARKS
from .generic_face import AXES, generic_landmarks

PEOPLE = CAPTURE_PRESETS / "people.csv"

#: How far MediaPipe misses a point in one picture, metres: with it the guesses for heads that were left out are as
#: wrong as they say (docs/tracking.md).
MISSED = 2e-3

#: What expressions move a point by, metres: in several pictures at least so much (own choice).
EXPRESSED = 4e-3

#: Independent errors of the neutral face that are told of.
ERRORS = 10


@dataclass(frozen=True, eq=False)
class Guess:
    """A neutral face and how it may be wrong.

    Attributes
    ----------
    face : (478, 3) left, up, forward in metres, NaN for landmarks that are no feature points.
    errors : (m, 478, 3) metres: independent errors, each of one standard deviation, NaN as above.
    """

    face: Floats
    errors: Floats


@dataclass(frozen=True, eq=False)
class _People:
    """Feature points of neutral faces: names, mean (P, 3) and covariance (3 P, 3 P), metres."""

    names: tuple[str, ...]
    mean: Floats
    covariance: Floats

    @property
    def steady(self) -> Ints:
        """Columns of the points that expression does not move."""
        return np.array([self.names.index(name) for name in stable_points()], dtype=np.int64)


def guess_neutral(landmarks: Landmarks) -> Guess:
    """The neutral face of the person in all these pictures.

    Raises
    ------
    ModelError : no picture shows a whole face.
    """
    people = _people()
    numbers = [landmark_numbers()[name] for name in people.names]
    if landmarks.positions.shape[1] <= max(numbers):
        numbers = [number for number in numbers if number < landmarks.positions.shape[1]]
        people = _without(people, len(numbers))
    seen = landmarks.positions[:, numbers]
    there = np.asarray(np.isfinite(seen[:, people.steady]).all(axis=(1, 2)))
    if not there.any():
        raise ModelError("no frame shows a whole face")
    laid = fit_poses(people.mean[people.steady], seen[:, people.steady], there).undone(seen)[there]
    mean, covariance = _seen_steady(people, laid)
    if len(laid) > 1:
        mean, covariance = _seen_often(mean, covariance, laid)
    sizes, ways = np.linalg.eigh(covariance)
    errors = (ways * np.sqrt(np.maximum(sizes, 0.0)))[:, : -ERRORS - 1 : -1].T.reshape(ERRORS, -1, 3)
    face, wrong = np.full((LANDMARKS, 3), np.nan), np.full((ERRORS, LANDMARKS, 3), np.nan)
    face[numbers], wrong[:, numbers] = mean, errors
    return Guess(face, wrong)


def _seen_steady(people: _People, laid: Floats) -> tuple[Floats, Floats]:
    """Mean (P, 3) and covariance of a neutral face of which steady points were seen (T, P, 3), but not their depth."""
    rows = np.concatenate([3 * people.steady, 3 * people.steady + 1])
    noise = MISSED**2 * np.eye(len(rows))
    away = (np.median(laid, axis=0) - people.mean).reshape(-1)[rows]
    gain = np.linalg.solve(people.covariance[np.ix_(rows, rows)] + noise, people.covariance[rows]).T
    mean = people.mean + (gain @ away).reshape(-1, 3)
    return mean, people.covariance - gain @ people.covariance[rows]


def _seen_often(mean: Floats, covariance: Floats, laid: Floats) -> tuple[Floats, Floats]:
    """The same after several pictures (T, P, 3) of one person: each point is usually near its neutral place."""
    usual = np.median(laid, axis=0)
    spread = np.maximum(laid.std(axis=0), EXPRESSED).reshape(-1)
    noise = np.diag(spread**2 / len(laid))
    gain = np.linalg.solve(covariance + noise, covariance).T
    return mean + (gain @ (usual - mean).reshape(-1)).reshape(-1, 3), covariance - gain @ covariance


def _without(people: _People, count: int) -> _People:
    """The first `count` points alone: recordings without irises."""
    return _People(people.names[:count], people.mean[:count], people.covariance[: 3 * count, : 3 * count])


@lru_cache(maxsize=1)
def _people() -> _People:
    """The tables; points in the order of their landmarks' numbers.

    Raises
    ------
    FormatError : a table is damaged.
    """
    names = tuple(sorted(landmark_numbers(), key=landmark_numbers().__getitem__))
    mean = generic_landmarks()[[landmark_numbers()[name] for name in names]] * MM
    rows = _rows()
    if set(rows) != {(name, axis) for name in names for axis in _axes()}:
        raise FormatError(PEOPLE, "must have a row for each feature point and axis: install Risorius again")
    table = np.array([rows[name, axis] for name in names for axis in _axes()]) * MM
    covariance = table[:, 1:] @ table[:, 1:].T + np.diag(table[:, 0] ** 2)
    return _People(names, mean, covariance)


def _rows() -> Mapping[tuple[str, str], Sequence[float]]:
    """(point, axis) -> what the modes leave, and the modes, mm."""
    found = {}
    for row in read_csv(PEOPLE, "point", "axis", "own_mm", "mode_1"):
        modes = [name for name in row if name.startswith("mode_")]
        found[row.text("point"), row.text("axis")] = [row.number("own_mm"), *(row.number(name) for name in modes)]
    return found


def _axes() -> tuple[str, ...]:
    """Names of the axes in the table."""
    return tuple(axis.removesuffix("_mm") for axis in AXES)
