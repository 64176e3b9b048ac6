"""What files hold: names in every habit, scales, several faces, and what is not read."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from risorius import api
from risorius.errors import FormatError, ParameterError

SHAPES = api.load_shapes()


def read(path: Path, text: str, **options: object) -> api.FapStream:
    """The stream of a file with that text."""
    path.write_text(text)
    return api.read_stream(path, **options)  # type: ignore[arg-type]


def table(path: Path, columns: dict[str, object], count: int = 3, **options: object) -> api.FapStream:
    """The stream of a table whose columns each have one value, or a list of them."""
    rows = [
        ",".join([f"{0.04 * n:.2f}", *(str(each[n] if isinstance(each, list) else each) for each in columns.values())])
        for n in range(count)
    ]
    return read(path, "\n".join([",".join(["timestamp", *columns]), *rows]), **options)


# ---- names ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "name",
    ["eyeBlinkLeft", "EyeBlinkLeft", "eyeBlink_L", "eye_blink_left", "blendShapes.EyeBlinkLeft", "EYEBLINKLEFT",
     "Head|eyeBlink.L", "ARKit_eyeBlinkLeft", "bs_eyeBlinkLeft", "eyeBlink_Left", "left_eye_blink", "Eye Blink Left",
     "blendShape.eyeBlinkL"],
)  # fmt: skip
def test_a_shape_in_every_habit_of_naming(name: str, tmp_path: Path) -> None:
    stream = table(tmp_path / "a.csv", {name: 1.0, "jawOpen": 0.0, "eyeSquintLeft": 0.0, "eyeWideLeft": 0.0})
    assert stream.frames[0, 19 - 1] == pytest.approx(SHAPES["eyeBlinkLeft"].frame[19 - 1])
    assert stream.assumed == ()
    document = [{"t": 0.04 * n, "blendshapes": {name: 1.0, "jawOpen": 0.0}} for n in range(3)]
    assert read(tmp_path / "a.json", json.dumps(document)).frames[0, 19 - 1] > 900.0


def test_one_side_of_a_shape_without_sides_moves_that_side(tmp_path: Path) -> None:
    left = table(
        tmp_path / "a.csv", {"browInnerUp_L": 1.0, "browInnerUp_R": 0.0, "browDownLeft": 0, "browDownRight": 0}
    )
    assert left.frames[0, 31 - 1] == pytest.approx(SHAPES["browInnerUp"].frame[31 - 1])
    assert left.frames[0, 32 - 1] == pytest.approx(0.0)
    whole = {"cheekPuff": 1.0, "browInnerUp": 0.5, "browDownLeft": 0, "browDownRight": 0}
    halves = {f"{name}_{side}": value for name, value in whole.items() if "Down" not in name for side in "LR"}
    expected = table(tmp_path / "b.csv", whole)
    found = table(tmp_path / "c.csv", {**halves, "browDownLeft": 0, "browDownRight": 0})
    np.testing.assert_allclose(found.frames, expected.frames, atol=1e-9)


def test_names_that_are_not_known_are_listed(tmp_path: Path) -> None:
    stream = table(
        tmp_path / "a.csv", {"jawOpen": 0.5, "earWiggle": 1.0, "_neutral": 0.9, "mood": 0, "LeftEyeRoll": 0.1}
    )
    assert stream.assumed == ("not read: earWiggle, mood",)
    document = [{"t": 0.04 * n, "blendshapes": {"jawOpen": 0.0, "_neutral": 1.0, "earWiggle": 1.0}} for n in range(3)]
    assert read(tmp_path / "a.json", json.dumps(document)).assumed == ("not read: earWiggle",)


def test_a_second_column_of_the_same_shape_is_listed(tmp_path: Path) -> None:
    stream = table(tmp_path / "a.csv", {"head.jawOpen": 0.5, "teeth.jawOpen": 0.1})
    assert stream.frames[0, 2] == pytest.approx(0.5 * SHAPES["jawOpen"].frame[2])
    assert stream.assumed == ("not read: teeth.jawOpen",)


# ---- scale ---------------------------------------------------------------------------------------------


def test_per_cent_are_told_by_the_whole_file_and_said(tmp_path: Path) -> None:
    stream = table(tmp_path / "a.csv", {"jawOpen": 80, "eyeBlinkLeft": 0.6, "mouthPucker": 12})
    assert stream.frames[0, 2] > 0.7 * SHAPES["jawOpen"].frame[2] - 100.0
    assert stream.frames[0, 2] < 1.1 * SHAPES["jawOpen"].frame[2]
    assert stream.assumed == ("its scores go up to 80: taken as per cent",)
    document = [{"t": 0.04 * n, "blendshapes": {"jawOpen": 25.0 * n}} for n in range(5)]
    stream = read(tmp_path / "a.json", json.dumps(document))
    assert stream.frames[4, 2] == pytest.approx(SHAPES["jawOpen"].frame[2])


@pytest.mark.parametrize("score", [50.0, 2.5, -30.0])
def test_a_score_beyond_its_scale_is_refused_by_row(score: float, tmp_path: Path) -> None:
    rows = [f"{0.04 * n:.2f},{score if n == 7 else 0.1 * (n % 9)},0.3" for n in range(30)]
    with pytest.raises(FormatError, match="line 9, column jawOpen: must be a score from 0 to 1, but it is"):
        read(tmp_path / "a.csv", "\n".join(["timestamp,jawOpen,eyeBlinkLeft", *rows]))


def test_scores_a_little_over_one_are_kept(tmp_path: Path) -> None:
    stream = table(tmp_path / "a.csv", {"jawOpen": 1.2})
    assert stream.frames[0, 2] == pytest.approx(1.2 * SHAPES["jawOpen"].frame[2])


def test_per_cent_beyond_a_hundred_and_a_half_are_refused(tmp_path: Path) -> None:
    with pytest.raises(FormatError, match="column mouthPucker: must be a score from 0 to 100, but it is 800"):
        table(tmp_path / "a.csv", {"jawOpen": 80, "mouthPucker": 800})


def test_intensities_beyond_the_scale_of_openface_are_refused(tmp_path: Path) -> None:
    with pytest.raises(FormatError, match="column AU12_r: must be an intensity of at most 6, but it is 80"):
        table(tmp_path / "a.csv", {"AU12_r": 80})


# ---- faces ---------------------------------------------------------------------------------------------


def test_rows_of_several_faces_are_refused_or_one_is_chosen(tmp_path: Path) -> None:
    rows = [f"{frame},{face},{0.04 * frame:.2f},{face + 1}" for frame in range(5) for face in (0, 3)]
    text = "\n".join(["frame,face_id,timestamp,AU26_r", *rows])
    with pytest.raises(FormatError, match=r"contains 2 faces \(face_id 0, 3\): choose one \(--face\)"):
        read(tmp_path / "a.csv", text)
    one, other = (read(tmp_path / "a.csv", text, face=face) for face in (0, 3))
    assert len(one.frames) == len(other.frames) == 5
    assert other.frames[0, 2] == pytest.approx(4.0 * one.frames[0, 2])
    with pytest.raises(ParameterError, match="face must be one of 0, 3"):
        read(tmp_path / "a.csv", text, face=1)


def test_rows_that_share_a_frame_are_several_faces(tmp_path: Path) -> None:
    rows = [f"{frame},{0.1 * (face + 1)}" for frame in range(5) for face in range(3)]
    text = "\n".join(["frame,jawOpen", *rows])
    with pytest.raises(FormatError, match="contains up to 3 faces in one frame"):
        read(tmp_path / "a.csv", text)
    assert read(tmp_path / "a.csv", text, face=2).frames[0, 2] == pytest.approx(0.3 * SHAPES["jawOpen"].frame[2])


def test_two_lists_of_blend_shapes_are_two_faces(tmp_path: Path) -> None:
    faces = [[{"categoryName": "jawOpen", "score": score}] for score in (0.1, 0.5)]
    text = json.dumps([{"t": 0.04 * n, "faceBlendshapes": faces} for n in range(3)])
    with pytest.raises(FormatError, match=r"frame 0, faces: contains 2 faces: choose one \(--face 0 to 1\)"):
        read(tmp_path / "a.json", text)
    assert read(tmp_path / "a.json", text, face=1).frames[0, 2] == pytest.approx(0.5 * SHAPES["jawOpen"].frame[2])


@pytest.mark.parametrize("named", [True, False])
def test_landmarks_of_a_second_face_do_not_replace_the_first(named: bool, tmp_path: Path) -> None:
    points = np.random.default_rng(1).uniform(0.2, 0.8, (2, 468, 3)).round(4)
    rows = [
        f"{frame}{f',{face}' if named else ''},{n},{x},{y},{z}"
        for frame in range(3)
        for face in range(2)
        for n, (x, y, z) in enumerate(points[face])
    ]
    text = "\n".join([f"frame{',face_id' if named else ''},landmark,x,y,z", *rows])
    with pytest.raises(FormatError, match="2 faces"):
        read(tmp_path / "a.csv", text)
    from risorius.mpeg4.streams.capture import landmarks_from_csv, read_table_file

    for face in range(2):
        found = landmarks_from_csv(read_table_file(tmp_path / "a.csv"), aspect=1.0, face=face)
        np.testing.assert_allclose(found.positions[1], points[face] * [1.0, -1.0, -1.0])


def test_a_single_face_is_face_0(tmp_path: Path) -> None:
    assert len(table(tmp_path / "a.csv", {"face_id": 0, "jawOpen": 0.5}, face=0).frames) == 3
    with pytest.raises(ParameterError, match="face must be 0, the only face"):
        table(tmp_path / "a.csv", {"face_id": 0, "jawOpen": 0.5}, face=1)


# ---- Py-Feat and OpenFace's single images -----------------------------------------------------------------


def test_py_feat(shared: Path) -> None:
    stream = api.read_stream(shared / "samples" / "trackers" / "pyfeat" / "Feat_Test.csv")
    smile = SHAPES["mouthSmileLeft"].frame[59 - 1] + SHAPES["mouthSmileRight"].frame[59 - 1]
    assert stream.frames[0, 59 - 1] > 0.5 * smile  # AU12 is 0.96, the picture is said to be happy at 0.99
    assert "head turns as of Py-Feat up to 0.6: degrees" in stream.assumed
    assert stream.frames[0, 49 - 1] < 0.0  # in the picture the nose lies to the subject's right of the eyes' middle


#: The head turned by some degrees: down, to the subject's left, to the right shoulder, alone; as versions write it.
TURNED = {
    "old": {"Pitch": [-20, 0, 0], "Roll": [0, 0, -20], "Yaw": [0, -20, 0]},
    "axes": {"Pitch": [0.349, 0, 0], "Roll": [0, -0.349, 0], "Yaw": [0, 0, -0.349], "X": 0, "Y": 0, "Z": 9},
    "named": {"Pitch": [-0.349, 0, 0], "Roll": [0, 0, 0.349], "Yaw": [0, -0.349, 0], "X": 0, "Y": 0, "Z": 9},
}
#: The eyes' outer corners in the image, which the tilt alone turns: the right eye's at the left.
EYES = {"x_36": 100, "y_36": [50, 50, 50], "x_45": 200, "y_45": [50, 50, 50 - 100 * np.tan(0.349)]}


@pytest.mark.parametrize("way", TURNED)
def test_turns_of_py_feat_are_read_in_the_way_of_their_version(way: str, tmp_path: Path) -> None:
    stream = table(tmp_path / "a.csv", {"frame": [0, 1, 2], "AU12": 0.5, **TURNED[way], **EYES})
    degrees = np.degrees(stream.frames[:, 47:50] * 1e-5)
    np.testing.assert_allclose(degrees, np.diag([20.0, 20.0, 20.0]), atol=0.1)
    assert any("head turns as of Py-Feat" in line for line in stream.assumed)


@pytest.mark.parametrize(
    ("columns", "said"),
    [
        ({**TURNED["axes"]}, "its landmarks do not tell which"),  # no landmarks
        ({**TURNED["named"], **EYES, "y_45": 50}, "its landmarks do not tell which"),
        ({**TURNED["axes"], **EYES, "X": None, "Y": None, "Z": None}, "contradict its landmarks"),
    ],
)
def test_turns_of_py_feat_that_are_uncertain_are_not_read(columns: dict[str, Any], said: str, tmp_path: Path) -> None:
    there = {name: values for name, values in columns.items() if values is not None}
    stream = table(tmp_path / "a.csv", {"frame": [0, 1, 2], "AU12": 0.5, **there})
    assert np.isnan(stream.frames[:, 47:50]).all()
    assert any(said in line for line in stream.assumed)
    assert any("Pitch, Roll, Yaw" in line for line in stream.assumed if line.startswith("not read"))


def test_blend_shapes_that_py_feat_writes_beside_its_units_and_mesh(tmp_path: Path) -> None:
    """Its newer detectors write all three; the mesh's depth is on a scale of its own."""
    mesh = {f"mesh_{axis}_{n}": 1.0 for axis in "xyz" for n in range(478)}
    shapes = dict.fromkeys(SHAPES, 0.0) | {"mouthSmileLeft": 0.5}
    recording = api.read_recording(_written(tmp_path / "a.csv", {"FaceScore": 0.9, "AU12": 0.2, **mesh, **shapes}))
    assert recording.format == "arkit"
    assert recording.stream.frames[0, 59 - 1] > recording.stream.frames[0, 60 - 1] + 10.0


def _written(path: Path, columns: dict[str, object]) -> Path:
    """A table of three such rows."""
    table(path, columns)
    return path


def test_single_images_of_openface_need_no_frame_and_no_time(tmp_path: Path) -> None:
    text = "face, confidence, pose_Rx, pose_Ry, pose_Rz, AU12_r, AU15_r, AU12_c\n0, 0.98, 0.1, 0, 0, 2.5, 0, 1\n"
    stream = read(tmp_path / "a.csv", text)
    assert stream.frames[0, 48 - 1] == pytest.approx(1e4)
    assert stream.frames[0, 59 - 1] > 0.0


# ---- signs -----------------------------------------------------------------------------------------------


def test_eyes_look_down_with_a_positive_pitch_and_against_the_head(tmp_path: Path) -> None:
    columns = {"jawOpen": 0, "HeadYaw": 0.3, "HeadPitch": 0.2, "LeftEyeYaw": 0.3, "LeftEyePitch": 0.2}
    stream = table(tmp_path / "a.csv", columns)
    values = {number: stream.frames[0, number - 1] for number in (23, 25, 48, 49)}
    assert values == pytest.approx({23: -3e4, 25: 2e4, 48: -2e4, 49: 3e4})


def test_pitch_of_the_eyes_agrees_with_where_they_look_in_a_real_recording(shared: Path) -> None:
    """With the look shapes left out, the rotations say the same."""
    path = shared / "samples" / "trackers" / "livelink" / "range_of_motion.csv"
    whole = api.read_stream(path)
    from risorius.mpeg4.streams.capture import TableFile, read_arkit, read_table_file

    kept = read_table_file(path)
    names = tuple(f"x{name}" if name.startswith("EyeLook") else name for name in kept.columns)
    turned = read_arkit(TableFile(path, names, kept.rows, kept.lines)).evenly()[0]
    for number in (23, 24, 25, 26):
        known = np.isfinite(whole.frames[:, number - 1]) & np.isfinite(turned[:, number - 1])
        assert np.corrcoef(whole.frames[known, number - 1], turned[known, number - 1])[0, 1] > 0.9


def test_turns_can_be_flipped(tmp_path: Path) -> None:
    columns = {"jawOpen": 0, "HeadYaw": 0.3, "HeadPitch": 0.2, "HeadRoll": 0.1, "LeftEyeYaw": 0.3, "LeftEyePitch": 0.2}
    plain = table(tmp_path / "a.csv", columns).frames
    for name, number in {"yaw": 49, "pitch": 48, "roll": 50, "eye_yaw": 23, "eye_pitch": 25}.items():
        turned = table(tmp_path / "a.csv", columns, flip=[name]).frames
        np.testing.assert_allclose(turned[:, number - 1], -plain[:, number - 1])
        others = [other for other in range(68) if other not in (number - 1, number)]
        np.testing.assert_array_equal(turned[:, others], plain[:, others])
    with pytest.raises(ParameterError, match="flip must be some of yaw, pitch, roll, eye_yaw, eye_pitch"):
        table(tmp_path / "a.csv", columns, flip=["upside down"])


@pytest.mark.parametrize("option", [{"rate": 25.0}, {"start": 1.0}, {"face": 1}, {"flip": ["yaw"]}])
def test_options_of_recordings_are_refused_for_streams(option: dict[str, object], tmp_path: Path) -> None:
    api.write_stream(tmp_path / "a.fap", api.FapStream(np.zeros((3, 68))))
    with pytest.raises(ParameterError, match=f"{next(iter(option))} must be left out: the file is a FAP stream"):
        api.read_stream(tmp_path / "a.fap", **option)  # type: ignore[arg-type]


def test_turns_in_degrees_are_told_by_the_whole_file(tmp_path: Path) -> None:
    columns = {"jawOpen": 0, "HeadYaw": 20.0, "HeadPitch": 0.5}
    stream = table(tmp_path / "a.csv", columns)
    assert [stream.frames[0, number - 1] for number in (49, 48)] == pytest.approx([34906.6, -872.66], rel=1e-4)
    assert stream.assumed == ("its turns go up to 20: taken as degrees",)
    with pytest.raises(FormatError, match="column HeadYaw: must be an angle in rad or degrees, but it is 2000"):
        table(tmp_path / "a.csv", {**columns, "HeadYaw": 2000.0})
    stream = table(tmp_path / "b.csv", {"pose_Rx": 10.0, "pose_Ry": 0.0, "pose_Rz": 0.0})
    assert stream.frames[0, 48 - 1] == pytest.approx(17453.3, rel=1e-4)
