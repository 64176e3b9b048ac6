"""Faces for the tests: the default head, and the shared heads as they are loaded by anybody who has labels."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
import pytest
import risorius.api as api
from risorius.api import Face, Part
from risorius.face.default_head import HeadMesh
from risorius.face.mesh.segmentation import pieces

#: Labels of the shared heads as parts; teeth (3) are told into rows by their place.
SKIN_LABELS, TEETH = (0, 5, 7), 3
PARTS = {1: Part.EYEBALL_L, 2: Part.EYEBALL_R, 4: Part.TONGUE}


@dataclass(frozen=True)
class SharedHead:
    """One of the shared heads: arrays as `Face.from_arrays` takes them, labels (V,), FAP units in mm."""

    vertices: np.ndarray
    polygons: list[np.ndarray]
    points: dict[str, int | np.ndarray]
    labels: np.ndarray
    fapu_mm: dict[str, float]

    def parts(self) -> np.ndarray:
        """Parts by the labels."""
        parts = np.full(len(self.vertices), int(Part.OTHER))
        parts[np.isin(self.labels, SKIN_LABELS)] = int(Part.SKIN)
        for label, part in PARTS.items():
            parts[self.labels == label] = int(part)
        lower_lip = self.points["2.3"]
        assert isinstance(lower_lip, int)
        between = self.vertices[lower_lip][2] - 0.003
        piece_of = pieces(self.polygons, len(self.vertices))
        for piece in np.unique(piece_of[self.labels == TEETH]):
            member = piece_of == piece
            above = self.vertices[member, 2].mean() > between
            parts[member] = int(Part.TEETH_UPPER if above else Part.TEETH_LOWER)
        return parts


@pytest.fixture(scope="session")
def shared_head(shared: Path) -> Callable[[str], SharedHead]:
    """The shared head of a name, read once."""

    @cache
    def read(name: str) -> SharedHead:
        data = np.load(shared / "heads" / f"{name}.npz")
        facts = json.loads((shared / "heads" / f"{name}.fp.json").read_text())
        vertices = data["vertices"].astype(np.float64)
        points: dict[str, int | np.ndarray] = dict(facts["points"])
        for point, place in facts["xyz"].items():
            vertex = facts["points"].get(point)
            if point != "7.1" and (vertex is None or np.linalg.norm(vertices[vertex] - place) > 1e-4):
                points[point] = np.array(place)
        count = len(vertices)
        return SharedHead(
            vertices=vertices,
            polygons=np.split(data["loops"].astype(np.int64), np.cumsum(data["face_sizes"])[:-1]),
            points=points,
            labels=data["labels"].astype(int) if "labels" in data.files else np.zeros(count, dtype=int),
            fapu_mm=facts["fapu_mm"],
        )

    return read


@pytest.fixture(scope="session")
def shared_face(shared_head: Callable[[str], SharedHead]) -> Callable[[str], Face]:
    """The face of a shared head with parts by its labels, built once."""

    @cache
    def build(name: str) -> Face:
        head = shared_head(name)
        return Face.from_arrays(head.vertices, head.polygons, head.points, head.parts())

    return build


@pytest.fixture(scope="session")
def head() -> HeadMesh:
    """The default head's mesh."""
    return api.build_default_head()


@pytest.fixture(scope="session")
def face() -> Face:
    """The default head as a face."""
    return api.default_face()


@pytest.fixture(scope="session")
def any_face(face: Face, request: pytest.FixtureRequest) -> Callable[[str], Face]:
    """A face by name: "default", or one of the shared heads (which skips where they are absent)."""

    def get(name: str) -> Face:
        if name == "default":
            return face
        build: Callable[[str], Face] = request.getfixturevalue("shared_face")
        return build(name)

    return get
