"""What a face tells of its anatomy, in its own coordinates, whichever way it looks and however large it is."""

from __future__ import annotations

import numpy as np
import pytest
import risorius.api as api
from risorius.api import Face, Part

TURN = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
SCALE, SHIFT = 12.5, np.array([3.0, -2.0, 0.5])


@pytest.fixture(scope="module")
def turned() -> Face:
    """The default head looking another way, in another unit and place."""
    head = api.build_default_head()
    moved = SCALE * head.vertices @ TURN.T + SHIFT
    points = {
        name: point if isinstance(point, int) else SCALE * TURN @ point + SHIFT for name, point in head.points.items()
    }
    return Face.from_arrays(moved, head.polygons, points, head.parts)


@pytest.fixture(scope="module")
def mask(face: Face) -> Face:
    """The default head without what is behind the eyes and above the brows."""
    x, y, z = face.vertices.T
    front = (y < face.points["3.7"].position[1] + 0.04) & (z < face.points["4.3"].position[2] + 0.015)
    kept = [polygon for polygon in face.polygons if front[polygon].all()]
    used = np.unique(np.concatenate(kept))
    number = np.cumsum(np.isin(np.arange(len(x)), used)) - 1
    points = {name: point.position for name, point in face.points.items() if front[point.vertices].all()}
    return Face.from_arrays(face.vertices[used], [number[p] for p in kept], points, np.asarray(face.parts)[used])


def test_axes_are_left_up_and_forward(face: Face, turned: Face) -> None:
    np.testing.assert_allclose(face.axes, [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]], atol=1e-12)
    np.testing.assert_allclose(turned.axes, face.axes @ TURN.T, atol=1e-12)


def test_eyeballs_look_ahead_between_their_lids(face: Face) -> None:
    left, right = face.eyeballs
    for ball, part, corners in ((left, Part.EYEBALL_L, ("3.7", "3.11")), (right, Part.EYEBALL_R, ("3.8", "3.12"))):
        assert set(np.asarray(face.parts)[ball.vertices]) == {part}
        np.testing.assert_allclose(ball.gaze, face.axes[2], atol=0.05)
        assert np.linalg.norm(ball.gaze) == pytest.approx(1.0)
        assert 0.0 < ball.pupil < ball.iris < 1.0
        middle = np.mean([face.points[name].position for name in corners], axis=0)
        assert np.linalg.norm(middle - ball.centre) < 0.03
        away = np.linalg.norm(face.vertices[ball.vertices] - ball.centre, axis=1)
        assert away.max() < 0.02


def test_eyeballs_go_with_the_face(face: Face, turned: Face) -> None:
    for one, other in zip(face.eyeballs, turned.eyeballs, strict=True):
        np.testing.assert_array_equal(one.vertices, other.vertices)
        np.testing.assert_allclose(other.centre, SCALE * one.centre @ TURN.T + SHIFT, atol=1e-9)
        np.testing.assert_allclose(other.gaze, one.gaze @ TURN.T, atol=1e-9)
        assert (one.iris, one.pupil) == pytest.approx((other.iris, other.pupil))


def test_the_outer_skin_is_skin_without_the_lining_of_mouth_and_eyes(face: Face) -> None:
    parts = np.asarray(face.parts)
    assert set(parts[face.outer_skin]) == {Part.SKIN}
    assert len(face.outer_skin) < (parts == Part.SKIN).sum()
    bound = {int(vertex) for name in ("8.1", "9.3", "3.7") for vertex in face.points[name].vertices}
    assert bound <= set(face.outer_skin.tolist())


def test_a_head_has_a_skull_and_a_mask_has_none(face: Face, mask: Face) -> None:
    assert not face.is_mask
    assert mask.is_mask


def test_what_can_be_contracted_by_hand_is_what_a_pose_contracts(face: Face) -> None:
    assert set(api.contractibles()) == set(face.pose(np.full(68, np.nan)).contractions)
