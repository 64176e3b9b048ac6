"""Habits of loggers and programs that write recordings: how they count, name, mark and wrap."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from risorius import api
from risorius.errors import FormatError, ParameterError

OPEN = float(api.load_shapes()["jawOpen"].frame[2])
COUNT = 50


def read(path: Path, text: str | bytes, **options: Any) -> api.Recording:
    """A file with that text, read."""
    path.write_bytes(text.encode() if isinstance(text, str) else text)
    return api.read_recording(path, **options)


def table(name: str, cells: Sequence[object], *others: tuple[str, object]) -> str:
    """A jaw that opens by a thousandth from row to row; `name` tells when, other columns have one value."""
    heading = ",".join([name, "jawOpen", "eyeBlinkLeft", *(other for other, _ in others)])
    rows = [",".join([str(cell), f"{n / 1000}", "0", *(str(v) for _, v in others)]) for n, cell in enumerate(cells)]
    return "\n".join([heading, *rows])


def shown(recording: api.Recording) -> list[float]:
    """Which row each frame is; NaN where nothing is known."""
    return [round(value, 3) for value in recording.stream.frames[:, 2] / OPEN * 1000.0]


def drop_frame(number: int, count: int) -> str:
    """The drop-frame timecode of a frame, written with colons."""
    out = count // 15
    tens, rest = divmod(number, count * 600 - 9 * out)
    number += 9 * out * tens + (out * ((rest - out) // (count * 60 - out)) if rest >= out else 0)
    seconds, frame = divmod(number, count)
    return f"{seconds // 3600:02d}:{seconds // 60 % 60:02d}:{seconds % 60:02d}:{frame:02d}"


# ---- time --------------------------------------------------------------------------------------------


@pytest.mark.parametrize("count", [30, 60])
@pytest.mark.parametrize("mark", [":", "."])
def test_drop_frame_is_told_by_what_a_count_leaves_out(count: int, mark: str, tmp_path: Path) -> None:
    first = 57 * count
    codes = [drop_frame(first + n, count)[:-3] + mark + drop_frame(first + n, count)[-2:] for n in range(8 * count)]
    recording = read(tmp_path / "a.csv", table("Timecode", codes))
    assert recording.stream.fps == pytest.approx(count / 1.001)
    assert shown(recording) == list(range(8 * count))
    assert any("leaves numbers out" in said for said in recording.assumed)


def test_a_count_with_lost_rows_at_a_full_minute_is_no_drop_frame(tmp_path: Path) -> None:
    codes = [f"00:00:{s:02d}:{f:02d}" for s in (58, 59) for f in range(30)]
    codes += [f"00:01:{s:02d}:{f:02d}" for s in (0, 1) for f in range(30) if (s, f) not in ((0, 0), (0, 1), (0, 2))]
    recording = read(tmp_path / "a.csv", table("Timecode", codes))
    assert (recording.stream.fps, len(recording.stream.frames)) == (30.0, 120)


@pytest.mark.parametrize(
    ("name", "unit"), [("time in ms", 1e-3), ("performance.now()", 1e-3), ("now", 1e-3), ("Time in seconds", 1.0)]
)
def test_times_by_more_names(name: str, unit: float, tmp_path: Path) -> None:
    recording = read(tmp_path / "a.csv", table(name, [f"{n / 25 / unit:.6g}" for n in range(COUNT)]))
    assert (recording.stream.fps, shown(recording)) == (25.0, list(range(COUNT)))


def test_minutes_and_seconds(tmp_path: Path) -> None:
    recording = read(tmp_path / "a.csv", table("time", [f"00:{n / 25:06.3f}" for n in range(COUNT)]))
    assert (recording.stream.fps, shown(recording)) == (25.0, list(range(COUNT)))


@pytest.mark.parametrize(
    ("name", "cell"),
    [
        ("image", "{}"),
        ("sample", "{}"),
        ("frame", "frame_{:04d}"),
        ("filename", "take 3/{:05d}.png"),
        ("img", "f{}.JPG"),
    ],
)
def test_rows_that_name_their_image(name: str, cell: str, tmp_path: Path) -> None:
    kept = [*range(20), *range(25, COUNT)]
    recording = read(tmp_path / "a.csv", table(name, [cell.format(n + 1) for n in kept]))
    assert (recording.stream.fps, len(recording.stream.frames)) == (30.0, COUNT)
    assert np.flatnonzero(np.isnan(shown(recording))).tolist() == [20, 21, 22, 23, 24]


def test_a_column_that_states_the_rate(tmp_path: Path) -> None:
    recording = read(tmp_path / "a.csv", table("frame", range(COUNT), ("fps", 25)))
    assert (recording.stream.fps, recording.assumed) == (25.0, ())


def test_a_rate_that_json_states_as_a_text(tmp_path: Path) -> None:
    document = {"FPS": "25", "Frames": [{"jawOpen": n / 1000} for n in range(COUNT)]}
    recording = read(tmp_path / "a.json", json.dumps(document))
    assert (recording.stream.fps, shown(recording)) == (25.0, list(range(COUNT)))


# ---- tables ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("first", ['"sep=;"\r\n', "sep=;;;\r\n"])
def test_the_line_of_the_separator_as_a_spreadsheet_saves_it(first: str, tmp_path: Path) -> None:
    text = table("frame", range(COUNT)).replace(",", ";").replace(".", ",")
    assert shown(read(tmp_path / "a.csv", "\ufeff" + first + text)) == list(range(COUNT))


@pytest.mark.parametrize("remarks", ["# of a phone\n# on Monday\n", "Recorded on Monday\nDevice: phone\n\n"])
def test_lines_of_remarks_above_the_heading(remarks: str, tmp_path: Path) -> None:
    assert shown(read(tmp_path / "a.csv", remarks + table("frame", range(COUNT)))) == list(range(COUNT))


def test_success_as_a_word(tmp_path: Path) -> None:
    rows = [f"{n},{n / 25:.3f},0.98,{n % 5 != 0},{n / 25}" for n in range(COUNT)]
    recording = read(tmp_path / "a.csv", "\n".join(["frame,timestamp,confidence,success,AU26_r", *rows]))
    assert np.flatnonzero(~recording.stream.mask.any(axis=1)).tolist() == list(range(0, COUNT, 5))


def test_scores_with_a_sign_of_per_cent(tmp_path: Path) -> None:
    text = "frame,jawOpen\n" + "\n".join(f"{n},{n / 10}%" for n in range(COUNT))
    assert shown(read(tmp_path / "a.csv", text)) == list(range(COUNT))


@pytest.mark.parametrize(("again", "said"), [("jawOpen", "jawOpen (2)"), ("JawOpen", "JawOpen")])
def test_a_column_that_is_there_twice_is_said(again: str, said: str, tmp_path: Path) -> None:
    recording = read(tmp_path / "a.csv", table("frame", range(COUNT), (again, 0.9)))
    assert shown(recording) == list(range(COUNT))
    assert f"not read: {said}" in recording.assumed


def test_names_that_differ_in_case_alone_are_different_columns(shared: Path) -> None:
    """OpenFace has places in the picture, x_0, and in space, X_0; it leaves nothing unread."""
    recording = api.read_recording(shared / "samples" / "trackers" / "pyfeat" / "OpenFace_Test.csv")
    assert not any(said.startswith("not read") for said in recording.assumed)


def test_points_after_thousands_are_no_decimals(tmp_path: Path) -> None:
    cells = [f"{40 * n:,}".replace(",", ".") for n in range(COUNT)]
    rows = [
        f"{cell};{n / 1000}".replace(f";{n / 1000}", f";{n / 1000:.3f}".replace(".", ","))
        for n, cell in enumerate(cells)
    ]
    recording = read(tmp_path / "a.csv", "timestamp;jawOpen\n" + "\n".join(rows))
    assert (recording.stream.fps, shown(recording)) == (25.0, list(range(COUNT)))


def test_utf_16_without_a_mark(tmp_path: Path) -> None:
    assert shown(read(tmp_path / "a.csv", table("frame", range(COUNT)).encode("utf-16-le"))) == list(range(COUNT))


def test_words_for_nothing_in_place_of_a_timecode_and_of_a_score(tmp_path: Path) -> None:
    codes = ["N/A", *(f"00:00:{n // 25:02d}:{n % 25:02d}" for n in range(COUNT))]
    recording = read(tmp_path / "a.csv", table("Timecode", codes))
    assert (recording.stream.fps, len(recording.stream.frames)) == (25.0, COUNT)
    assert "1 row states no time: left out" in recording.assumed
    frames = [{"t": n / 25, "jawOpen": float("nan") if n == 7 else n / 1000} for n in range(COUNT)]
    assert np.flatnonzero(np.isnan(shown(read(tmp_path / "a.json", json.dumps(frames))))).tolist() == [7]


# ---- names -------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "name",
    ["L_eyeBlink", "l_EyeBlink", "CTRL_eyeBlinkLeft", "a01_eyeBlink_L", "weights[eyeBlinkLeft]", "Fcl-eyeBlinkLeft"],
)
def test_more_names_of_a_shape(name: str, tmp_path: Path) -> None:
    stream = read(tmp_path / "a.csv", f"frame,{name}\n0,0\n1,1\n").stream
    assert stream.frames[1, 18] > 300.0
    assert not stream.mask[:, 19].any()


@pytest.mark.parametrize("name", ["std_jawOpen", "corner_mouth_left", "jawOpen_velocity", "ctrl_jaw"])
def test_what_is_no_value_of_a_shape_is_not_read(name: str, tmp_path: Path) -> None:
    recording = read(tmp_path / "a.csv", f"frame,eyeBlinkLeft,{name}\n0,0,0\n1,1,1\n")
    assert f"not read: {name}" in recording.assumed


def test_the_plain_name_counts_before_one_with_more_to_it(tmp_path: Path) -> None:
    recording = read(tmp_path / "a.csv", "frame,raw_jawOpen,jawOpen\n0,0.9,0\n1,0.9,0.001\n")
    assert shown(recording) == [0.0, 1.0]
    assert "not read: raw_jawOpen" in recording.assumed


# ---- JSON --------------------------------------------------------------------------------------------

LAYOUTS: dict[str, Any] = {
    "data": {"metadata": {"frame_rate": 25}, "data": [{"blendShapes": {"jawOpen": n / 1000}} for n in range(COUNT)]},
    "results": {"fps": 25, "results": [{"faceBlendshapes": {"jawOpen": n / 1000}} for n in range(COUNT)]},
    "keys": {f"frame_{n:04d}": {"t": n / 25, "jawOpen": n / 1000} for n in range(COUNT)},
    "texts": [{"t": f"{n / 25}", "jawOpen": f"{n / 1000}"} for n in range(COUNT)],
    "name and value": [{"t": n / 25, "shapes": [{"name": "jawOpen", "value": n / 1000}]} for n in range(COUNT)],
    "key and weight": [{"t": n / 25, "shapes": [{"key": "jawOpen", "weight": n / 1000}]} for n in range(COUNT)],
    "a video's rate": {"video": {"fps": 25}, "frames": [{"jawOpen": n / 1000} for n in range(COUNT)]},
    "a line above": [{"type": "header", "fps": 25}, *({"jawOpen": n / 1000} for n in range(COUNT))],
    "times as keys": {"frames": {f"{n / 25:.2f}": {"jawOpen": n / 1000} for n in range(COUNT)}},
    "one export in a list": [
        {"exportFps": 25, "facsNames": ["jawOpen"], "weightMat": [[n / 1000] for n in range(COUNT)]}
    ],
    "pairs": [{"t": n / 25, "blendshapes": [["jawOpen", n / 1000], ["eyeBlinkLeft", 0]]} for n in range(COUNT)],
}


@pytest.mark.parametrize("layout", sorted(LAYOUTS))
def test_more_layouts_of_json(layout: str, tmp_path: Path) -> None:
    recording = read(tmp_path / "a.json", json.dumps(LAYOUTS[layout]))
    assert (recording.stream.fps, shown(recording)) == (25.0, list(range(COUNT)))


def test_a_list_of_results_of_few_entries_may_be_faces(tmp_path: Path) -> None:
    document = {"results": [{"faceBlendshapes": {"jawOpen": 0.1}}, {"faceBlendshapes": {"jawOpen": 0.2}}]}
    with pytest.raises(FormatError, match="2 faces"):
        read(tmp_path / "a.json", json.dumps(document))


@pytest.mark.parametrize("named", [True, False])
def test_frames_that_state_whose_face_they_are(named: bool, tmp_path: Path) -> None:
    frames = [
        {"t": n / 25, "jawOpen": n * (1 + face) / 1000, **({"face_id": face} if named else {})}
        for n in range(COUNT)
        for face in (0, 1)
    ]
    with pytest.raises(FormatError, match="2 faces"):
        read(tmp_path / "a.json", json.dumps(frames))
    recording = read(tmp_path / "a.json", json.dumps(frames), face=1)
    assert (recording.stream.fps, shown(recording)) == (25.0, [2 * n for n in range(COUNT)])
    with pytest.raises(ParameterError, match="face"):
        read(tmp_path / "a.json", json.dumps(frames), face=2)


def test_names_that_are_not_known_are_told_in_the_refusal(tmp_path: Path) -> None:
    with pytest.raises(FormatError, match="it seems to hold expressions of a VRM character"):
        read(tmp_path / "a.json", json.dumps([{"blendshapes": {"Joy": 1.0, "A": 0.5}}]))


# ---- logs --------------------------------------------------------------------------------------------


def ifacialmocap(jaw: object, blink: object = 0) -> str:
    """One frame."""
    return f"jawOpen-{jaw}|eyeBlink_L-{blink}|eyeBlink_R-0|browInnerUp-0|mouthSmile_L-0|=head#1,2,3,0,0,0|"


def test_a_quiet_face_of_ifacialmocap_is_on_the_same_scale(tmp_path: Path) -> None:
    recording = read(tmp_path / "a.txt", "\n".join(ifacialmocap(n % 2) for n in range(COUNT)))
    assert shown(recording) == [10.0 * (n % 2) for n in range(COUNT)]
    shares = read(tmp_path / "b.txt", "\n".join(ifacialmocap(n / 1000, "0.5") for n in range(COUNT)))
    assert shown(shares) == list(range(COUNT))


def test_a_date_in_brackets_before_a_frame_is_no_json(tmp_path: Path) -> None:
    lines = [f"[2024-03-20 10:00:{n / 25:06.3f}] {ifacialmocap(n)}" for n in range(COUNT)]
    recording = read(tmp_path / "a.txt", "\n".join(lines))
    assert (recording.stream.fps, shown(recording)) == (25.0, [10 * n for n in range(COUNT)])


@pytest.mark.parametrize("said", ["('jawOpen', {})", "jawOpen, {}", "['jawOpen', {}]", "'jawOpen' {}"])
def test_messages_of_vmc_as_a_script_prints_them(said: str, tmp_path: Path) -> None:
    lines = [f"/VMC/Ext/Blend/Val {said.format(n / 1000)}\n/VMC/Ext/Blend/Apply ()" for n in range(COUNT)]
    assert shown(read(tmp_path / "a.log", "\n".join(lines))) == list(range(COUNT))


@pytest.mark.parametrize("name", ["isTracked", "face_detected", "success", "Valid"])
@pytest.mark.parametrize("kind", ["csv", "json"])
def test_a_frame_that_says_that_no_face_was_seen_is_unknown(name: str, kind: str, tmp_path: Path) -> None:
    """What stands beside it is what was seen before."""
    path = tmp_path / f"a.{kind}"
    if kind == "csv":
        rows = [f"{n / 25:.2f},{str(n not in (2, 3)).lower()},0.5" for n in range(6)]
        path.write_text("\n".join([f"timestamp,{name},jawOpen", *rows]))
    else:
        frames = [{"timestamp": n / 25, name: n not in (2, 3), "blendshapes": {"jawOpen": 0.5}} for n in range(6)]
        path.write_text(json.dumps(frames))
    assert np.isnan(api.read_stream(path).frames[:, 2]).tolist() == [False, False, True, True, False, False]


def test_a_heading_that_is_written_again_is_no_row(tmp_path: Path) -> None:
    rows = [f"{n / 25:.2f},{n / 10}" for n in range(6)]
    (tmp_path / "a.csv").write_text("\n".join(["timestamp,jawOpen", *rows[:3], "timestamp,jawOpen", *rows[3:]]))
    assert len(api.read_stream(tmp_path / "a.csv").frames) == 6
