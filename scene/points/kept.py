"""Feature points as they are kept with a mesh: bound to its vertices, with how sure each is and where it came from.

They stand as JSON in a custom property of the mesh datablock. So they are saved, copied, appended and linked with the
mesh, need no registered add-on, and are in the mesh's own coordinates.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from enum import Enum
from functools import lru_cache

import numpy as np

from ...arrays import Floats
from ...errors import FormatError, ParameterError, SceneError
from ...face.fit.doubt import DOUBTFUL, DOUBTFUL_SCORE
from ...mpeg4 import FEATURE_POINTS
from ...tables import is_number, parsed_json
from ..blender_types import Mesh, Object
from ..shape_mix import resting_values

#: The mesh's points, and the same as they were before anything was corrected by hand.
POINTS, AS_GIVEN = "risorius_points", "risorius_points_as_given"

NO_POINTS = "has no feature points: find the face, click them, or import them"


class Origin(Enum):
    """Where a point came from."""

    FOUND = "found"
    CLICKED = "clicked"
    DRAGGED = "dragged"
    FILE = "file"
    TOPOLOGY = "topology"


@dataclass(frozen=True)
class KeptPoint:
    """One feature point of a mesh, in the mesh's own coordinates.

    Attributes
    ----------
    at : (3,) where it was put.
    vertices, weights : the vertices that it moves with, and their shares; empty where it lies off the surface.
    on : (3,) the mean of these vertices then, a hair's breadth from `at`.
    confidence : 0 .. 1.
    """

    at: tuple[float, float, float]
    vertices: tuple[int, ...] = ()
    weights: tuple[float, ...] = ()
    on: tuple[float, float, float] = (0.0, 0.0, 0.0)
    confidence: float = 1.0
    origin: Origin = Origin.FILE

    def __post_init__(self) -> None:
        for name in ("at", "on"):
            place = getattr(self, name)
            if len(place) != 3 or not np.isfinite(place).all():
                raise ParameterError(name, "must be three finite numbers", place)
        if min(self.vertices, default=0) < 0:
            raise ParameterError("vertices", "must be 0 or more", self.vertices)
        if len(self.vertices) != len(self.weights) or not np.isfinite(self.weights).all():
            raise ParameterError("weights", "must be as many as there are vertices, and finite", self.weights)
        if not 0.0 <= self.confidence <= 1.0:
            raise ParameterError("confidence", "must be in [0, 1]", self.confidence)

    @property
    def is_bound(self) -> bool:
        """Whether it moves with the mesh."""
        return len(self.vertices) > 0


@dataclass(frozen=True)
class KeptPoints:
    """All feature points of a mesh.

    Attributes
    ----------
    counts : vertices, corners and polygons of the mesh that they are bound to.
    digest : of that mesh's polygons.
    points : name ("8.4") -> point.
    score : how little the mesh looked like a face when they were found in it; 0 once a person has said where it is.
    sewn : what had no opening then: "mouth", and "l" and "r" for eyes (`Face.sewn`).
    resting : shape key -> value, of the user's keys that made the resting face what it was then.
    """

    counts: tuple[int, int, int]
    digest: str
    points: Mapping[str, KeptPoint] = field(default_factory=dict)
    score: float = 0.0
    sewn: frozenset[str] = frozenset()
    resting: Mapping[str, float] = field(default_factory=dict)

    @property
    def is_questioned(self) -> bool:
        """Whether the mesh is so unlike most faces that somebody should look whether these are its points."""
        return self.score > DOUBTFUL_SCORE

    def doubtful(self) -> list[str]:
        """Names of the points that want to be looked at, the least sure first."""
        names = [name for name, point in self.points.items() if point.confidence < DOUBTFUL]
        return sorted(names, key=lambda name: self.points[name].confidence)


def triple(place: Sequence[float] | Floats) -> tuple[float, float, float]:
    """Three plain numbers."""
    x, y, z = (float(number) for number in place)
    return x, y, z


def mesh_counts(mesh: Mesh) -> tuple[int, int, int]:
    """Vertices, corners and polygons of a mesh: cheap to ask at every redraw."""
    return len(mesh.vertices), len(mesh.loops), len(mesh.polygons)


def has_points(obj: Object) -> bool:
    """Whether points are kept with the mesh of `obj`."""
    return obj.type == "MESH" and POINTS in obj.data


def read_kept(obj: Object, *, as_given: bool = False) -> KeptPoints:
    """The points kept with the mesh of `obj`, or as they were before they were corrected.

    Raises
    ------
    SceneError : none there, or unreadable.
    """
    if obj.type != "MESH":
        raise SceneError(obj.name, NO_POINTS)
    return read_kept_with(obj.data, obj.name, as_given=as_given)


def read_kept_with(mesh: Mesh, name: str, *, as_given: bool = False) -> KeptPoints:
    """The points kept with a mesh; `name` names it in errors, which are those of `read_kept`."""
    text = mesh.get(AS_GIVEN if as_given else POINTS)
    if text is None:
        raise SceneError(name, NO_POINTS)
    try:
        return _decoded(str(text))
    except (ValueError, LookupError, TypeError, AttributeError, OverflowError) as problem:
        raise SceneError(name, "has unreadable feature points: find or import them again") from problem


def as_found(mesh: Mesh) -> Mapping[str, float]:
    """The shape keys that made the resting face what it was when its points were found: others are its expression.

    Where no points are known, the user's keys as they are now.
    """
    return read_kept_with(mesh, mesh.name).resting if POINTS in mesh else resting_values(mesh)


def write_kept(obj: Object, kept: KeptPoints, *, as_given: bool = False) -> None:
    """Keep points with the mesh of `obj`; `as_given`: they are also what a reset goes back to.

    Raises
    ------
    SceneError : the mesh belongs to another file.
    """
    refuse_foreign_mesh(obj)
    text = _encoded(kept)
    obj.data[POINTS] = text
    if as_given:
        obj.data[AS_GIVEN] = text


def refuse_foreign_mesh(obj: Object) -> None:
    """Refuse a mesh that nothing can be kept with.

    Raises
    ------
    SceneError : the mesh belongs to another file.
    """
    if obj.data.library is not None or obj.data.override_library is not None:
        raise SceneError(
            obj.name, "has a mesh from another file: make it local (Object > Relations > Make Local > All) first"
        )


def forget_points(obj: Object) -> None:
    """Remove them."""
    forget_points_of(obj.data)


def forget_points_of(mesh: Mesh) -> None:
    """Remove those of a mesh."""
    for key in (POINTS, AS_GIVEN):
        if key in mesh:
            del mesh[key]


def _encoded(kept: KeptPoints) -> str:
    """As JSON."""
    points = {
        name: {
            "at": list(point.at),
            "vertices": list(point.vertices),
            "weights": list(point.weights),
            "on": list(point.on),
            "confidence": point.confidence,
            "origin": point.origin.value,
        }
        for name, point in kept.points.items()
    }
    told = {"counts": list(kept.counts), "digest": kept.digest, "score": kept.score, "sewn": sorted(kept.sewn)}
    return json.dumps({**told, "resting": dict(kept.resting), "points": points})


@lru_cache(maxsize=8)
def _decoded(text: str) -> KeptPoints:
    """From JSON; kept, because panels and overlays ask at every redraw."""
    stored = parsed_json(text)
    points = {}
    for name, entry in stored["points"].items():
        if name not in FEATURE_POINTS:
            raise FormatError("feature points", "is not a name of the standard", key=name)
        points[name] = KeptPoint(
            triple(entry["at"]),
            tuple(int(vertex) for vertex in entry["vertices"]),
            tuple(float(weight) for weight in entry["weights"]),
            triple(entry["on"]),
            float(entry["confidence"]),
            Origin(entry["origin"]),
        )
    vertices, corners, polygons = stored["counts"]
    counts = int(vertices), int(corners), int(polygons)
    sewn = frozenset(str(name) for name in stored.get("sewn", ()))
    resting = {str(name): float(value) for name, value in stored.get("resting", {}).items()}
    score = float(stored.get("score", 0.0))
    if not all(is_number(value) for value in (score, *resting.values())):
        raise ValueError("numbers that are none")
    return KeptPoints(counts, str(stored["digest"]), points, score, sewn, resting)
