"""From picture files to a stream, by the command line: end to end with MediaPipe, and what is said without it."""

from __future__ import annotations

import csv
import importlib.util
import json
import sys
import time
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import risorius.api as api
from risorius.cli import main
from risorius.errors import FormatError, ParameterError, RisoriusError
from risorius.track import find_landmarks, open_pictures

#: The default head: neutral twice, jaw open, smile, brows up, lids shut, head turned down and to its left.
PICTURES = Path(__file__).parent / "pictures"

HAS_MESH = importlib.util.find_spec("mediapipe") and importlib.util.find_spec("mediapipe.python")
needs_mediapipe = pytest.mark.skipif(
    not HAS_MESH, reason="no MediaPipe with a model in its package: pip install risorius[track]"
)


@needs_mediapipe
def test_pictures_become_the_faps_that_they_show(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out, sure = tmp_path / "seen.fap", tmp_path / "sure.csv"
    options = ["--neutral", "0:0.05", "--smooth", "none", "--confidence", sure, "--json"]
    assert main(["track", str(PICTURES), "--out", str(out), *map(str, options)]) == 0
    printed = capsys.readouterr()
    said = json.loads(printed.out)
    assert (said["frames"], said["fps"], said["lost"], said["neutral"]) == (7, 25.0, [], [0.0, 0.04])
    assert "100 %  7 of 7 images" in printed.err
    frames = api.read_fap(out).frames
    seen = {number: frames[:, number - 1] for number in range(1, 69)}
    for number in (3, 6, 7, 12, 13, 19, 20, 33, 34):
        assert abs(seen[number][1]) < 25.0, "the second neutral picture"
    # (picture, FAP) -> what the mesh in the picture shows, and the share of it that the extra's MediaPipe sees
    shown = {(2, 3): (585, 0.69), (2, 5): (-740, 1.03), (3, 6): (155, 0.80), (3, 7): (155, 0.85), (3, 59): (222, 1.16),
             (3, 60): (222, 1.14), (4, 33): (166, 0.54), (4, 34): (166, 0.68), (5, 19): (877, 0.74),
             (5, 20): (877, 0.75), (6, 49): (25000, 1.05)}  # fmt: skip
    for (frame, number), (value, share) in shown.items():
        assert seen[number][frame] / value == pytest.approx(share, abs=0.1), f"FAP {number}"
    assert np.isnan(frames[:, [14 - 1, 29 - 1, 43 - 1, 65 - 1]]).all()
    with sure.open(encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    assert len(rows) == 7
    assert float(rows[3]["F6"]) > 0.8
    assert float(rows[3]["F43"]) == 0.0


@needs_mediapipe
def test_one_picture_says_that_its_neutral_face_is_nobodys(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["track", str(PICTURES / "4.jpg"), "--out", str(tmp_path / "one.json")]) == 0
    assert "generic" in capsys.readouterr().out
    frame = api.read_fap_json(tmp_path / "one.json").frames[0]
    assert (frame[[5, 6, 58, 59]] > 50.0).all()


@needs_mediapipe
def test_pictures_without_a_face_are_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    import cv2

    cv2.imwrite(str(tmp_path / "grey.png"), np.full((64, 64, 3), 128, dtype=np.uint8))
    assert main(["track", str(tmp_path / "grey.png"), "--out", str(tmp_path / "no.fap")]) == 1
    assert "no image shows a face" in capsys.readouterr().err
    assert not (tmp_path / "no.fap").exists()


@needs_mediapipe
def test_files_come_in_the_order_of_their_numbers_and_damaged_ones_are_named(tmp_path: Path) -> None:
    import cv2

    for number in (10, 2, 1):
        cv2.imwrite(str(tmp_path / f"shot{number}.png"), np.full((8, 8, 3), number, dtype=np.uint8))
    pictures = open_pictures([tmp_path], fps=10.0)
    assert (pictures.count, pictures.fps, pictures.live) == (3, 10.0, False)
    seen = [(when, int(picture[0, 0, 0])) for when, picture in pictures.frames]
    assert seen == [(0.0, 1), (0.1, 2), (0.2, 10)]
    (tmp_path / "shot3.png").write_bytes(b"nothing")
    with pytest.raises(FormatError, match=r"shot3\.png.*not a readable image"):
        list(open_pictures([tmp_path / "*.png"]).frames)
    (tmp_path / "film.mp4").write_bytes(b"nothing")
    with pytest.raises(FormatError, match=r"film\.mp4.*not a readable video"):
        open_pictures([tmp_path / "film.mp4"])
    with pytest.raises(FormatError, match="does not exist"):
        open_pictures([tmp_path / "absent.mp4"])
    (tmp_path / "empty").mkdir()
    with pytest.raises(FormatError, match="contains no images"):
        open_pictures([tmp_path / "empty"])


@needs_mediapipe
def test_a_film_is_read_picture_by_picture(tmp_path: Path) -> None:
    import cv2

    path = str(tmp_path / "film.avi")
    writer = cv2.VideoWriter(path, cv2.VideoWriter.fourcc(*"MJPG"), 20.0, (64, 48))
    for red in (0, 100, 200):
        writer.write(np.full((48, 64, 3), (0, 0, red), dtype=np.uint8))
    writer.release()
    pictures = open_pictures([path])
    assert (pictures.name, pictures.fps, pictures.count) == ("film", 20.0, 3)
    shots = list(pictures.frames)
    assert [when for when, _ in shots] == [0.0, 0.05, 0.1]
    for (_, picture), red in zip(shots, (0, 100, 200), strict=True):
        assert picture.shape == (48, 64, 3)
        np.testing.assert_allclose(picture[24, 32], (red, 0, 0), atol=8)
    assert len(list(open_pictures([path], seconds=0.1).frames)) == 2


class FakeCamera:
    """What OpenCV calls a camera: four pictures of one grey each, then nothing."""

    def __init__(self, number: int) -> None:
        self.number, self.shown, self.released = number, 0, False

    def isOpened(self) -> bool:
        return self.number < 2

    def get(self, _property: int) -> float:
        return 0.0  # many cameras do not say

    def read(self) -> tuple[bool, np.ndarray | None]:
        time.sleep(0.002)
        self.shown += 1
        return (True, np.full((8, 8, 3), self.shown, dtype=np.uint8)) if self.shown <= 4 else (False, None)

    def release(self) -> None:
        self.released = True


@pytest.fixture
def camera(monkeypatch: pytest.MonkeyPatch) -> list[FakeCamera]:
    """The cameras that were opened."""
    opened: list[FakeCamera] = []

    def open_camera(number: int) -> FakeCamera:
        opened.append(FakeCamera(number))
        return opened[-1]

    monkeypatch.setitem(sys.modules, "cv2", SimpleNamespace(VideoCapture=open_camera, CAP_PROP_FPS=5))
    return opened


def test_a_camera_gives_pictures_with_the_time_they_came_at(camera: list[FakeCamera]) -> None:
    pictures = open_pictures(["camera:1"])
    assert (pictures.live, pictures.count, pictures.fps) == (True, None, 25.0)
    shots = list(pictures.frames)
    assert [int(picture[0, 0, 0]) for _, picture in shots] == [1, 2, 3, 4]
    assert (np.diff([when for when, _ in shots]) > 0.0).all()
    assert (camera[0].number, camera[0].released) == (1, True)
    with pytest.raises(RisoriusError, match="camera 2 cannot be opened"):
        open_pictures(["camera:2"])


@pytest.mark.usefixtures("camera")
def test_an_interrupt_ends_a_camera_and_keeps_what_was_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    class FakeMesh:
        """A face mesh that sees the same face in every picture, until somebody presses Ctrl-C."""

        def __init__(self, **_options: object) -> None: ...
        def __enter__(self) -> FakeMesh:
            return self

        def __exit__(self, *_error: object) -> None: ...
        def process(self, picture: np.ndarray) -> SimpleNamespace:
            if picture[0, 0, 0] == 3:
                raise KeyboardInterrupt
            face = SimpleNamespace(landmark=[SimpleNamespace(x=0.5, y=0.25, z=0.1)] * 478)
            return SimpleNamespace(multi_face_landmarks=[face] if picture[0, 0, 0] else None)

    module = "mediapipe.python.solutions.face_mesh"
    monkeypatch.setitem(sys.modules, "mediapipe", SimpleNamespace())
    monkeypatch.setitem(sys.modules, module, SimpleNamespace(FaceMesh=FakeMesh))
    seen = find_landmarks(open_pictures(["camera"]))
    assert seen.positions.shape == (2, 478, 3)
    np.testing.assert_allclose(seen.positions[0, 0], (0.5, -0.25, -0.1))


@pytest.fixture
def no_mediapipe(monkeypatch: pytest.MonkeyPatch) -> None:
    """A Python without the extra."""
    for name in ("cv2", "mediapipe", "mediapipe.python.solutions.face_mesh"):
        monkeypatch.setitem(sys.modules, name, None)


@pytest.mark.usefixtures("no_mediapipe")
def test_without_the_extra_the_remedy_is_named(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["track", str(PICTURES), "--out", str(tmp_path / "x.fap")]) == 1
    assert "pip install risorius[track]" in capsys.readouterr().err
    with pytest.raises(RisoriusError, match=r"risorius\[track\]"):
        open_pictures([PICTURES])


@pytest.mark.parametrize("options", [["--out", "x.mp4"], ["--out", "x.fap", "--neutral", "first"], []])
def test_wrong_usage_is_told_before_anything_is_read(options: list[str], tmp_path: Path) -> None:
    assert main(["track", str(tmp_path / "absent.mp4"), *options]) == 2


@pytest.mark.parametrize("options", [{"fps": 0.0}, {"seconds": float("nan")}])
def test_rates_and_times_outside_their_rules_are_refused(options: dict[str, float]) -> None:
    with pytest.raises(ParameterError, match=next(iter(options))):
        open_pictures([PICTURES], **options)
