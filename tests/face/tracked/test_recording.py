"""Files of every format are read and written in one way, recognised by what they contain and then by their ending."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import numpy as np
import pytest
import risorius.api as api
from risorius.api import FapStream, StreamFormat, VisemeField
from risorius.errors import FormatError, ParameterError


@pytest.fixture
def stream() -> FapStream:
    """A short stream: the jaw opens; a viseme in its second frame."""
    frames = np.full((5, 68), np.nan)
    frames[:, 2] = [0.0, 100.0, 200.0, 300.0, 400.0]
    return FapStream(frames, fps=20.0, name="take", visemes={1: VisemeField(4)})


SCORES = "timestamp,jawOpen\n0,0\n0.05,0.5\n0.1,1\n"
FRAMES = [{"blendshapes": {"jawOpen": 0.25 * number}} for number in range(3)]


@pytest.mark.parametrize("ending", api.WRITABLE_STREAMS)
def test_every_format_that_is_written_is_read_back(stream: FapStream, tmp_path: Path, ending: str) -> None:
    path = tmp_path / f"take{ending}"
    api.write_stream(path, stream)
    recording = api.read_recording(path)
    assert recording.format == {".csv": "faps"}.get(ending, ending[1:])
    assert (recording.stream.fps, recording.assumed, recording.damage) == (20.0, (), ())
    expected = stream.expanded() if ending == ".csv" else stream.frames
    np.testing.assert_allclose(recording.stream.frames, expected, atol=1.0)
    assert dict(recording.stream.visemes) == ({} if ending == ".csv" else dict(stream.visemes))


@pytest.mark.parametrize("ending", api.WRITABLE_STREAMS)
def test_what_a_file_contains_counts_more_than_its_ending(stream: FapStream, tmp_path: Path, ending: str) -> None:
    path = tmp_path / f"take{ending}"
    api.write_stream(path, stream)
    found = api.read_recording(path)
    renamed = Path(shutil.copy(path, tmp_path / "take.txt"))
    again = api.read_recording(renamed)
    assert again.format is found.format
    np.testing.assert_array_equal(again.stream.frames, found.stream.frames)


@pytest.mark.parametrize("format", ["fap", "fba", "json", "faps"])
def test_a_format_that_is_named_is_written_whatever_the_ending(stream: FapStream, tmp_path: Path, format: str) -> None:
    api.write_stream(tmp_path / "take", stream, format)
    assert api.read_recording(tmp_path / "take").format == format
    assert api.read_recording(tmp_path / "take", format).format == format


def test_options_reach_the_format(stream: FapStream, tmp_path: Path) -> None:
    told: list[api.Progress] = []
    halves = FapStream(stream.frames + 0.25, fps=20.0)
    api.write_stream(tmp_path / "a.fap", halves, decimals=2)
    np.testing.assert_array_equal(api.read_stream(tmp_path / "a.fap").frames, halves.frames)
    api.write_stream(tmp_path / "coarse.fba", stream, quantiser=31, progress=told.append)
    api.write_stream(tmp_path / "fine.fba", stream, quantiser=0)
    assert (tmp_path / "coarse.fba").stat().st_size < (tmp_path / "fine.fba").stat().st_size
    assert told[-1] == (1.0, "5 of 5 frames")


def test_trackers_files_are_recognised(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text(SCORES)
    (tmp_path / "a.json").write_text(json.dumps(FRAMES))
    (tmp_path / "a.jsonl").write_text("\n".join(map(json.dumps, FRAMES)))
    for name, format in (("a.csv", "arkit"), ("a.json", "mediapipe"), ("a.jsonl", "mediapipe")):
        recording = api.read_recording(tmp_path / name)
        assert recording.format is StreamFormat(format)
        assert recording.stream.frames[-1, 2] > recording.stream.frames[0, 2]
        read = api.read_capture(tmp_path / name, kind=format)
        np.testing.assert_array_equal(read.frames, recording.stream.frames)


@pytest.mark.parametrize(
    ("name", "text", "assumed"),
    [
        ("a.json", json.dumps(FRAMES), "the file contains no times: 30 frames per second"),
        ("a.csv", "jawOpen\n0\n1\n", "the file contains no times: 30 frames per second"),
        ("a.csv", "Timecode,jawOpen\n10:00:00:01,0\n10:00:00:02,1\n", "its timecode counts 60 frames per second"),
    ],
)
def test_what_a_file_does_not_say_is_told(tmp_path: Path, name: str, text: str, assumed: str) -> None:
    (tmp_path / name).write_text(text)
    assert api.read_recording(tmp_path / name).assumed == (assumed,)
    recording = api.read_recording(tmp_path / name, rate=50.0)
    assert (recording.assumed, recording.stream.fps) == ((), 50.0)


def test_a_file_with_times_assumes_nothing(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text(SCORES)
    assert api.read_recording(tmp_path / "a.csv").assumed == ()


def test_another_rate_keeps_what_happens_when(stream: FapStream, tmp_path: Path) -> None:
    api.write_stream(tmp_path / "a.fap", FapStream(stream.frames, fps=20.0))
    slow = api.read_stream(tmp_path / "a.fap", fps=10.0)
    assert slow.fps == 10.0
    np.testing.assert_allclose(slow.frames[:, 2], [0.0, 200.0, 400.0])
    api.write_stream(tmp_path / "b.fap", stream)
    spoken = api.read_stream(tmp_path / "b.fap", fps=40.0)
    assert not spoken.visemes
    np.testing.assert_allclose(spoken.frames[2], stream.expanded()[1])


def test_damage_is_told_or_refused(stream: FapStream, tmp_path: Path) -> None:
    path = tmp_path / "a.fba"
    api.write_stream(path, stream)
    path.write_bytes(path.read_bytes()[:-6])
    assert len(api.read_recording(path).damage) == 1
    with pytest.raises(FormatError, match="cut off"):
        api.read_recording(path, strict=True)


@pytest.mark.parametrize(
    ("name", "content", "told"),
    [
        ("a.mp4", b"\x00\x00\x00\x18ftypmp42", r"byte 0: is binary, and not a FAP stream or a recording: use \.fap"),
        ("a.doc", b"dear sir,\nhello,\n", r"line 1: has none of the columns of .*FAPs \(F03_open_jaw\), landmarks"),
        ("a.json", b'{"format": "soup", "version": 1}', 'must be an object with "format": "risorius fap stream"'),
        ("a.json", b'{"frames": [{"hot": true}]}', "has no blend shapes or landmarks in any frame"),
        ("a.fap", b"dear sir", "the header must be"),
    ],
)
def test_what_is_none_of_them_is_refused(tmp_path: Path, name: str, content: bytes, told: str) -> None:
    (tmp_path / name).write_bytes(content)
    with pytest.raises(FormatError, match=told):
        api.read_stream(tmp_path / name)


def test_wrong_requests_are_refused(stream: FapStream, tmp_path: Path) -> None:
    with pytest.raises(FormatError, match=r"x\.doc: is not a writable FAP stream: use \.fap, \.fba, \.json, \.csv"):
        api.write_stream(tmp_path / "x.doc", stream)
    with pytest.raises(FormatError, match="is not a writable"):
        api.write_stream(tmp_path / "x.fap", stream, "openface")
    with pytest.raises(ParameterError, match="format must be one of fap, fba, json, faps, openface"):
        api.read_stream(tmp_path / "x.fap", "soup")
    (tmp_path / "a.csv").write_text(SCORES)
    with pytest.raises(ParameterError, match="rate"):
        api.read_stream(tmp_path / "a.csv", rate=0.0)
    with pytest.raises(FormatError, match="is not valid JSON"):
        api.read_stream(tmp_path / "a.csv", "json")
    (tmp_path / "a.json").write_text(json.dumps(FRAMES))
    with pytest.raises(FormatError, match=r"a\.json: is not a file of the format openface: leave the format out"):
        api.read_stream(tmp_path / "a.json", "openface")


@pytest.mark.parametrize("neutral", [2, (0.07, 0.09)])
def test_scores_are_counted_from_a_neutral_face(neutral: int | tuple[float, float], tmp_path: Path) -> None:
    path = tmp_path / "take.csv"
    path.write_text("timestamp,jawOpen,HeadYaw\n0.00,0.5,0.1\n0.04,,\n0.08,0.2,0.3\n0.12,0.6,0.4\n")
    plain, counted = (api.read_stream(path, neutral=told).frames for told in (None, neutral))
    np.testing.assert_allclose(counted, plain - plain[2])
    assert counted[2, 2] == 0.0
    for nobody in (1, 9, (5.0, 6.0)):
        with pytest.raises(ParameterError, match=r"neutral must (be|contain)"):
            api.read_stream(path, neutral=nobody)
    api.write_stream(tmp_path / "a.fap", api.read_stream(path))
    with pytest.raises(ParameterError, match="neutral must be left out"):
        api.read_stream(tmp_path / "a.fap", neutral=neutral)
