"""A long motion lies between some of its frames that are posed: near their poses, at rest where nothing is asked."""

from __future__ import annotations

import numpy as np
import pytest
import risorius.api as api
from risorius.face import long_motion
from risorius.face.long_motion import LongMotion
from risorius.physics.elastic import Factor
from risorius.progress import run

pytestmark = pytest.mark.slow

COUNT = 400


def speech() -> np.ndarray:
    """(400, 68) a mouth that opens and spreads, lids that blink, brows and a head that move; at rest at first."""
    time, frames = np.arange(COUNT) / 25.0, np.full((COUNT, 68), np.nan)
    wave = {
        3: 250.0 * np.sin(2.1 * time) ** 2,
        6: 150.0 * np.sin(1.3 * time),
        7: 120.0 * np.sin(1.4 * time),
        12: 100.0 * np.sin(1.7 * time),
        13: 100.0 * np.sin(1.7 * time + 0.3),
        19: 900.0 * (np.sin(2.7 * time) > 0.9),
        20: 900.0 * (np.sin(2.7 * time) > 0.9),
        31: 120.0 * np.sin(0.9 * time),
        32: 120.0 * np.sin(0.9 * time),
        48: 9000.0 * np.sin(0.6 * time),
        49: 12000.0 * np.sin(0.8 * time),
    }
    for number, values in wave.items():
        frames[:, number - 1] = np.where(time < 1.0, 0.0, values)
    return frames


@pytest.fixture(scope="module")
def moved() -> tuple[api.Face, LongMotion]:
    """The default face, and its motion of which at most 120 frames are posed."""
    face = api.default_face()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(long_motion, "POSED", 120)
        return face, run(face.long_motion(speech()))


def test_frames_between_are_near_their_own_poses(moved: tuple[api.Face, LongMotion]) -> None:
    face, motion = moved
    assert len(motion) == COUNT
    assert len(motion.posed) <= 120 + long_motion.LOOKED_AT < COUNT
    left = np.setdiff1d(np.arange(COUNT), motion.posed)[::25]
    off = [
        np.linalg.norm(face.pose(motion.frames[s]).positions - motion.positions(np.array([s]))[0], axis=1) for s in left
    ]
    assert np.median([each.max() for each in off]) < 0.3e-3
    assert np.max(off) < 1.5e-3
    assert np.median(motion.off) < 0.6e-3


def test_posed_frames_are_their_poses_with_the_heads_turn(moved: tuple[api.Face, LongMotion]) -> None:
    face, motion = moved
    step = int(np.abs(motion.frames[motion.posed, 48]).argmax())
    frame = int(motion.posed[step])
    pose = face.pose(motion.frames[frame]).positions
    assert np.abs(pose - motion.positions(np.array([frame]))[0]).max() < 0.1e-3
    assert np.abs(pose - face.vertices).max() > 10e-3


def test_a_rest_stays_a_rest_and_frames_come_one_by_one(moved: tuple[api.Face, LongMotion]) -> None:
    face, motion = moved
    assert np.abs(motion.positions(np.arange(20)) - face.vertices).max() < 1e-6
    some = np.array([3, 77, 399])
    one_by_one = list(motion)
    assert len(one_by_one) == COUNT
    np.testing.assert_allclose([one_by_one[s] for s in some], motion.positions(some), atol=1e-12)
    vertices = np.array([5, 900])
    np.testing.assert_allclose(motion.positions(some, vertices), motion.positions(some)[:, vertices], atol=1e-12)


def test_posed_frames_take_few_solves(moved: tuple[api.Face, LongMotion], monkeypatch: pytest.MonkeyPatch) -> None:
    """Whatever the clock says: what is known of others foretells each; posed by itself, one takes over seven."""
    face, motion = moved
    solved: list[int] = []
    solve = Factor.solve

    def counted(factor: Factor, right: np.ndarray) -> np.ndarray:
        if factor.shape[0] == face.anatomy.skin.vertex_count:
            solved.append(1)
        return solve(factor, right)

    monkeypatch.setattr(Factor, "solve", counted)
    monkeypatch.setattr(long_motion, "POSED", 120)
    run(face.long_motion(speech()))
    assert len(solved) < 4 * len(motion.posed)


def test_frames_alike_are_posed_once() -> None:
    """A pattern repeated fifty times needs the poses of one."""
    face = api.default_face()
    frames = np.tile(speech()[25:41], (50, 1))
    motion = run(face.long_motion(frames))
    assert len(motion.posed) <= 16 + long_motion.LOOKED_AT
    assert motion.off.max() < 0.3e-3
