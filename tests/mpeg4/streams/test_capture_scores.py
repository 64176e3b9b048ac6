"""Scores of trackers as FAPs: OpenFace, ARKit and Live Link Face, MediaPipe's blend shapes; FAPs as CSV."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from risorius import api
from risorius.errors import FormatError, ParameterError
from risorius.mpeg4.streams.capture import load_shapes
from risorius.mpeg4.streams.capture.rotation import euler_matrix, head_faps

SHAPES = load_shapes()


def table(path: Path, columns: dict[str, list[object]]) -> Path:
    """A CSV file."""
    rows = zip(*columns.values(), strict=True)
    path.write_text("\n".join([", ".join(columns), *(", ".join(map(str, row)) for row in rows)]) + "\n")
    return path


def fap(stream: api.FapStream, number: int, frame: int = 0) -> float:
    """One value."""
    return float(stream.frames[frame, number - 1])


# ---- OpenFace ----------------------------------------------------------------------------------------


def openface(path: Path, **changes: list[object]) -> Path:
    """Three frames of OpenFace, changed."""
    columns: dict[str, list[object]] = {
        "frame": [1, 2, 3],
        "face_id": [0, 0, 0],
        "timestamp": [0.0, 0.04, 0.08],
        "confidence": [0.98, 0.98, 0.98],
        "success": [1, 1, 1],
        "pose_Rx": [0.0, 0.0, 0.0],
        "pose_Ry": [0.0, 0.0, 0.0],
        "pose_Rz": [0.0, 0.0, 0.0],
        "AU12_r": [0.0, 2.5, 5.0],
        "AU26_r": [0.0, 0.0, 0.0],
    }
    return table(path, {**columns, **changes})


def test_openface_intensities_are_shares_of_the_full_shape(tmp_path: Path) -> None:
    stream = api.read_capture(openface(tmp_path / "a.csv"))
    assert stream.fps == 25.0
    assert len(stream.frames) == 3
    smile = SHAPES["mouthSmileLeft"].frame[58] + SHAPES["mouthSmileRight"].frame[58]
    np.testing.assert_allclose(stream.frames[:, 58], [0.0, smile / 2.0, smile], atol=1e-9)
    np.testing.assert_array_equal(stream.frames[:, 58], stream.frames[:, 59])


def test_openface_says_nothing_of_what_its_columns_do_not_show(tmp_path: Path) -> None:
    stream = api.read_capture(openface(tmp_path / "a.csv"))
    for number in (19, 31, 35, 45):  # lids and brows have no column here, the tongue never has
        assert not stream.mask[:, number - 1].any()


@pytest.mark.parametrize("change", [{"confidence": [0.98, 0.2, 0.98]}, {"success": [1, 0, 1]}])
def test_openface_frames_of_low_confidence_are_unknown(change: dict[str, list[object]], tmp_path: Path) -> None:
    stream = api.read_capture(openface(tmp_path / "a.csv", **change))
    assert not stream.mask[1].any()
    assert stream.mask[0].any()
    assert stream.mask[2].any()


@pytest.mark.parametrize(
    ("column", "angle", "number", "sign"),
    [("pose_Rx", 0.2, 48, 1), ("pose_Ry", 0.2, 49, -1), ("pose_Rz", 0.2, 50, -1)],
)
def test_openface_pose_in_the_signs_of_the_standard(
    column: str, angle: float, number: int, sign: int, tmp_path: Path
) -> None:
    """Camera axes x right, y down, z away: nose down, nose to the picture's left, head's top to the picture's right."""
    stream = api.read_capture(openface(tmp_path / "a.csv", **{column: [angle] * 3}))
    assert fap(stream, number) == pytest.approx(sign * angle * 1e5)
    assert [fap(stream, n) for n in (48, 49, 50) if n != number] == pytest.approx([0.0, 0.0])


def test_openface_gaze_is_of_the_eyes_in_the_head(tmp_path: Path) -> None:
    """Eyes that look into the camera out of a head turned by 0.2 to the subject's right look left in it."""
    gaze: dict[str, list[object]] = {"gaze_angle_x": [0.0] * 3, "gaze_angle_y": [0.0, 0.1, 0.0]}
    stream = api.read_capture(openface(tmp_path / "a.csv", pose_Ry=[0.2, 0.0, 0.0], **gaze))
    assert [fap(stream, n) for n in (23, 24)] == pytest.approx([2e4, 2e4])
    assert [fap(stream, n, 1) for n in (25, 26)] == pytest.approx([1e4, 1e4])
    left: dict[str, list[object]] = {"gaze_angle_x": [0.3] * 3, "gaze_angle_y": [0.0] * 3}
    assert fap(api.read_capture(openface(tmp_path / "b.csv", **left)), 23) == pytest.approx(3e4)


def test_openface_eyes_apart(tmp_path: Path) -> None:
    """gaze_0 is the eye at the picture's left: the subject's right."""
    looks: dict[str, list[object]] = {f"gaze_{eye}_{axis}": [0.0] * 3 for eye in "01" for axis in "xy"}
    looks |= {"gaze_0_z": [-1.0] * 3, "gaze_1_z": [-1.0] * 3, "gaze_0_x": [0.1] * 3}
    stream = api.read_capture(openface(tmp_path / "a.csv", **looks))
    assert fap(stream, 24) == pytest.approx(np.arctan(0.1) * 1e5)
    assert fap(stream, 23) == pytest.approx(0.0)


@pytest.mark.parametrize(
    ("change", "line", "named"),
    [
        ({"AU12_r": [0.0, "high", 1.0]}, 3, "AU12_r"),
        ({"timestamp": [0.0, 0.08, 0.04]}, 4, "timestamp"),
        ({"face_id": [0, 1, 0]}, None, "face_id"),
    ],
)
def test_damaged_openface_files_name_line_and_column(
    change: dict[str, list[object]], line: int | None, named: str, tmp_path: Path
) -> None:
    with pytest.raises(FormatError, match=named) as refused:
        api.read_capture(openface(tmp_path / "a.csv", **change))
    assert refused.value.line == line


def test_rotations_come_back_from_faps() -> None:
    """The order of the head's motion: Rz Rx Ry of roll, pitch and yaw."""
    pitch, yaw, roll = np.array([0.3]), np.array([-0.4]), np.array([0.2])
    none = np.zeros(1)
    turned = euler_matrix(none, none, roll) @ euler_matrix(pitch, none, none) @ euler_matrix(none, yaw, none)
    np.testing.assert_allclose(head_faps(turned)[0], [3e4, -4e4, 2e4], atol=1e-6)


# ---- times -------------------------------------------------------------------------------------------


def test_uneven_times_are_resampled(tmp_path: Path) -> None:
    """A ramp stays a ramp."""
    times = [0.0, 0.03, 0.1, 0.12, 0.2]
    path = table(tmp_path / "a.csv", {"timestamp": times, "jawOpen": [t * 5 for t in times]})
    stream = api.read_capture(path, fps=50.0)
    assert len(stream.frames) == 11
    np.testing.assert_allclose(stream.frames[:, 2], np.arange(11) / 50.0 * 5 * SHAPES["jawOpen"].frame[2], rtol=1e-9)


def test_gaps_are_unknown_and_not_bridged(tmp_path: Path) -> None:
    times = [0.0, 0.04, 0.08, 0.48, 0.52, 0.56]
    stream = api.read_capture(table(tmp_path / "a.csv", {"timestamp": times, "jawOpen": [0.5] * 6}))
    assert stream.fps == 25.0
    assert len(stream.frames) == 15
    assert list(np.flatnonzero(stream.mask[:, 2])) == [0, 1, 2, 12, 13, 14]


def test_an_endless_recording_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ParameterError, match="times"):
        api.read_capture(table(tmp_path / "a.csv", {"timestamp": [0.0, 0.01, 0.02, 0.03, 1e9], "jawOpen": [0] * 5}))


# ---- ARKit -------------------------------------------------------------------------------------------


def live_link(path: Path, **changes: list[object]) -> Path:
    """Four frames of Live Link Face at 60 a second."""
    columns: dict[str, list[object]] = {
        "Timecode": [f"14:03:52:{58 + i}.250" if i < 2 else f"14:03:53:{i - 2:02d}.250" for i in range(4)],
        "BlendShapeCount": [61] * 4,
        "JawOpen": [0.0, 0.25, 0.5, 1.0],
        "EyeLookInLeft": [0.0, 0.0, 0.0, 1.0],
        "EyeLookOutLeft": [0.0] * 4,
        "HeadYaw": [0.1] * 4,
        "HeadPitch": [0.0, 0.05, 0.0, 0.0],
        "HeadRoll": [0.0, 0.0, 0.02, 0.0],
        "LeftEyeYaw": [0.3] * 4,
        "RightEyeYaw": [0.3] * 4,
    }
    return table(path, {**columns, **changes})


def test_live_link_face(tmp_path: Path) -> None:
    stream = api.read_capture(live_link(tmp_path / "a.csv"))
    assert stream.fps == 60.0
    assert len(stream.frames) == 4
    np.testing.assert_allclose(stream.frames[:, 2], SHAPES["jawOpen"].frame[2] * np.array([0, 0.25, 0.5, 1]), rtol=1e-4)
    assert fap(stream, 49) == pytest.approx(1e4)  # its yaw is positive to the subject's left, the eyes' to the right
    assert fap(stream, 48, 1) == pytest.approx(-5e3)
    assert fap(stream, 50, 2) == pytest.approx(2e3)
    assert fap(stream, 23, 3) == pytest.approx(SHAPES["eyeLookInLeft"].frame[22])  # the look wins over the rotation
    assert fap(stream, 24) == pytest.approx(-3e4)  # which speaks where the look is silent
    assert not stream.mask[:, 30].any()  # no column of the brows


def test_timecodes_count_in_the_rate_that_is_told(tmp_path: Path) -> None:
    codes: list[object] = ["00:00:00:00", "00:00:00:01", "00:00:00:02", "00:00:00:03"]
    assert api.read_capture(live_link(tmp_path / "a.csv", Timecode=codes), rate=30.0).fps == 30.0


def test_several_blend_shapes_add_up(tmp_path: Path) -> None:
    path = table(tmp_path / "a.csv", {"jawOpen": [0.5], "mouthClose": [0.2], "eyeBlinkLeft": [""]})
    expected = 0.5 * SHAPES["jawOpen"].frame[4] + 0.2 * SHAPES["mouthClose"].frame[4]
    stream = api.read_capture(path)
    assert fap(stream, 5) == pytest.approx(expected)
    assert not stream.mask[0, 18]  # an empty cell is no zero


def test_a_timecode_that_is_none_names_its_line(tmp_path: Path) -> None:
    with pytest.raises(FormatError, match="Timecode") as refused:
        api.read_capture(live_link(tmp_path / "a.csv", Timecode=["14:03:52:58", "noon", "14:03:53:00", "14:03:53:01"]))
    assert refused.value.line == 3


# ---- MediaPipe's blend shapes ------------------------------------------------------------------------


def turned(pitch: float, *, by_columns: bool = False) -> list[float]:
    """A transformation matrix with a scale and a shift, flat."""
    matrix = np.eye(4)
    matrix[:3, :3] = 1.1 * euler_matrix(np.array([pitch]), np.zeros(1), np.zeros(1))[0]
    matrix[:3, 3] = [1.0, 2.0, -40.0]
    return list((matrix.T if by_columns else matrix).ravel())


FORMS = {
    "object": lambda score: {"blendshapes": {"jawOpen": score, "_neutral": 0.1}},
    "python": lambda score: {"face_blendshapes": [[{"category_name": "jawOpen", "score": score, "index": 25}]]},
    "javascript": lambda score: {
        "faceBlendshapes": [{"categories": [{"categoryName": "jawOpen", "score": score}], "headIndex": -1}]
    },
}


@pytest.mark.parametrize("form", sorted(FORMS))
@pytest.mark.parametrize("lines", [False, True])
def test_mediapipe_blend_shapes_in_every_form(form: str, lines: bool, tmp_path: Path) -> None:
    frames = [{"timestamp_ms": 40 * i, **FORMS[form](0.5 * i)} for i in range(3)]
    path = tmp_path / ("a.jsonl" if lines else "a.json")
    path.write_text("\n".join(map(json.dumps, frames)) if lines else json.dumps({"frames": frames}))
    stream = api.read_capture(path)
    assert stream.fps == 25.0
    np.testing.assert_allclose(stream.frames[:, 2], SHAPES["jawOpen"].frame[2] * np.array([0.0, 0.5, 1.0]))


def test_mediapipe_frames_without_a_face_are_unknown_and_matrices_turn_the_head(tmp_path: Path) -> None:
    frames = [
        {"blendshapes": {"jawOpen": 0.5}, "facial_transformation_matrixes": [turned(0.1)]},
        {"blendshapes": [], "facial_transformation_matrixes": []},
        {
            "blendshapes": {"jawOpen": 0.5},
            "facialTransformationMatrixes": [{"rows": 4, "data": turned(0.1, by_columns=True)}],
        },
    ]
    (tmp_path / "a.json").write_text(json.dumps(frames))
    stream = api.read_capture(tmp_path / "a.json")
    assert stream.fps == 30.0
    assert not stream.mask[1].any()
    assert [fap(stream, 48), fap(stream, 48, 2)] == pytest.approx([1e4, 1e4])


@pytest.mark.parametrize(
    ("text", "named"),
    [
        ("", "line 1"),
        ('[{"blendshapes": {"jawOpen": 0.5}', "line 1"),
        ('{"blendshapes": {"jawOpen": 0.5}}\n{"blendshapes": {"jaw', "line 2"),
        ("[]", "list of frames"),
        ("[3]", "frame 0"),
        ('[{"blendshapes": {"jawOpen": "wide"}}]', "frame 0, blendshapes.jawOpen"),
        ('[{"blendshapes": [3]}]', "frame 0, blendshapes"),
        ('[{"blendshapes": 3}]', "frame 0, blendshapes"),
        ('[{"blendshapes": [{"score": 1}, {"score": 1}]}]', "frame 0, blendshapes"),
        ('[{"blendshapes": [{"name": "jawOpen"}, 3]}]', "frame 0, blendshapes"),
        ('[{"blendshapes": {"jawOpen": 0}, "matrix": [1, 2]}]', "frame 0, matrix"),
        ('[{"blendshapes": {"jawOpen": 0}, "t": 1}, {"blendshapes": {"jawOpen": 0}, "t": 1}]', "frame 1, time"),
        ('[{"faces": 1}]', "has no blend shapes or landmarks in any frame"),
    ],
)
def test_damaged_json_names_its_place(text: str, named: str, tmp_path: Path) -> None:
    (tmp_path / "a.json").write_text(text)
    with pytest.raises(FormatError, match=named):
        api.read_capture(tmp_path / "a.json")


# ---- any file ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("data", "named"),
    [
        (b"", "empty"),
        (b"jawOpen\n", "no rows"),
        (b"jawOpen,eyeBlinkLeft\n1,2\n3\n", "line 3"),
        (b"a,b\n1,2\n", "columns"),
        (b"\0\1\2", "binary"),
    ],
)
def test_files_that_are_something_else_are_refused(data: bytes, named: str, tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_bytes(data)
    with pytest.raises(FormatError, match=named):
        api.read_capture(tmp_path / "a.csv")


def test_a_missing_file_and_an_unknown_kind_are_refused(tmp_path: Path) -> None:
    with pytest.raises(FormatError, match=r"gone\.csv"):
        api.read_capture(tmp_path / "gone.csv")
    with pytest.raises(ParameterError, match="openface"):
        api.read_capture(openface(tmp_path / "a.csv"), kind="dance")


SEEDS = (
    b"frame,timestamp,confidence,success,pose_Rx,pose_Ry,pose_Rz,AU12_r\n1,0,1,1,0,0,0,2\n2,0.04,1,1,0,0,0,3\n",
    b"Timecode,BlendShapeCount,JawOpen\n00:00:00:00.0,61,0.5\n00:00:00:01.0,61,0.6\n",
    b'[{"blendshapes":{"jawOpen":0.5},"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]},{"blendshapes":[],"t":3}]',
    b"frame,landmark,x,y,z\n0,0,0.5,0.5,0\n",
)


@settings(max_examples=300, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    seed=st.sampled_from(SEEDS),
    places=st.lists(st.integers(0, 120), max_size=4),
    bytes_=st.binary(min_size=1, max_size=4),
    cut=st.integers(0, 130),
)
def test_damaged_files_are_read_or_refused(
    seed: bytes, places: list[int], bytes_: bytes, cut: int, tmp_path: Path
) -> None:
    """Never another exception than our own, whatever is in the file."""
    data = bytearray(seed)
    for place in places:
        data[place % len(data) : place % len(data) + len(bytes_)] = bytes_
    path = tmp_path / ("a.json" if seed.startswith(b"[") else "a.csv")
    path.write_bytes(bytes(data[:cut] if cut < len(data) else data))
    try:
        stream = api.read_capture(path)
    except (FormatError, ParameterError):
        return
    assert not np.isinf(stream.frames).any()


# ---- FAPs as CSV -------------------------------------------------------------------------------------


def test_faps_go_to_csv_and_back(tmp_path: Path) -> None:
    rng = np.random.default_rng(3)
    frames = rng.normal(0.0, 300.0, (7, 68))
    frames[rng.random(frames.shape) < 0.3] = np.nan
    frames[3] = np.nan
    stream = api.FapStream(frames=frames, fps=29.97)
    api.write_fap_csv(tmp_path / "a.csv", stream)
    heading, first = (tmp_path / "a.csv").read_text().splitlines()[:2]
    assert heading.startswith("frame,timestamp,confidence,success,F03_open_jaw,")
    assert first.startswith("1,0.000000,1,1,")
    back = api.read_capture(tmp_path / "a.csv", fps=29.97)
    np.testing.assert_array_equal(back.mask, stream.mask)
    np.testing.assert_allclose(back.frames, stream.frames, rtol=1e-4, atol=1e-2)
    with pytest.raises(FormatError, match="folder"):
        api.write_fap_csv(tmp_path / "no" / "a.csv", stream)
