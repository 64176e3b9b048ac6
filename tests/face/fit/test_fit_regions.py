"""Heads that are turned on their bodies: the ends of a mesh, and the face found at one of them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import risorius.api as api
from risorius.face.fit.find import locate_points
from risorius.face.fit.locating.regions import ends, middle_and_radius
from scipy.spatial.transform import Rotation

#: How far below the chin the neck begins to turn, metres, and how far the head is turned, tilted and leant, degrees.
NECK, TURN = 0.09, (20.0, 10.0, 8.0)


def test_ends_are_the_tips_of_a_star() -> None:
    random = np.random.default_rng(4)
    tips = np.array([[3.0, 0.0, 0.0], [-1.0, 2.5, 0.0], [-1.0, -2.0, 1.0]])
    arms = [share * tip for tip in tips for share in random.uniform(size=(800, 1))]
    positions = random.permutation(np.concatenate([np.array(arms), [*tips]]))
    positions = positions + random.normal(scale=0.02, size=positions.shape)
    found = np.array(ends(positions))
    away = np.linalg.norm(found[:, None] - tips, axis=2)
    assert len(found) == len(tips)
    assert away.min(axis=0).max() < 0.1


def test_the_radius_is_the_usual_distance_from_the_middle() -> None:
    corners = np.array([[x, y, z] for x in (1.0, 3.0) for y in (-2.0, 2.0) for z in (0.0, 4.0)])
    middle, radius = middle_and_radius(np.concatenate([corners, [[2.0, 0.0, 2.0]]]))
    np.testing.assert_allclose(middle, (2.0, 0.0, 2.0))
    assert radius == pytest.approx(3.0 * np.sqrt(8.0 / 9.0))


def turned_head(vertices: np.ndarray, chin: np.ndarray) -> np.ndarray:
    """A body's vertices (V, 3) with its neck twisted."""
    share = np.clip((vertices[:, 2] - chin[2] + NECK) / NECK, 0.0, 1.0)
    share = share**2 * (3.0 - 2.0 * share)
    twist = Rotation.from_euler("zxy", np.outer(share, TURN), degrees=True)
    pivot = np.array([0.0, 0.0, chin[2]])
    return np.asarray(twist.apply(vertices - pivot) + pivot)


@pytest.mark.slow
def test_the_head_of_a_body_may_be_turned(shared: Path) -> None:
    data = np.load(shared / "heads" / "makehuman_body.npz")
    polygons = np.split(data["loops"].astype(np.int64), np.cumsum(data["face_sizes"])[:-1])
    upright = data["vertices"].astype(float)
    known = api.find_points(upright, polygons)
    assert known.topology is not None
    chin = known.positions["2.1"]
    vertices = turned_head(upright, chin)
    nearest = {name: np.linalg.norm(upright - place, axis=1).argmin() for name, place in known.positions.items()}
    truth = {name: vertices[vertex] for name, vertex in nearest.items()}
    assert np.linalg.norm(truth["9.3"] - known.positions["9.3"]) > 0.02
    y_up = 100.0 * vertices[:, [0, 2, 1]] * np.array([1.0, 1.0, -1.0])
    located = locate_points(y_up, polygons)
    back = {name: place[[0, 2, 1]] / 100.0 * np.array([1.0, -1.0, 1.0]) for name, place in located.positions.items()}
    shared_names = [name for name in back.keys() & truth.keys() if not name.startswith(("10.", "11."))]
    errors = [1000.0 * np.linalg.norm(back[name] - truth[name]) for name in shared_names]
    assert located.score < 1.0
    assert np.median(errors) < 4.0
