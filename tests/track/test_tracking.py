"""Landmarks to a stream: values, masks, confidence, the generic face, lost frames. The generic face, moved by hand."""

from __future__ import annotations

import csv
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest
import risorius.api as api
import risorius.track
from risorius.cli import main
from risorius.errors import ModelError, ParameterError
from risorius.mpeg4.streams.capture import Landmarks
from risorius.track import GENERIC, camera_faps, generic_landmarks, track_landmarks
from scipy.spatial.transform import Rotation

FPS = 25.0

UNSEEN = [row.number for row in camera_faps().values() if row.trust == 0.0]

#: Landmarks of the mouth's corners and of the lower lip and chin: feature points 2.4 8.3, 2.5 8.4, 2.3, 8.2 2.1.
LEFT_CORNER, RIGHT_CORNER, JAW = (308, 291), (78, 61), (14, 17, 152)


def moved(shifts: Mapping[tuple[int, ...], tuple[float, float, float]], strength: np.ndarray) -> np.ndarray:
    """(T, 478, 3) the generic face in mm with some landmarks shifted by so much times the strength (T,)."""
    faces = np.repeat(generic_landmarks()[None], len(strength), axis=0)
    for numbers, shift in shifts.items():
        faces[:, list(numbers)] += strength[:, None, None] * np.array(shift)
    return faces


def recording(faces: np.ndarray) -> Landmarks:
    """Faces in picture heights at 25 a second."""
    return Landmarks(np.arange(len(faces)) / FPS, faces / 300.0)


@pytest.fixture(scope="session")
def strength() -> np.ndarray:
    """(60,) neutral, up slowly, held, down, neutral."""
    return np.interp(np.arange(60), [0, 20, 30, 40, 50], [0.0, 0.0, 1.0, 1.0, 0.0])


@pytest.fixture(scope="session")
def smile(strength: np.ndarray) -> np.ndarray:
    """(60, 478, 3) a smile with the jaw dropping, mm."""
    shifts = {LEFT_CORNER: (5.0, 6.0, 0.0), RIGHT_CORNER: (-5.0, 6.0, 0.0), JAW: (0.0, -8.0, 0.0)}
    return moved(shifts, strength)


def turned(faces: np.ndarray, degrees: float) -> np.ndarray:
    """The faces, looking so far to the subject's left."""
    return faces @ Rotation.from_euler("y", degrees, degrees=True).as_matrix().T


def test_a_smile_is_read_in_the_persons_own_units(smile: np.ndarray, strength: np.ndarray) -> None:
    found = track_landmarks(recording(smile), neutral=(0.0, 0.6), smoothing="none", name="smile")
    units = found.reading.units
    width, height = units.mw0, units.mns0
    lengths = {6: (5.0, width), 7: (5.0, width), 12: (6.0, height), 59: (6.0, height), 3: (8.0, height)}
    for number, (mm, unit) in lengths.items():
        wanted = strength * mm / (found.reading.pose.scales[0] * 300.0) / (unit / 1024.0)
        np.testing.assert_allclose(found.stream.frames[:, number - 1], wanted, atol=1.0)
    assert (found.stream.name, found.stream.fps, found.generic) == ("smile", FPS, False)


def test_what_a_camera_cannot_see_is_never_stated(smile: np.ndarray) -> None:
    assert {14, 27, 28, 29, 30, 43, 44, 45, 46, 47, 65, 66, 67, 68} <= set(UNSEEN)
    found = track_landmarks(recording(smile))
    assert not found.stream.mask[:, [number - 1 for number in UNSEEN]].any()
    assert (found.confidence[:, [number - 1 for number in UNSEEN]] == 0.0).all()
    everything = track_landmarks(recording(smile), least=0.0)
    assert not everything.stream.mask[:, [number - 1 for number in UNSEEN]].any()


def test_values_less_sure_are_masked(smile: np.ndarray) -> None:
    loose, strict = (track_landmarks(recording(smile), least=least).stream.mask for least in (0.3, 0.8))
    assert strict.sum() < loose.sum()
    assert (loose | ~strict).all()
    sure = track_landmarks(recording(smile), least=0.8)
    assert (sure.confidence[sure.stream.mask] >= 0.8).all()


def test_lost_frames_are_masked_and_told(smile: np.ndarray) -> None:
    broken = smile.copy()
    broken[33:37] = np.nan
    found = track_landmarks(recording(broken), neutral=(0.0, 0.6))
    assert found.lost.tolist() == [33, 34, 35, 36]
    assert not found.stream.mask[33:37].any()
    assert (found.confidence[33:37] == 0.0).all()
    assert found.stream.mask[[32, 37]].any()


def test_without_being_told_the_resting_face_is_neutral(smile: np.ndarray) -> None:
    found = track_landmarks(recording(smile), smoothing="none")
    assert not ((found.neutral > 0.82) & (found.neutral < 1.98)).any()
    np.testing.assert_allclose(found.stream.frames[0, [2, 5, 11]], 0.0, atol=3.0)


def test_a_smile_that_is_taken_for_neutral_is_doubted(smile: np.ndarray) -> None:
    at_rest, smiling = (track_landmarks(recording(smile), neutral=when) for when in ((0.0, 0.6), (1.25, 1.55)))
    assert at_rest.doubts == ()
    assert set(smiling.doubts) == {"8.3", "8.4", "2.3"}
    assert track_landmarks(recording(smile[35:36])).doubts == ()  # the generic face is not doubted against itself


def test_one_picture_is_read_against_the_generic_face(smile: np.ndarray) -> None:
    own = track_landmarks(recording(smile), neutral=(0.0, 0.6), smoothing="none")
    found = track_landmarks(recording(smile[35:36]))
    assert (found.generic, len(found.stream.frames), len(found.neutral)) == (True, 1, 0)
    kept = found.stream.mask[0]
    np.testing.assert_allclose(found.stream.frames[0, kept], own.stream.frames[35, kept], atol=3.0)
    np.testing.assert_allclose(found.confidence[0, kept], 0.5 * own.confidence[35, kept], atol=1e-6)


def test_the_generic_face_keeps_every_frame_and_the_pose_from_the_camera(smile: np.ndarray) -> None:
    found = track_landmarks(recording(turned(smile, 20.0)), neutral=GENERIC, smoothing="none")
    assert found.stream.frames.shape == (60, 68)
    np.testing.assert_allclose(found.stream.frames[:, 48], np.radians(20.0) / 1e-5, rtol=1e-3)


def test_the_further_side_is_less_sure_the_further_the_head_turns(smile: np.ndarray) -> None:
    """A head turned to its left hides the left corner of its mouth, 8.3 (FAP 59), and shows the right one (FAP 60)."""
    sure = {
        degrees: track_landmarks(recording(turned(smile, degrees)), neutral=(0.0, 0.6)).confidence.mean(axis=0)
        for degrees in (0.0, 20.0, 50.0, 70.0)
    }
    left = [values[58] for values in sure.values()]
    assert left[0] >= left[1] > left[2] > left[3]
    assert sure[70.0][59] > sure[70.0][58] + 0.2
    assert sure[0.0][58] == pytest.approx(camera_faps()[59].trust)


def test_uneven_times_of_a_camera_become_an_even_rate(smile: np.ndarray, strength: np.ndarray) -> None:
    times = np.arange(60) / FPS + np.random.default_rng(5).uniform(-0.008, 0.008, 60)
    times[0] = 0.0
    shown = np.interp(times, np.arange(60) / FPS, strength)
    faces = smile[0] + shown[:, None, None] * (smile[35] - smile[0])
    found = track_landmarks(Landmarks(times, faces / 300.0), fps=FPS, neutral=(0.0, 0.6), smoothing="none")
    column = found.stream.frames[:, 5]
    np.testing.assert_allclose(column / np.nanmax(column), strength[: len(column)], atol=0.08)


def test_the_generic_face_is_the_one_that_points_are_read_from() -> None:
    face = generic_landmarks()
    assert np.isfinite(face).all(axis=1).sum() >= 60
    with pytest.raises(ValueError, match="read-only"):
        face[0] = 0.0


def test_the_command_writes_the_stream_and_how_sure_each_value_is(
    smile: np.ndarray, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pictures = risorius.track.Pictures("smile", FPS, len(smile), False, iter(()))
    monkeypatch.setattr(risorius.track, "open_pictures", lambda *_sources, **_options: pictures)
    monkeypatch.setattr(risorius.track, "find_landmarks", lambda *_pictures, **_options: recording(smile))
    stream, sure = tmp_path / "smile.fap", tmp_path / "sure.csv"
    assert main(["track", "smile.mp4", "--neutral", "0:0.6", "--out", str(stream), "--confidence", str(sure)]) == 0
    expected = track_landmarks(recording(smile), neutral=(0.0, 0.6), name="smile")
    np.testing.assert_array_equal(api.read_fap(stream).mask, expected.stream.mask)
    heading, *rows = csv.reader(sure.read_text(encoding="utf-8").splitlines())
    assert heading == ["frame", *(f"F{number}" for number in api.FAPS)]
    np.testing.assert_allclose(np.array(rows, dtype=float)[:, 1:], expected.confidence, atol=5.1e-4)


@pytest.mark.parametrize(
    ("options", "told"),
    [({"least": 2.0}, "least"), ({"neutral": "mine"}, "generic"), ({"smoothing": "kalman"}, "smoothing"),
     ({"neutral": (9.0, 10.0)}, "neutral"), ({"fps": -1.0}, "fps")],
)  # fmt: skip
def test_options_outside_their_rules_are_refused(options: dict[str, object], told: str, smile: np.ndarray) -> None:
    with pytest.raises(ParameterError, match=told):
        track_landmarks(recording(smile), **options)  # type: ignore[arg-type]


def test_no_face_at_all_is_refused() -> None:
    with pytest.raises(ModelError, match="no frame"):
        track_landmarks(recording(np.full((5, 478, 3), np.nan)))
