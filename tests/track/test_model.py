"""Tracking with the user's own model: MediaPipe's face landmarker, faked, and the real one where it is at hand."""

from __future__ import annotations

import importlib.util
import json
import os
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import risorius.api as api
from risorius.cli import main
from risorius.errors import FormatError, RisoriusError
from risorius.track import find_faces, find_landmarks, open_pictures
from risorius.track.pictures import Pictures

PICTURES = Path(__file__).parent / "pictures"

#: A face_landmarker.task of the tester's: no package that tests need has one.
MODEL = Path(os.environ.get("RISORIUS_FACE_LANDMARKER", "face_landmarker.task"))


class FakeLandmarker:
    """MediaPipe's face landmarker as it is called: sees a face in every picture that is not black."""

    made: list[FakeLandmarker]

    def __init__(self, options: Any) -> None:
        if options.base_options.model_asset_buffer != b"a model":
            raise RuntimeError("Unable to open zip archive.")
        self.options, self.times = options, []

    @classmethod
    def create_from_options(cls, options: Any) -> FakeLandmarker:
        cls.made.append(cls(options))
        return cls.made[-1]

    def __enter__(self) -> FakeLandmarker:
        return self

    def __exit__(self, *_error: object) -> None: ...

    def detect(self, image: Any) -> SimpleNamespace:
        assert self.options.running_mode == "IMAGE"
        if not image.data.any():
            return SimpleNamespace(face_landmarks=[], face_blendshapes=[])
        marks = [SimpleNamespace(x=0.5, y=0.25, z=0.1)] * 478
        scores = [
            SimpleNamespace(category_name=name, score=value) for name, value in (("jawOpen", 0.5), ("_neutral", 0))
        ]
        return SimpleNamespace(face_landmarks=[marks], face_blendshapes=[scores])

    def detect_for_video(self, image: Any, when: int) -> SimpleNamespace:
        assert self.options.running_mode == "VIDEO"
        assert not self.times or when > self.times[-1]
        self.times.append(when)
        self.options.running_mode = "IMAGE"
        found = self.detect(image)
        self.options.running_mode = "VIDEO"
        return found


@pytest.fixture
def landmarker(monkeypatch: pytest.MonkeyPatch) -> type[FakeLandmarker]:
    """MediaPipe 1.x: the tasks, and no face mesh."""
    vision = SimpleNamespace(
        FaceLandmarker=FakeLandmarker,
        FaceLandmarkerOptions=SimpleNamespace,
        RunningMode=SimpleNamespace(IMAGE="IMAGE", VIDEO="VIDEO"),
    )
    package = SimpleNamespace(Image=SimpleNamespace, ImageFormat=SimpleNamespace(SRGB=1))
    monkeypatch.setitem(sys.modules, "mediapipe", package)
    monkeypatch.setitem(sys.modules, "mediapipe.tasks.python", SimpleNamespace(BaseOptions=SimpleNamespace))
    monkeypatch.setitem(sys.modules, "mediapipe.tasks.python.vision", vision)
    monkeypatch.setitem(sys.modules, "mediapipe.python.solutions.face_mesh", None)
    FakeLandmarker.made = []
    return FakeLandmarker


@pytest.fixture
def model(tmp_path: Path) -> Path:
    """A file that the fake takes for a model."""
    path = tmp_path / "face_landmarker.task"
    path.write_bytes(b"a model")
    return path


def shots(*greys: int, step: float = 0.04) -> Pictures:
    """Pictures of one grey each."""
    frames = ((index * step, np.full((8, 16, 3), grey, dtype=np.uint8)) for index, grey in enumerate(greys))
    return Pictures("shots", 25.0, len(greys), False, frames)


def test_a_model_gives_landmarks_and_blend_shapes(landmarker: type[FakeLandmarker], model: Path) -> None:
    landmarks, shapes = find_faces(shots(9, 0, 9), model=model)
    np.testing.assert_allclose(landmarks.positions[0, 0], (1.0, -0.25, -0.2))  # in heights of a picture twice as wide
    assert np.isnan(landmarks.positions[1]).all()
    assert shapes == [{"jawOpen": 0.5, "_neutral": 0.0}, {}, {"jawOpen": 0.5, "_neutral": 0.0}]
    options = landmarker.made[0].options
    assert (options.num_faces, options.output_face_blendshapes) == (1, True)
    assert landmarker.made[0].times == [0, 40, 80]


def test_times_that_round_to_the_same_stay_in_order(landmarker: type[FakeLandmarker], model: Path) -> None:
    find_landmarks(shots(9, 9, 9, 9, step=0.0004), model=model)
    assert landmarker.made[0].times == [0, 1, 2, 3]


def test_one_picture_is_an_image(landmarker: type[FakeLandmarker], model: Path) -> None:
    assert find_landmarks(shots(9), model=model).positions.shape == (1, 478, 3)
    assert landmarker.made[0].times == []


@pytest.mark.usefixtures("landmarker")
def test_a_file_that_is_no_model_is_named(tmp_path: Path) -> None:
    path = tmp_path / "other.task"
    with pytest.raises(FormatError, match=r"other\.task.*does not exist"):
        find_landmarks(shots(9), model=path)
    path.write_bytes(b"nothing")
    with pytest.raises(FormatError, match=r"other\.task.*download it again"):
        find_landmarks(shots(9), model=path)


@pytest.mark.usefixtures("landmarker")
def test_without_a_model_it_is_said_what_is_missing_and_where_it_comes_from() -> None:
    with pytest.raises(
        RisoriusError, match=r"no face model in its package: .*--model face_landmarker\.task.*0\.10\.21"
    ):
        find_landmarks(shots(9))


def test_blend_shapes_are_written_as_a_recording(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    import risorius.track as track
    from risorius.mpeg4.streams.capture import Landmarks

    face = track.generic_landmarks() / 300.0
    landmarks = Landmarks(np.array([0.0, 0.04]), np.array([face, face]))
    scores = [{"jawOpen": 0.5, "mouthSmileLeft": 0.2}, {}]
    monkeypatch.setattr(track, "open_pictures", lambda *_, **__: Pictures("two", 25.0, 2, False, iter(())))
    monkeypatch.setattr(track, "find_faces", lambda *_, **__: (landmarks, scores))
    out, table = tmp_path / "s.fap", tmp_path / "shapes.csv"
    command = ["track", "two.mp4", "--out", str(out), "--shapes", str(table)]
    assert main(command) == 2
    assert "--shapes needs --model" in capsys.readouterr().err
    assert main([*command, "--model", "face_landmarker.task"]) == 0
    stream = api.read_stream(table)
    assert stream.frames[0, 3 - 1] > 100.0
    assert np.isnan(stream.frames[1, 3 - 1])


@pytest.mark.slow
@pytest.mark.skipif(
    not MODEL.is_file() or importlib.util.find_spec("mediapipe") is None,
    reason="no face_landmarker.task: set RISORIUS_FACE_LANDMARKER to one, with MediaPipe installed",
)
def test_the_real_model_sees_what_pictures_show(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out, table = tmp_path / "seen.fap", tmp_path / "shapes.csv"
    options = ["--neutral", "0:0.05", "--smooth", "none", "--model", MODEL, "--shapes", table, "--json"]
    assert main(["track", str(PICTURES), "--out", str(out), *map(str, options)]) == 0
    assert json.loads(capsys.readouterr().out)["frames"] == 7
    frames = api.read_fap(out).frames
    for frame, number, value in ((2, 3, 585), (2, 5, -740), (3, 6, 155), (3, 59, 222), (5, 19, 877), (6, 49, 25000)):
        assert 0.4 < frames[frame, number - 1] / value < 1.6, f"FAP {number}"
    landmarks, shapes = find_faces(open_pictures([PICTURES]), model=MODEL)
    assert landmarks.positions.shape == (7, 478, 3)
    assert max(range(7), key=lambda index: shapes[index]["jawOpen"]) == 2
    assert shapes[3]["mouthSmileLeft"] > shapes[0]["mouthSmileLeft"] + 0.2
