"""Files of landmarks: every form of MediaPipe's, upright and in one unit."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from risorius.errors import FormatError, ParameterError
from risorius.mpeg4.streams.capture import (
    holds_landmarks,
    landmarks_from_csv,
    landmarks_from_json,
    read_json_frames,
    read_table_file,
)

COUNT, FRAMES = 478, 3


@pytest.fixture(scope="module")
def raw() -> np.ndarray:
    """(T, N, 3) landmarks as MediaPipe gives them."""
    return np.random.default_rng(1).uniform(0.2, 0.8, (FRAMES, COUNT, 3)).round(4)


def as_objects(points: np.ndarray) -> list[Any]:
    """Landmarks as objects."""
    return [{"x": x, "y": y, "z": z, "visibility": 0.0} for x, y, z in points.tolist()]


JSON_FORMS: dict[str, Callable[[np.ndarray], dict[str, Any]]] = {
    "lists": lambda points: {"landmarks": points.tolist()},
    "objects": lambda points: {"landmarks": as_objects(points)},
    "python": lambda points: {"face_landmarks": [as_objects(points)]},
    "javascript": lambda points: {"faceLandmarks": [as_objects(points)]},
    "solutions": lambda points: {"multi_face_landmarks": [{"landmark": as_objects(points)}]},
    "one row of numbers": lambda points: {"landmarks": points.ravel().tolist()},
    "keypoints": lambda points: {"faces": [{"keypoints": as_objects(points)}]},
    "a mesh": lambda points: {"scaledMesh": points.tolist()},
}


@pytest.mark.parametrize("form", sorted(JSON_FORMS))
def test_json_in_every_form(form: str, raw: np.ndarray, tmp_path: Path) -> None:
    """To the right of the picture, up and towards the camera, with the picture's height as unit."""
    document = [{"timestamp": 0.04 * i, **JSON_FORMS[form](points)} for i, points in enumerate(raw)]
    (tmp_path / "a.json").write_text(json.dumps(document))
    read = landmarks_from_json(read_json_frames(tmp_path / "a.json"), aspect=2.0)
    np.testing.assert_allclose(read.times, [0.0, 0.04, 0.08])
    np.testing.assert_allclose(read.positions, raw * [2.0, -1.0, -2.0])


WIDE = {
    "x_0": "{axis}_{number}",
    "x0": "{axis}{number}",
    "0_x": "{number}_{axis}",
    "landmark_0_x": "landmark_{number}_{axis}",
    "lm0_x": "lm{number}_{axis}",
    "lm_0.x": "lm_{number}.{axis}",
    "x[0]": "{axis}[{number}]",
}


@pytest.mark.parametrize("style", sorted(WIDE))
def test_wide_tables_in_every_style(style: str, raw: np.ndarray, tmp_path: Path) -> None:
    heading = ["timestamp", *(WIDE[style].format(axis=axis, number=n) for axis in "xyz" for n in range(COUNT))]
    rows = [[f"{0.04 * i}", *map(str, points.T.ravel())] for i, points in enumerate(raw)]
    (tmp_path / "a.csv").write_text("\n".join(",".join(row) for row in [heading, *rows]))
    table = read_table_file(tmp_path / "a.csv")
    assert holds_landmarks(table)
    np.testing.assert_allclose(landmarks_from_csv(table, aspect=2.0).positions, raw * [2.0, -1.0, -2.0])


def test_long_tables(raw: np.ndarray, tmp_path: Path) -> None:
    rows = [f"{i},{n},{x},{y},{z}" for i, points in enumerate(raw) for n, (x, y, z) in enumerate(points)]
    (tmp_path / "a.csv").write_text("\n".join(["frame,landmark,x,y,z", *rows]))
    read = landmarks_from_csv(read_table_file(tmp_path / "a.csv"), aspect=2.0, rate=50.0)
    np.testing.assert_allclose(read.positions, raw * [2.0, -1.0, -2.0])
    np.testing.assert_allclose(read.times, [0.0, 0.02, 0.04])


@pytest.mark.parametrize("form", ["wide", "long"])
def test_landmarks_counted_from_1(form: str, raw: np.ndarray, tmp_path: Path) -> None:
    if form == "wide":
        names = [f"{axis}{mark}" for mark in range(1, COUNT + 1) for axis in "xyz"]
        rows = [",".join(map(str, points.ravel())) for points in raw]
    else:
        names = ["frame", "landmark_id", "x", "y", "z"]
        rows = [
            f"{frame},{mark + 1},{','.join(map(str, point))}"
            for frame, points in enumerate(raw)
            for mark, point in enumerate(points)
        ]
    (tmp_path / "a.csv").write_text("\n".join([",".join(names), *rows]))
    found = landmarks_from_csv(read_table_file(tmp_path / "a.csv"), aspect=1.0)
    np.testing.assert_allclose(found.positions, raw * [1.0, -1.0, -1.0])


def test_landmarks_without_depth_are_refused(raw: np.ndarray, tmp_path: Path) -> None:
    names = [f"{axis}{mark}" for mark in range(COUNT) for axis in "xy"]
    rows = [",".join(map(str, points[:, :2].ravel())) for points in raw]
    (tmp_path / "a.csv").write_text("\n".join([",".join(names), *rows]))
    table = read_table_file(tmp_path / "a.csv")
    assert holds_landmarks(table)
    with pytest.raises(FormatError, match=r"lacks the columns z_0.*depth"):
        landmarks_from_csv(table)


def test_pixels_are_square_and_need_no_aspect(raw: np.ndarray, tmp_path: Path) -> None:
    (tmp_path / "a.json").write_text(json.dumps([{"landmarks": (raw[0] * 500.0).tolist()}]))
    read = landmarks_from_json(read_json_frames(tmp_path / "a.json"), aspect=2.0)
    np.testing.assert_allclose(read.positions[0], raw[0] * 500.0 * [1.0, -1.0, -1.0])


def test_a_frame_without_a_face_is_unknown(raw: np.ndarray, tmp_path: Path) -> None:
    document = [{"landmarks": raw[0].tolist()}, {"landmarks": []}, {"landmarks": raw[1].tolist()}]
    (tmp_path / "a.json").write_text(json.dumps(document))
    positions = landmarks_from_json(read_json_frames(tmp_path / "a.json")).positions
    assert np.isnan(positions[1]).all()
    assert np.isfinite(positions[[0, 2]]).all()


@pytest.mark.parametrize(
    ("change", "named"),
    [
        (lambda points: [{"landmarks": points[:68]}], "68 landmarks"),
        (lambda points: [{"landmarks": points}, {"landmarks": points[:470]}], "frame 1, landmarks"),
        (lambda points: [{"landmarks": [*points[:5], [1, 2], *points[6:]]}], "frame 0, landmark 5"),
        (lambda points: [{"landmarks": [*points[:5], [1, 2, "far"], *points[6:]]}], "frame 0, landmark 5"),
        (lambda points: [{"landmarks": [points, points]}], "2 faces"),
        (lambda points: [{"landmarks": 7}], "frame 0, landmarks"),
    ],
)
def test_damaged_json_names_frame_and_landmark(
    change: Callable[[list[Any]], Any], named: str, raw: np.ndarray, tmp_path: Path
) -> None:
    (tmp_path / "a.json").write_text(json.dumps(change(raw[0].tolist())))
    with pytest.raises(FormatError, match=named):
        landmarks_from_json(read_json_frames(tmp_path / "a.json"))


@pytest.mark.parametrize(
    ("rows", "named"),
    [
        (["0,0,1,1,1", "0,half,1,1,1"], "line 3"),
        (["0,0,1,1,1", "0,1.5,1,1,1"], "line 3"),
        (["0,0,1,1,1", "0,-1,1,1,1"], "line 3"),
        (["0,0,1,1,1"], "1 landmarks"),
        (["0,477,1,1,1", "1,477,1,1,1", "2,477,1,1,1", "3,477,1,1,1"], "most landmarks missing"),
    ],
)
def test_damaged_long_tables_are_refused(rows: list[str], named: str, tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text("\n".join(["frame,landmark,x,y,z", *rows]))
    with pytest.raises(FormatError, match=named):
        landmarks_from_csv(read_table_file(tmp_path / "a.csv"))


def test_an_aspect_of_nothing_is_refused(raw: np.ndarray, tmp_path: Path) -> None:
    (tmp_path / "a.json").write_text(json.dumps([{"landmarks": raw[0].tolist()}]))
    with pytest.raises(ParameterError, match="aspect"):
        landmarks_from_json(read_json_frames(tmp_path / "a.json"), aspect=0.0)
