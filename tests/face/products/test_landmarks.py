"""Landmarks of other conventions on a face: where they must be by what they are, and that they go with the skin."""

from __future__ import annotations

import numpy as np
import pytest
import risorius.api as api
from risorius.face.products.landmarks import template_places
from risorius.face.tracked.mediapipe_landmarks import landmark_numbers

FACE = api.default_face()
MARKS = api.face_landmarks(FACE)
REST = np.asarray(MARKS.matrix @ FACE.vertices)


def test_every_landmark_has_a_place_and_the_68_are_distinct() -> None:
    assert REST.shape == (478, 3)
    np.testing.assert_allclose(np.asarray(MARKS.matrix @ np.ones((len(FACE.vertices), 1))), 1.0)
    assert len(set(MARKS.ibug68.tolist())) == len(MARKS.parts) == 68
    assert sorted(template_places()) == list(range(468))


def test_landmarks_that_are_feature_points_lie_at_these() -> None:
    """Corners exactly, others within what a tracker and an animator may differ by: a tenth of the eyes' distance."""
    off = {
        name: float(np.linalg.norm(REST[number] - FACE.points[name].position)) / FACE.units.es0
        for name, number in landmark_numbers().items()
        if name in FACE.points
    }
    assert max(off[name] for name in ("2.4", "2.5", "3.7", "3.8", "3.11", "3.12")) < 0.02
    assert np.median(list(off.values())) < 0.07
    assert max(off[name] for name in ("8.1", "8.2", "8.3", "8.4", "9.3", "2.2", "2.3")) < 0.1


def test_left_and_right_mirror_each_other_on_a_symmetric_head() -> None:
    flipped = REST * [-1.0, 1.0, 1.0]
    apart = np.linalg.norm(flipped[:, None] - REST, axis=2).min(axis=1)
    assert apart.max() < 2e-3


def test_irises_lie_round_the_pupils_and_turn_with_the_eyes() -> None:
    for first, ball in ((473, FACE.eyeballs[0]), (468, FACE.eyeballs[1])):
        if FACE.parts[ball.vertices[0]] != (api.Part.EYEBALL_L if first == 473 else api.Part.EYEBALL_R):
            ball = FACE.eyeballs[1] if first == 473 else FACE.eyeballs[0]
        radii = np.linalg.norm(REST[first + 1 : first + 5] - REST[first], axis=1)
        assert np.ptp(radii) < 0.15 * radii.mean()
        left, up, right, down = REST[first + 1 : first + 5] @ FACE.axes.T - REST[first] @ FACE.axes.T
        assert left[0] > 0.0 > right[0]
        assert up[1] > 0.0 > down[1]
    frame = np.full(68, np.nan)
    frame[23 - 1] = frame[24 - 1] = 30000.0  # both eyes 17 degrees to the left
    moved = np.asarray(MARKS.matrix @ FACE.pose(frame).positions)
    assert (moved[[468, 473], 0] - REST[[468, 473], 0] > 2e-3).all()


@pytest.mark.parametrize("upper_lower", [(13, 14), (0, 17), (82, 87)])
def test_lips_part_between_the_landmarks_of_both(upper_lower: tuple[int, int]) -> None:
    frame = np.full(68, np.nan)
    frame[3 - 1] = 800.0  # open_jaw
    moved = np.asarray(MARKS.matrix @ FACE.pose(frame).positions)
    upper, lower = upper_lower
    opened = np.linalg.norm(moved[upper] - moved[lower]) - np.linalg.norm(REST[upper] - REST[lower])
    assert opened > 8e-3


def test_lids_near_each_other_in_a_blink() -> None:
    frame = np.full(68, np.nan)
    frame[[19 - 1, 20 - 1]] = 900.0
    moved = np.asarray(MARKS.matrix @ FACE.pose(frame).positions)
    for upper, lower in ((386, 374), (159, 145)):
        gaps = [np.linalg.norm(places[upper] - places[lower]) for places in (moved, REST)]
        assert gaps[0] < 0.5 * gaps[1]
