"""Skin that a face cannot move is told from what it can: far along the skin, not through the air."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from risorius.api import Face
from risorius.face import anatomy
from risorius.face.mesh import reach
from risorius.face.mesh.reach import ReachFigures, within_reach
from risorius.polygons import PolygonTable


def band(path: np.ndarray) -> tuple[np.ndarray, PolygonTable]:
    """A band of quads, 10 mm wide, along a path (n, 3); vertex 2 k lies on its k-th place."""
    vertices = np.repeat(path, 2, axis=0)
    vertices[1::2, 0] += 0.01
    first = 2 * np.arange(len(path) - 1)[:, None]
    return vertices, PolygonTable.of(first + np.array([0, 1, 3, 2]))


def straight(length: float) -> np.ndarray:
    """Places every 10 mm along an axis."""
    along = np.arange(0.0, length, 0.01)
    return np.stack([np.zeros_like(along), np.zeros_like(along), along], axis=1)


def aside(width: float, along: float = 0.0) -> np.ndarray:
    """A shift beside the band, and along it."""
    return np.array([0.0, width, along])


def test_skin_farther_than_the_reach_is_left_out() -> None:
    vertices, polygons = band(straight(1.0))
    near = within_reach(vertices, polygons, np.array([0]))
    assert near[vertices[:, 2] < 0.295].all()
    assert not near[vertices[:, 2] > 0.305].any()


def test_a_head_that_lies_within_reach_is_taken_whole_though_its_skin_winds() -> None:
    winding = np.concatenate([straight(0.25), straight(0.25)[::-1] + aside(0.02)])
    vertices, polygons = band(winding)
    assert within_reach(vertices, polygons, np.array([0])).all()


def test_a_hand_before_the_face_is_far_along_the_skin() -> None:
    arm = np.concatenate([straight(0.5), straight(0.5)[::-1] + aside(0.05)])
    vertices, polygons = band(arm)
    near = within_reach(vertices, polygons, np.array([0]))
    hand = (vertices[:, 1] > 0.04) & (vertices[:, 2] < 0.2)
    assert hand.any()
    assert not near[hand].any()
    assert near[(vertices[:, 1] < 0.01) & (vertices[:, 2] < 0.295)].all()


def test_a_mouth_bag_of_its_own_is_within_reach_through_the_air() -> None:
    body, skin = band(straight(1.0))
    bag, inside = band(straight(0.1) + aside(0.02))
    far, away = band(straight(0.1) + aside(0.02, 0.8))
    vertices = np.concatenate([body, bag, far])
    polygons = PolygonTable.joined(
        [
            skin,
            inside.numbered(np.arange(len(bag)) + len(body)),
            away.numbered(np.arange(len(far)) + len(body) + len(bag)),
        ]
    )
    near = within_reach(vertices, polygons, np.array([0]))
    assert near[len(body) : len(body) + len(bag)].all()
    assert not near[len(body) + len(bag) :].any()


@pytest.mark.slow
def test_a_body_cut_off_the_head_leaves_its_faces_as_they_are(shared: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    data = np.load(shared / "heads" / "makehuman_body.npz")
    points = json.loads((shared / "heads" / "makehuman_body.fp.json").read_text())["points"]
    polygons = PolygonTable(data["loops"], data["face_sizes"])
    vertices = data["vertices"].astype(np.float64)
    wide = np.full(68, np.nan)
    wide[[2, 5, 6, 11, 12]] = 600.0, 150.0, 150.0, 80.0, 80.0
    monkeypatch.setattr(anatomy, "MOST", len(vertices))
    cut = Face.from_arrays(vertices, polygons, points)
    posed, solved = cut.pose(wide).positions, cut.anatomy.skin.vertex_count
    monkeypatch.setattr(reach, "REACH", ReachFigures(along_the_skin=10.0))
    whole = Face.from_arrays(vertices, polygons, points)
    assert solved < 0.4 * whole.anatomy.skin.vertex_count
    assert np.array_equal(cut.outer_skin, whole.outer_skin)
    moved = posed - whole.pose(wide).positions
    assert np.abs(moved).max() < 1e-6 * cut.scale * 0.1
