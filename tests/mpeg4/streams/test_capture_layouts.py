"""Layouts of JSON, wrapped results and Audio2Face among them; Face Cap, iFacialMocap and VMC as lines of text."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from risorius import api
from risorius.errors import FormatError

OPEN = api.load_shapes()["jawOpen"].frame[2]
COUNT = 5


def read(path: Path, text: str, **options: object) -> api.Recording:
    """A file with that text."""
    path.write_text(text)
    return api.read_recording(path, **options)  # type: ignore[arg-type]


def categories(score: float) -> list[dict[str, Any]]:
    """What MediaPipe gives for one face."""
    return [
        {"index": 0, "score": 0.9, "categoryName": "_neutral"},
        {"index": 25, "score": score, "categoryName": "jawOpen"},
    ]


def result(number: int) -> dict[str, Any]:
    """The result of one frame, whose jaw opens by a tenth from frame to frame."""
    return {"faceLandmarks": [], "faceBlendshapes": [{"categories": categories(number / 10), "headIndex": -1}]}


NUMBERS = range(COUNT)
LAYOUTS: dict[str, Any] = {
    "results": [{"timestamp_ms": 40 * n, "results": result(n)} for n in NUMBERS],
    "face": [{"timestamp_ms": 40 * n, "face": result(n)} for n in NUMBERS],
    "faceLandmarkerResult": [{"timestamp_ms": 40 * n, "faceLandmarkerResult": result(n)} for n in NUMBERS],
    "two deep": [{"timestamp_ms": 40 * n, "data": {"result": result(n)}} for n in NUMBERS],
    "a list of one face": [{"timestamp_ms": 40 * n, "faces": [{"blendshapes": {"jawOpen": n / 10}}]} for n in NUMBERS],
    "keys": {"fps": 25, **{str(n): result(n) for n in NUMBERS}},
    "keys alone": {"meta": {"fps": 25}, "frames": {str(n): result(n) for n in NUMBERS}},
    "bare lists": {"fps": 25, "frames": [categories(n / 10) for n in NUMBERS]},
    "bare lists of faces": {"fps": 25, "frames": [[categories(n / 10)] for n in NUMBERS]},
    "wrapped list": {"fps": 25, "data": {"frames": [result(n) for n in NUMBERS]}},
    "names at the top of a frame": [{"timestamp_ms": 40 * n, "jawOpen": n / 10, "eyeBlink_L": 0.0} for n in NUMBERS],
    "weights": [{"time": 0.04 * n, "weights": {"jawOpen": n / 10}} for n in NUMBERS],
    "a list for each name": {"timestamps": [0.04 * n for n in NUMBERS], "jawOpen": [n / 10 for n in NUMBERS]},
    "lists inside": {"fps": 25, "blendshapes": {"jawOpen": [n / 10 for n in NUMBERS], "eyeBlinkLeft": [0.0] * COUNT}},
    "Audio2Face": {
        "exportFps": 25.0, "trackPath": "a.wav", "numPoses": 2, "numFrames": COUNT,
        "facsNames": ["browInnerUp", "jawOpen"], "weightMat": [[0.0, n / 10] for n in NUMBERS],
    },
    "times as keys": {str(40 * n): {"blendshapes": {"jawOpen": n / 10}} for n in NUMBERS},
    "seconds as keys": {f"{0.04 * n:.2f}": {"blendshapes": {"jawOpen": n / 10}} for n in NUMBERS},
    "columns and data": {"columns": ["timestamp", "jawOpen"], "data": [[0.04 * n, n / 10] for n in NUMBERS]},
    "a dictionary for each name": {
        "timestamp": {str(n): 0.04 * n for n in NUMBERS}, "jawOpen": {str(n): n / 10 for n in NUMBERS},
    },
    "names and frames": {"fps": 25, "names": ["jawOpen", "eyeBlinkLeft"], "frames": [[n / 10, 0.0] for n in NUMBERS]},
}  # fmt: skip


@pytest.mark.parametrize("layout", sorted(LAYOUTS))
def test_json_in_every_layout(layout: str, tmp_path: Path) -> None:
    document = LAYOUTS[layout]
    if layout == "keys":
        document = {name: entry for name, entry in document.items() if name != "fps"}
    recording = read(tmp_path / "a.json", json.dumps(document), rate=25.0 if layout == "keys" else None)
    np.testing.assert_allclose(recording.stream.frames[:, 2], [OPEN * n / 10 for n in NUMBERS])
    said = ("its times are in milliseconds",) if layout == "times as keys" else ()
    assert (recording.stream.fps, recording.assumed) == (25.0, said)


def test_a_single_result_is_one_frame(tmp_path: Path) -> None:
    for document in (result(5), categories(0.5), {"results": result(5)}):
        stream = read(tmp_path / "a.json", json.dumps(document)).stream
        np.testing.assert_allclose(stream.frames[:, 2], [OPEN / 2])


def test_frames_without_a_face_stay_in_place(tmp_path: Path) -> None:
    frames = [result(1), None, {"results": None}, {"faceBlendshapes": []}, result(2)]
    stream = read(tmp_path / "a.json", json.dumps(frames)).stream
    assert [bool(known) for known in stream.mask.any(axis=1)] == [True, False, False, False, True]


def test_keys_that_skip_numbers_are_gaps(tmp_path: Path) -> None:
    stream = read(tmp_path / "a.json", json.dumps({"0": result(1), "1": result(1), "4": result(1)})).stream
    assert [bool(known) for known in stream.mask.any(axis=1)] == [True, True, False, False, True]


def test_turns_of_the_head_in_json(tmp_path: Path) -> None:
    frames = [{"timestamp": 0.04 * n, "jawOpen": 0.0, "HeadYaw": 0.3} for n in NUMBERS]
    recording = read(tmp_path / "a.json", json.dumps(frames))
    assert recording.stream.frames[0, 49 - 1] == pytest.approx(3e4)
    assert recording.assumed == ()


def test_the_table_of_audio2face(tmp_path: Path) -> None:
    rows = [f"{n},{n / 30:.6f},{n / 10},0.0" for n in NUMBERS]
    recording = read(tmp_path / "a.csv", "\n".join([",timeCode,blendShapes.JawOpen,blendShapes.EyeBlinkLeft", *rows]))
    np.testing.assert_allclose(recording.stream.frames[:, 2], [OPEN * n / 10 for n in NUMBERS])
    assert (recording.stream.fps, recording.assumed) == (30.0, ())


# ---- lines of text ---------------------------------------------------------------------------------------


def test_face_cap(tmp_path: Path) -> None:
    lines = ["info,Face Cap,1.0", "bs,browInnerUp,jawOpen,eyeBlink_L"]
    lines += [f"k,{1000 + 1000 * n / 60:.0f},0,0,0,1,2,3,0,0,0,0,0,{n / 10},0" for n in NUMBERS]
    recording = read(tmp_path / "a.txt", "\n".join(lines))
    np.testing.assert_allclose(recording.stream.frames[:, 2], [OPEN * n / 10 for n in NUMBERS])
    assert recording.stream.fps == 60.0
    assert "not read: headPositionX, headPositionY, headPositionZ" in recording.assumed
    turns = recording.stream.frames[0, [47, 48, 49]]
    np.testing.assert_allclose(turns, np.radians([1.0, 2.0, 3.0]) * 1e5, rtol=1e-6)
    with pytest.raises(FormatError, match="line 3: has 4 values, but 14 are due"):
        read(tmp_path / "a.txt", "\n".join([*lines[:2], "k,1,2,3,4"]))


@pytest.mark.parametrize("mark", ["-", "&"])
@pytest.mark.parametrize("timed", [True, False])
def test_ifacialmocap(mark: str, timed: bool, tmp_path: Path) -> None:
    names = ("jawOpen", "eyeBlink_L", "eyeBlink_R", "browInnerUp", "mouthSmile_L")
    frames = [
        "|".join(f"{name}{mark}{10 * n if name == 'jawOpen' else 7}" for name in names)
        + "|=head#1.5,-2.5,3.0,0.1,0.2,0.3|rightEye#1,2,3|leftEye#1,2,3|"
        for n in NUMBERS
    ]
    text = "\n".join(f"{0.02 * n:.2f} {frame}" if timed else frame for n, frame in enumerate(frames))
    recording = read(tmp_path / "a.txt", text)
    np.testing.assert_allclose(recording.stream.frames[:, 2], [OPEN * n / 10 for n in NUMBERS], atol=30.0)
    assert recording.stream.fps == (50.0 if timed else 30.0)
    assert "its scores go up to 40: taken as per cent" in recording.assumed
    assert "not read: headPositionX, headPositionY, headPositionZ" in recording.assumed
    turns = recording.stream.frames[0, [47, 48, 49, 24, 22]]  # of the head, and of the left eye down and to the left
    np.testing.assert_allclose(turns, np.radians([1.5, -2.5, 3.0, 1.0, 2.0]) * 1e5, rtol=1e-6)


#: Parts of two frames that the app sent: of the developer's page, and of a test of someone's parser.
SENT = (
    "eyeLookDown_L-17|eyeLookDown_R-17|eyeLookIn_L-4|eyeLookIn_R-6|eyeLookOut_L-0|eyeLookOut_R-0|eyeLookUp_L-0|eyeLookUp_R-0"
    "|=head#-21.488958,-6.038993,-6.6019735,-0.030653415,-0.10287084,-0.6584072"
    "|rightEye#6.0297494,2.4403017,0.25649446|leftEye#6.034903,-1.6660284,-0.17520553|",
    "eyeLookDown_L-16|eyeLookDown_R-15|eyeLookIn_L-0|eyeLookIn_R-12|eyeLookOut_L-0|eyeLookOut_R-0|eyeLookUp_L-0|eyeLookUp_R-0"
    "|=head#25.409164,-5.085786,3.8090365,0.052303925,0.2366666,-0.0259732"
    "|rightEye#5.2707267,4.227702,0.41178665|leftEye#5.300755,0.32921365,0.03218361|",
)


@pytest.mark.parametrize("frame", SENT)
def test_turns_of_the_eyes_agree_with_where_they_look_in_frames_that_were_sent(frame: str, tmp_path: Path) -> None:
    """Left out, the look shapes are read from the turns: the same side, and downwards."""
    looked = read(tmp_path / "a.txt", f"{frame}\n{frame}").stream.frames[0, 22:26]
    blind = frame.replace("eyeLook", "unseenLook")
    turned = read(tmp_path / "b.txt", f"jawOpen-1|{blind}\njawOpen-1|{blind}").stream.frames[0, 22:26]
    sure = np.abs(looked) > 1000.0
    assert sure.sum() >= 3
    assert (np.sign(turned[sure]) == np.sign(looked[sure])).all()


def test_frames_of_ifacialmocap_in_one_line(tmp_path: Path) -> None:
    frame = "jawOpen-{}|eyeBlink_L-0|eyeBlink_R-9|browInnerUp-7|mouthSmile_L-1|=head#0,0,0,0,0,0|___iFacialMocap"
    recording = read(tmp_path / "a.txt", "".join(frame.format(10 * n) for n in NUMBERS))
    assert len(recording.stream.frames) == COUNT


@pytest.mark.parametrize("before", ["", "12.34 "])
def test_messages_of_vmc(before: str, tmp_path: Path) -> None:
    lines = []
    for n in NUMBERS:
        lines += [f"{before}/VMC/Ext/T ,f {0.04 * n:.2f}", f'{before}/VMC/Ext/Blend/Val ,sf "jawOpen" {n / 10}']
        lines += [
            f'{before}/VMC/Ext/Blend/Val ,sf "Joy" 0.0',
            f"{before}/VMC/Ext/Blend/Apply",
            f"{before}/VMC/Ext/OK ,i 1",
        ]
    recording = read(tmp_path / "a.log", "\n".join(lines))
    np.testing.assert_allclose(recording.stream.frames[:, 2], [OPEN * n / 10 for n in NUMBERS])
    assert (recording.stream.fps, recording.assumed) == (25.0, ("not read: Joy",))


# ---- what is none of them --------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "data", "told"),
    [
        ("a.csv", b"start,end,phoneme\n0,1,AA\n", "it seems to hold timings of speech"),
        ("a.csv", b"timestamp,CTRL_expressions_jawOpen\n0,1\n", "it seems to hold controls of a MetaHuman rig"),
        ("a.csv", b"colour,weight_kg\nred,1\n", "it has colour, weight_kg"),
        ("a.json", b'{"mouthCues": []}', "it seems to hold timings of speech"),
        ("a.json", b'[{"pose_landmarks": [[1, 2, 3]]}]', "it seems to hold the motion of a body"),
        ("a.csv", b"\x00\x00\x00\x18ftypmp42", r"it seems to be a video \(track it: risorius track\)"),
        ("a.csv", b"PK\x03\x04\x00\x00", "it seems to be a zip archive or a spreadsheet"),
    ],
)
def test_what_is_none_of_them_is_refused_with_what_it_seems_to_be(
    name: str, data: bytes, told: str, tmp_path: Path
) -> None:
    (tmp_path / name).write_bytes(data)
    with pytest.raises(FormatError, match=told):
        api.read_stream(tmp_path / name)
