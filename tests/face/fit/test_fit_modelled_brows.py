"""Brows that are pieces of the mesh: the points of the brows lie under them, wherever they are."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from risorius.api import find_points
from scipy.spatial import cKDTree

#: Middle line of a brow, shares of the width of both eyes: towards the ear and upwards from the inner eye corner.
LINE = np.array([[-0.05, 0.2], [0.1, 0.235], [0.22, 0.25], [0.33, 0.23], [0.43, 0.19]])
NAMES = (("4.1", "4.3", "4.5"), ("4.2", "4.4", "4.6"))


def on_skin(head: Any, x: np.ndarray, z: np.ndarray, off: float) -> np.ndarray:
    """(N, 3) places before the skin of a head that looks along -y."""
    front = head.vertices[head.vertices[:, 1] < np.median(head.vertices[:, 1])]
    distance, near = cKDTree(front[:, [0, 2]]).query(np.column_stack([x, z]), k=6)
    weights = 1.0 / (distance + 1e-4)
    y = (front[near, 1] * weights).sum(axis=1) / weights.sum(axis=1)
    return np.column_stack([x, y - off, z])


def strip(head: Any, side: float, lift: float, *, cards: bool = False, off: float = 1e-3) -> tuple[np.ndarray, list]:
    """Vertices and polygons of a brow 7 mm high on one side, as a strip or as cards of hair across it."""
    corner = {n: np.asarray(head.places[n]) for n in ("3.7", "3.11", "3.8", "3.12")}
    inner = corner["3.11"] if side > 0 else corner["3.8"]
    width = float(np.linalg.norm(corner["3.7"] - corner["3.12"]))
    count = 60 if cards else 20
    aside = np.linspace(LINE[0, 0], LINE[-1, 0], count)
    up = np.interp(aside, *LINE.T) + lift
    x, z = inner[0] + side * width * aside, inner[2] + width * up
    edges = [on_skin(head, x, z + half, off) for half in (-3.5e-3, 3.5e-3)]
    vertices = np.stack(edges, axis=1).reshape(-1, 3)
    first = range(0, count - 1, 2) if cards else range(count - 1)
    return vertices, [[2 * k, 2 * k + 2, 2 * k + 3, 2 * k + 1] for k in first]


def with_brows(head: Any, *brows: tuple[np.ndarray, list]) -> tuple[np.ndarray, list]:
    """A head with pieces added to its mesh."""
    vertices, polygons = [head.vertices], [list(map(int, polygon)) for polygon in head.polygons]
    start = len(head.vertices)
    for places, faces in brows:
        polygons += [[start + corner for corner in face] for face in faces]
        vertices.append(places)
        start += len(places)
    return np.concatenate(vertices), polygons


def expected(head: Any, side: float, lift: float) -> np.ndarray:
    """(3, 2) places of inner end, arch and outer end, seen from the front, metres."""
    width = float(np.linalg.norm(np.asarray(head.places["3.7"]) - head.places["3.12"]))
    inner = np.asarray(head.places["3.11" if side > 0 else "3.8"])
    line = LINE[[0, 2, 4]] + np.array([0.0, lift])
    return np.column_stack([inner[0] + side * width * line[:, 0], inner[2] + width * line[:, 1]])


@pytest.fixture(scope="module")
def bare(shared_head: Callable[[str], Any]) -> Callable[[str], Any]:
    """A shared head with the places of its feature points."""

    def read(name: str) -> Any:
        head = shared_head(name)
        places = {n: head.vertices[p] if isinstance(p, int) else np.asarray(p) for n, p in head.points.items()}
        object.__setattr__(head, "places", places)
        return head

    return read


@pytest.mark.slow
@pytest.mark.parametrize("cards", [False, True])
@pytest.mark.parametrize("lift", [-0.04, 0.06])
@pytest.mark.parametrize("name", ["ict_narrow", "makehuman"])
def test_brows_are_found_under_pieces_of_the_mesh(
    bare: Callable[[str], Any], name: str, lift: float, cards: bool
) -> None:
    head = bare(name)
    found = find_points(
        *with_brows(head, *(strip(head, side, lift, cards=cards) for side in (1.0, -1.0))), topologies=()
    )
    for side, names in zip((1.0, -1.0), NAMES, strict=True):
        for point, place in zip(names, expected(head, side, lift), strict=True):
            assert np.linalg.norm(found.positions[point][[0, 2]] - place) < 4e-3, point
            assert found.confidence[point] > 0.8


@pytest.mark.slow
def test_one_brow_alone_and_what_hangs_before_the_skin_tell_nothing(bare: Callable[[str], Any]) -> None:
    head = bare("ict_narrow")
    plain = find_points(head.vertices, head.polygons, topologies=())
    for brows in ((strip(head, 1.0, 0.06),), tuple(strip(head, side, 0.06, off=25e-3) for side in (1.0, -1.0))):
        found = find_points(*with_brows(head, *brows), topologies=())
        for name in ("4.1", "4.2", "4.3", "4.4", "4.5", "4.6"):
            assert np.linalg.norm(found.positions[name] - plain.positions[name]) < 3e-3
