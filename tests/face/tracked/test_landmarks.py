"""FAPs read off tracked points: known motions of a known face come back, whatever the head does."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path

import numpy as np
import pytest
from places import ROOT
from risorius import api
from risorius.errors import ModelError, ParameterError
from risorius.face.face import Face
from risorius.face.tracked.landmarks import (
    NEUTRAL_SHARE,
    LandmarkReading,
    fit_poses,
    mean_rotation,
    usual_frames,
)
from risorius.face.tracked.mediapipe_landmarks import read_landmarks
from risorius.mpeg4.streams.capture import Landmarks
from risorius.mpeg4.streams.capture.rotation import euler_matrix
from scipy.spatial.transform import Rotation

INDEX: dict[str, int] = tomllib.loads((ROOT / "presets/topologies/mediapipe_468.toml").read_text())["points"]
PUPILS = {"3.5": 473, "3.6": 468}
FRAMES = 40


@pytest.fixture(scope="module")
def asked() -> np.ndarray:
    """(T, 68) a smile that opens, with brows that rise: neutral, up, held, neutral for longest."""
    strength = np.interp(np.arange(FRAMES), [0, 12, 20, 24, 30], [0.0, 0.0, 1.0, 1.0, 0.0])
    frame = np.full(68, np.nan)
    for number, value in {3: 300.0, 31: 90.0, 32: 90.0, 59: 250.0, 60: 250.0, 53: 120.0, 54: 120.0, 19: 200.0}.items():
        frame[number - 1] = value
    return strength[:, None] * frame


@pytest.fixture(scope="module")
def seen(face: Face, asked: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(T, 478, 3) the default face's feature points as landmarks, left, up, forward, and the FAPs that they show."""
    apex = face.pose(np.nan_to_num(asked, nan=0.0)[22] + np.where(np.isnan(asked[22]), np.nan, 0.0), drive="exact")
    names = [name for name in (*INDEX, *PUPILS) if name in face.points]
    read = face.points.matrix(names)
    strength = np.nan_to_num(asked[:, 2]) / 300.0
    moved = np.asarray(read @ (apex.positions - face.vertices))
    rest = np.array([face.points[name].position for name in names])
    positions = rest + strength[:, None, None] * moved
    points = np.full((FRAMES, 478, 3), np.nan)
    points[:, [{**INDEX, **PUPILS}[name] for name in names]] = positions[..., [0, 2, 1]] * [1.0, 1.0, -1.0]
    return points, strength[:, None] * apex.achieved


def turned(points: np.ndarray, rotations: np.ndarray) -> np.ndarray:
    """The points with a head that turns, comes nearer and walks."""
    count = len(points)
    scale = np.linspace(1.0, 1.6, count)[:, None, None] * 3.0
    walk = np.stack([np.linspace(-0.4, 0.6, count), np.full(count, 0.3), np.linspace(0.0, 1.0, count)], axis=1)
    return np.einsum("tij,tpj->tpi", rotations, points) * scale + walk[:, None]


def reading(points: np.ndarray, **options: object) -> LandmarkReading:
    """What landmarks at 25 a second say."""
    return read_landmarks(Landmarks(np.arange(len(points)) / 25.0, points), **options)  # type: ignore[arg-type]


SHOWN = (3, 31, 32, 59, 60, 53, 54, 19)


def test_faps_come_back_from_a_still_head(seen: tuple[np.ndarray, np.ndarray]) -> None:
    points, shown = seen
    read = reading(points)
    for number in SHOWN:
        column = read.frames[:, number - 1]
        np.testing.assert_allclose(column, shown[:, number - 1], atol=0.05 * np.abs(shown[:, number - 1]).max() + 3.0)


def test_faps_come_back_from_a_head_that_turns_and_walks(seen: tuple[np.ndarray, np.ndarray]) -> None:
    points, _ = seen
    angles = np.linspace(-0.35, 0.35, FRAMES)
    rotations = Rotation.from_euler("yxz", np.stack([angles, 0.3 * angles, -0.2 * angles], axis=1)).as_matrix()
    still, moving = reading(points, neutral=(0.0, 0.4)), reading(turned(points, rotations), neutral=(0.0, 0.4))
    for number in SHOWN:
        np.testing.assert_allclose(moving.frames[:, number - 1], still.frames[:, number - 1], atol=3.0)


@pytest.mark.parametrize(("axis", "number"), [("x", 48), ("y", 49), ("z", 50)])
def test_the_heads_turn_from_its_neutral_pose(axis: str, number: int, seen: tuple[np.ndarray, np.ndarray]) -> None:
    """Left, up and forward turn right-handedly down, to the left and to the right shoulder."""
    points = np.repeat(seen[0][:1], FRAMES, axis=0)
    angles = np.where(np.arange(FRAMES) < 25, 0.0, 0.2)
    read = reading(turned(points, Rotation.from_euler(axis, angles[:, None]).as_matrix()), neutral=(0.0, 0.8))
    np.testing.assert_allclose(read.frames[:, number - 1], angles * 1e5, atol=1.0)
    others = [n - 1 for n in (48, 49, 50) if n != number]
    np.testing.assert_allclose(read.frames[:, others], 0.0, atol=1.0)


def test_the_eyes_turn(seen: tuple[np.ndarray, np.ndarray]) -> None:
    """Pupils that shift by a known share of the eyeball."""
    points = np.repeat(seen[0][:1], FRAMES, axis=0)
    radius = 0.19 * (points[0, PUPILS["3.5"], 0] - points[0, PUPILS["3.6"], 0])
    points[30:, PUPILS["3.5"], 0] += radius * np.sin(0.3)
    points[30:, PUPILS["3.6"], 1] -= radius * np.sin(0.2)
    read = reading(points)
    assert read.frames[35, 22] == pytest.approx(3e4, rel=0.02)
    assert read.frames[35, 25] == pytest.approx(2e4, rel=0.02)
    assert abs(read.frames[35, 23]) + abs(read.frames[35, 24]) < 500.0


def test_what_the_landmarks_do_not_show_is_unknown(seen: tuple[np.ndarray, np.ndarray]) -> None:
    read = reading(seen[0])
    for number in (14, 27, 29, 43, 47, 65, 68):
        assert np.isnan(read.frames[:, number - 1]).all()
    blind = seen[0].copy()
    blind[5] = np.nan
    read = reading(blind)
    assert np.isnan(read.frames[5]).all()
    assert np.isfinite(read.frames[6, 2])
    without_irises = reading(seen[0][:, :468])
    assert np.isnan(without_irises.frames[:, 22:26]).all()
    assert np.isfinite(without_irises.frames[:, 58]).all()


def test_the_neutral_face_is_the_usual_one_or_as_told(seen: tuple[np.ndarray, np.ndarray]) -> None:
    usual = reading(seen[0])
    assert len(usual.chosen) == round(NEUTRAL_SHARE * FRAMES)
    assert set(usual.chosen) <= {*range(13), *range(30, FRAMES)}
    told = reading(seen[0], neutral=(20 / 25, 24 / 25))
    assert list(told.chosen) == [20, 21, 22, 23, 24]
    assert told.frames[0, 2] < -200.0  # the open mouth is neutral now
    with pytest.raises(ParameterError, match="neutral"):
        reading(seen[0], neutral=(50.0, 60.0))


def test_a_recording_without_a_face_is_refused() -> None:
    with pytest.raises(ModelError, match="no frame"):
        reading(np.full((4, 478, 3), np.nan))


def test_points_that_lack_what_units_need_are_refused() -> None:
    with pytest.raises(ModelError, match=r"8\.3"):
        api.read_points(np.zeros((2, 1, 3)), ["8.4"], stable=["8.4"], eye_radius=0.2)


def test_similarities_are_exact_and_proper() -> None:
    """A mirrored cloud gets the best rotation, not a mirror."""
    rng = np.random.default_rng(0)
    cloud = rng.normal(size=(9, 3))
    turn = Rotation.from_rotvec([0.3, -0.5, 0.2]).as_matrix()
    pose = fit_poses(cloud, (2.5 * cloud @ turn.T + [1.0, 2.0, 3.0])[None], np.array([True]))
    np.testing.assert_allclose(pose.rotations[0], turn, atol=1e-12)
    assert pose.scales[0] == pytest.approx(2.5)
    np.testing.assert_allclose(pose.undone((2.5 * cloud @ turn.T + [1.0, 2.0, 3.0])[None])[0], cloud, atol=1e-12)
    mirrored = fit_poses(cloud, (cloud * [-1.0, 1.0, 1.0])[None], np.array([True]))
    assert np.linalg.det(mirrored.rotations[0]) == pytest.approx(1.0)


def test_the_mean_of_rotations_is_a_rotation() -> None:
    angles = np.array([-0.2, 0.0, 0.5])
    mean = mean_rotation(euler_matrix(np.zeros(3), angles, np.zeros(3)))
    np.testing.assert_allclose(mean @ mean.T, np.eye(3), atol=1e-12)
    assert np.arctan2(mean[0, 2], mean[0, 0]) == pytest.approx(0.1, abs=0.01)


def test_usual_frames_are_those_that_the_face_keeps() -> None:
    shapes = np.zeros((100, 2, 3))
    shapes[60:, 0, 0] = 1.0 + 0.01 * np.arange(40)
    usual = usual_frames(shapes, np.ones(100, dtype=bool))
    assert len(usual) == round(NEUTRAL_SHARE * 100)
    assert set(usual) <= set(range(60))


def test_a_file_of_landmarks_becomes_a_stream(seen: tuple[np.ndarray, np.ndarray], tmp_path: Path) -> None:
    """As shares of a 16:9 picture; landmarks that are no feature points are of no account."""
    points = np.nan_to_num(turned(seen[0], np.repeat(np.eye(3)[None], FRAMES, axis=0)))
    shares = points / [16.0 / 9.0, -1.0, -16.0 / 9.0]
    frames = [{"timestamp_ms": 40 * i, "landmarks": row.tolist()} for i, row in enumerate(shares)]
    (tmp_path / "a.json").write_text(json.dumps(frames))
    stream = api.read_capture(tmp_path / "a.json")
    assert stream.fps == 25.0
    np.testing.assert_allclose(stream.frames[:, 58], seen[1][:, 58], atol=0.05 * np.abs(seen[1][:, 58]).max() + 3.0)
