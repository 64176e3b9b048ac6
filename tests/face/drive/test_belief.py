"""Muscles are believed where they explain what is asked, and leave the rest to the elastic skin."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from risorius.api import Face
from risorius.face.drive.belief import Belief
from risorius.face.drive.drives import DRIVES
from risorius.face.drive.plan import Plan
from risorius.face.drive.request import Drive, Request

DRAWN = "heads/others/makehuman_arkit/makehuman_arkit_visemes.npz"

#: The rim of the upper lip up and its outer edge down, all around left where it is: no muscle does that.
UNLIKE_MUSCLES = {4: -250.0, 51: 150.0}


def frame_of(asked: dict[int, float], other: float = np.nan) -> np.ndarray:
    frame = np.full(68, other)
    for number, value in asked.items():
        frame[number - 1] = value
    return frame


def shares(face: Face, frame: np.ndarray) -> np.ndarray:
    """(n,) how far the muscles that explain a frame exactly are believed."""
    balance, inverse = face._poser.balance, face.anatomy.inverse
    targets = DRIVES[Drive.EXACT].targets(inverse.rows, Plan.as_asked(Request(frame, Drive.EXACT)))
    return balance.belief.shares(inverse.solve(targets), targets)


def near(face: Face, point: str) -> int:
    """The vertex of the outer skin next to a feature point."""
    skin = face.anatomy.skin
    return int(np.argmin(np.linalg.norm(skin.positions - skin.points[point], axis=1)))


def test_muscles_are_believed_where_nothing_is_asked_of_them(face: Face) -> None:
    assert shares(face, frame_of({})) == pytest.approx(1.0)


def test_what_muscles_do_themselves_is_believed(face: Face) -> None:
    """A smile that muscles made is explained by them, in one region and not in another."""
    smile = face.pose(
        frame_of({}), drive="muscles", contractions={"zygomaticus_major_l": 0.5, "zygomaticus_major_r": 0.5}
    )
    believed = shares(face, smile.achieved)
    assert believed[near(face, "8.3")] > 0.95


def test_what_no_muscle_does_is_left_to_the_skin(face: Face) -> None:
    believed = shares(face, frame_of(UNLIKE_MUSCLES, other=0.0))
    assert believed[near(face, "8.1")] < 0.6
    assert believed[near(face, "11.3")] > 0.95  # the forehead is far from it


def test_a_brow_lowered_further_than_anatomy_allows_is_left_to_the_skin(face: Face) -> None:
    """Outer brows hardly go down: what is asked beyond their range is nothing that a muscle tells of."""
    usual, beyond = (shares(face, frame_of({33: -120.0, 35: outer})) for outer in (-30.0, -200.0))
    assert beyond[near(face, "4.5")] < 0.6 * usual[near(face, "4.5")]


def test_muscles_that_are_not_believed_leave_the_answer_of_the_points(
    face: Face, monkeypatch: pytest.MonkeyPatch
) -> None:
    frame = frame_of(UNLIKE_MUSCLES, other=0.0)
    points = face.pose(frame, drive="points").positions
    judged = face.pose(frame, drive="exact").positions
    monkeypatch.setattr(
        Belief, "shares", lambda self, found, targets: np.ones(self.inverse.actuators.skin.vertex_count)
    )
    blindly = face.pose(frame, drive="exact").positions
    assert np.linalg.norm(judged - points) < 0.85 * np.linalg.norm(blindly - points)


def test_the_pose_tells_what_muscles_did(face: Face) -> None:
    """Of a smile that muscles made nearly all; of what no muscle does less; nothing where points are moved alone."""
    pull = {"zygomaticus_major_l": 0.5, "zygomaticus_major_r": 0.5}
    smile = face.pose(frame_of({}), drive="muscles", contractions=pull).achieved
    assert face.pose(smile, drive="exact").by_muscles[12] > 0.8
    assert face.pose(frame_of(UNLIKE_MUSCLES, other=0.0), drive="exact").by_muscles[4] < 0.5
    assert face.pose(frame_of({12: 100.0}), drive="points").by_muscles == {12: 0.0}


def test_a_muscle_set_by_hand_is_believed(face: Face) -> None:
    """Contracted where nothing that is asked explains it."""
    frame = frame_of({4: 0.0, 8: 0.0, 9: 0.0}, other=np.nan)
    bare = face.pose(frame, drive="natural").positions
    pulled = face.pose(frame, drive="natural", contractions={"frontalis_med_l": 1.0}).positions
    alone = face.pose(frame_of({}), drive="muscles", contractions={"frontalis_med_l": 1.0}).positions - face.vertices
    assert np.abs(pulled - bare).max() > 0.7 * np.abs(alone).max()


@pytest.fixture(scope="module")
def drawn(shared: Path) -> dict[str, np.ndarray]:
    """Shape -> (V, 3) displacement of the MakeHuman head, drawn by other people, metres."""
    if not (shared / DRAWN).is_file():
        pytest.skip(f"no {DRAWN}")
    data = np.load(shared / DRAWN)
    return dict(zip(data["names"].tolist(), data["deltas"].astype(np.float64), strict=True))


@pytest.mark.slow
@pytest.mark.parametrize(
    "name", ["browDownLeft", "mouthFunnel", "mouthShrugLower", "mouthLowerDownLeft", "noseSneerLeft"]
)
def test_shapes_that_others_drew_are_not_overshot(
    any_face: Callable[[str], Face], drawn: dict[str, np.ndarray], name: str
) -> None:
    face = any_face("makehuman")
    skin = face.outer_skin
    shape = drawn[name]
    shown = face.pose(face.measure(face.vertices + shape), drive="exact").positions - face.vertices
    assert ((shown - shape)[skin] ** 2).sum() < (shape[skin] ** 2).sum()
