"""What grows out of the skin: it goes with the skin where it touches it, turns with it, and keeps its length."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from risorius.api import Face, Part
from risorius.face.response.rooted import RootedParts
from risorius.polygons import PolygonTable
from scipy.spatial.transform import Rotation

MM = 1e-3


def sheet(rows: int, columns: int, origin: tuple[float, float, float], up: tuple[float, float, float]) -> np.ndarray:
    """(rows * columns, 3) grid of 1 mm from an origin along +X and `up`, in metres."""
    across, along = np.meshgrid(np.arange(columns), np.arange(rows))
    return (np.array(origin) + across.reshape(-1, 1) * [1.0, 0.0, 0.0] + along.reshape(-1, 1) * np.asarray(up)) * MM


def quads(rows: int, columns: int, first: int) -> list[np.ndarray]:
    """The grid's polygons."""
    corner = first + (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
    return list(np.stack([corner, corner + 1, corner + columns + 1, corner + columns], axis=1))


@pytest.fixture(scope="module")
def lids() -> tuple[np.ndarray, PolygonTable, np.ndarray, np.ndarray, np.ndarray]:
    """Two lids that nearly touch and a strip of lashes that stands out of the upper one, nearer to the lower.

    Positions, polygons, and the vertices of the upper lid, of the lower one and of the lashes.
    """
    upper = sheet(10, 20, (0.0, 0.2, 0.0), (0.0, 1.0, 0.0))
    lower = sheet(10, 20, (0.0, 0.0, 0.0), (0.0, -1.0, 0.0))
    lashes = sheet(5, 16, (2.0, 0.15, 0.1), (0.0, -0.3, 2.0))
    polygons = PolygonTable.of([*quads(10, 20, 0), *quads(10, 20, 200), *quads(5, 16, 400)])
    return np.concatenate([upper, lower, lashes]), polygons, np.arange(200), np.arange(200, 400), np.arange(400, 480)


def test_lashes_follow_the_lid_that_they_grow_out_of(lids: tuple) -> None:
    positions, polygons, upper, lower, lashes = lids
    rooted = RootedParts(positions, polygons, lashes, np.concatenate([upper, lower]))
    moved = np.zeros_like(positions)
    moved[upper] = [0.0, 5.0 * MM, 0.0]
    rooted.follow(moved)
    assert np.allclose(moved[lashes], [0.0, 5.0 * MM, 0.0], atol=1e-9)
    moved[:] = 0.0
    moved[lower] = [0.0, -5.0 * MM, 0.0]
    rooted.follow(moved)
    assert (moved[lashes] == 0.0).all()


def test_lashes_turn_with_their_lid_and_keep_their_length(lids: tuple) -> None:
    positions, polygons, upper, lower, lashes = lids
    turn = Rotation.from_euler("x", 40.0, degrees=True)
    moved = np.zeros_like(positions)
    moved[upper] = turn.apply(positions[upper]) - positions[upper]
    RootedParts(positions, polygons, lashes, np.concatenate([upper, lower])).follow(moved)
    wanted = turn.apply(positions[lashes]) - positions[lashes]
    assert np.abs(moved[lashes] - wanted).max() < 0.1 * MM


def test_a_face_at_rest_leaves_them_where_they_are(lids: tuple) -> None:
    positions, polygons, upper, lower, lashes = lids
    moved = np.zeros_like(positions)
    RootedParts(positions, polygons, lashes, np.concatenate([upper, lower])).follow(moved)
    assert (moved == 0.0).all()


@pytest.mark.slow
@pytest.mark.parametrize("name", ["makehuman", "ict"])
def test_lashes_of_shut_eyes_stay_on_their_lids(
    shared_face: Callable[[str], Face], shared_head: Callable, name: str
) -> None:
    face, lashes = shared_face(name), shared_head(name).labels == 6
    frame = np.full(68, np.nan)
    frame[18:22] = 1024.0
    shut = face.pose(frame).positions
    edges = np.concatenate([np.stack([p, np.roll(p, 1)], axis=1) for p in face.polygons if lashes[p].all()])
    before, after = (np.linalg.norm(v[edges[:, 0]] - v[edges[:, 1]], axis=1) for v in (face.vertices, shut))
    assert (after / before).max() < 1.7
    skin = face.vertices[face.outer_skin]
    for root in np.flatnonzero(lashes):
        near = np.linalg.norm(skin - face.vertices[root], axis=1)
        if near.min() < 0.5 * MM:
            carrier = face.outer_skin[near.argmin()]
            gap = (shut[root] - shut[carrier]) - (face.vertices[root] - face.vertices[carrier])
            assert np.linalg.norm(gap) < 0.8 * MM


def test_what_is_on_the_skull_stays_unless_the_head_turns(shared_head: Callable) -> None:
    head = shared_head("makehuman")
    lashes = head.labels == 6
    parts = np.where(lashes, int(Part.SKULL), head.parts())
    face = Face.from_arrays(head.vertices, head.polygons, head.points, parts)
    frame = np.full(68, np.nan)
    frame[18:22] = 1024.0
    assert (face.pose(frame).positions[lashes] == head.vertices[lashes]).all()
    frame[48] = 10000.0
    assert np.linalg.norm(face.pose(frame).positions[lashes] - head.vertices[lashes], axis=1).min() > 2.0 * MM


@pytest.mark.slow
def test_long_hair_makes_no_neck_and_is_not_read(shared_head: Callable) -> None:
    """How the head is turned is told by the head."""
    head = shared_head("makehuman")
    strand = np.array([[0.0, 0.1, 1.1], [0.0, 0.1, -0.3], [0.01, 0.1, -0.3], [0.01, 0.1, 1.1]])
    vertices = np.concatenate([head.vertices, strand])
    count = len(head.vertices)
    parts = np.append(head.parts(), [int(Part.SKULL)] * 4)
    bald = Face.from_arrays(head.vertices, head.polygons, head.points, head.parts())
    haired = Face.from_arrays(vertices, [*head.polygons, np.arange(count, count + 4)], head.points, parts)
    frame = np.full(68, np.nan)
    frame[48] = 20000.0
    np.testing.assert_allclose(haired.pose(frame).positions[:count], bald.pose(frame).positions, atol=1e-9)
    assert (haired.anatomy.head_turn.skull < count).all()
