"""Coarse skin is solved on a split one: the mesh's own vertices first, the others where the skin is round."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
import risorius.api as api
from risorius.api import Creases, Face
from risorius.face.assembly import Assembly
from risorius.face.mesh.openings import Opening
from risorius.face.mesh.template import MM
from risorius.face.response.folds import Folds
from risorius.face.skin.fine import SOLVED, SUMMED, fine_skin
from risorius.face.skin.outer import OuterSkin

RADIUS, SIDE = 60 * MM, 9


def cap() -> OuterSkin:
    """Quads of some 10 mm on a ball."""
    x, y = (grid.ravel() * 10 * MM for grid in np.meshgrid(np.arange(SIDE) - SIDE // 2, np.arange(SIDE) - SIDE // 2))
    flat = np.column_stack([x, y, np.full(len(x), RADIUS)])
    corner = (np.arange(SIDE - 1)[:, None] * SIDE + np.arange(SIDE - 1)).ravel()
    path = np.arange(3)
    return OuterSkin(
        index=np.arange(len(x)) + 100,
        positions=RADIUS * flat / np.linalg.norm(flat, axis=1, keepdims=True),
        polygons=list(np.column_stack([corner, corner + 1, corner + SIDE + 1, corner + SIDE])),
        points={"3.5": np.array([0.0, 0.0, RADIUS]), "3.6": np.array([0.0, 0.0, RADIUS])},
        mouth=Opening(path, path + SIDE),
        eyes={side: Opening(path, path + SIDE) for side in "lr"},
    )


def test_new_vertices_of_a_ball_lie_on_the_ball() -> None:
    """Away from the patch's border, whose normals are one-sided; flat middles would lie up to 0.3 mm inside it."""
    skin = cap()
    fine, matrix = fine_skin(skin, 6 * MM)
    flat = np.asarray(matrix @ skin.positions)
    within = np.abs(flat[:, :2]).max(axis=1) < 20 * MM
    assert (RADIUS - np.linalg.norm(flat[within], axis=1)).max() > 0.25 * MM
    assert np.abs(np.linalg.norm(fine.positions[within], axis=1) - RADIUS).max() < 0.02 * MM


def test_own_vertices_come_first_and_stay() -> None:
    skin = cap()
    fine, matrix = fine_skin(skin, 3 * MM)
    count = skin.vertex_count
    assert fine.vertex_count == matrix.shape[0] > 10 * count
    np.testing.assert_array_equal(fine.positions[:count], skin.positions)
    np.testing.assert_array_equal(matrix[:count].toarray(), np.eye(count))
    np.testing.assert_array_equal(fine.index, skin.index)
    assert fine.mouth.upper[::4].tolist() == skin.mouth.upper.tolist()
    assert fine_skin(fine, 3 * MM)[0] is fine


def spacing(skin: OuterSkin) -> float:
    """Distance of vertices in the middle, metres."""
    return float(np.median(np.sqrt(skin.areas)))


def test_only_coarse_faces_are_split(face: Face, any_face: Callable[[str], Face]) -> None:
    assert face.anatomy.skin is face.anatomy.given_skin
    coarse = any_face("mediapipe").anatomy
    assert spacing(coarse.skin) <= SOLVED < spacing(coarse.given_skin)
    assert SUMMED < SOLVED
    np.testing.assert_array_equal(coarse.skin.positions[: coarse.given_skin.vertex_count], coarse.given_skin.positions)


def test_a_coarse_face_shows_folds_and_creases_of_its_own_mesh_alone(any_face: Callable[[str], Face]) -> None:
    """The nasolabial fold is narrower than its edges, though not than those of the skin that is solved."""
    coarse = any_face("mediapipe")
    own, anatomy = coarse.anatomy.given_skin, coarse.anatomy
    assert not Assembly(anatomy).folds.placed
    assert Folds(anatomy.skin, anatomy.warp, np.array([0])).placed
    creases = Creases(coarse)
    assert creases.areas.sum() == pytest.approx(own.areas.sum())
    surprise = api.expression("surprise")
    pose = coarse.pose(surprise.frame(), emotion=surprise.weights)
    assert pose.positions.shape == coarse.vertices.shape
    assert creases.amounts(pose.positions)["forehead"] > 0.25


def test_a_coarse_face_meets_what_is_asked_of_its_own_points(any_face: Callable[[str], Face]) -> None:
    """FAPs are read off the mesh that the user has, not off the one that is solved."""
    coarse, frame = any_face("mediapipe"), np.full(68, np.nan)
    frame[np.array([12, 13, 31, 32]) - 1] = 150.0, 100.0, 200.0, 120.0
    pose = coarse.pose(frame, drive="exact")
    asked = ~np.isnan(frame)
    np.testing.assert_allclose(coarse.measure(pose.positions)[asked], frame[asked], rtol=1e-3)
