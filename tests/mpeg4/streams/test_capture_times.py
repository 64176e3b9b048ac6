"""When the rows of a recording are: rates, gaps and order from times, timecodes, numbers, or nothing."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
import pytest
from risorius import api
from risorius.errors import FormatError, ParameterError

Write = Callable[..., Path]
OPEN = api.load_shapes()["jawOpen"].frame[2]


@pytest.fixture
def take(tmp_path: Path) -> Write:
    """A table with the named columns of time, whose jaw opens by a ten-thousandth from row to row."""

    def write(columns: dict[str, Sequence[object]], *, shape: str = "jawOpen") -> Path:
        count = len(next(iter(columns.values())))
        values = [[str(column[row]) for column in columns.values()] for row in range(count)]
        rows = [",".join([*cells, f"{row / 10000}"]) for row, cells in enumerate(values)]
        path = tmp_path / "take.csv"
        path.write_text("\n".join([",".join([*columns, shape]), *rows]) + "\n")
        return path

    return write


def timecodes(count: int, rate: float, *, step: int = 1, first: int = 0, mark: str = ":") -> list[str]:
    """Timecodes that count `rate` frames a second."""
    numbers = [first + step * row for row in range(count)]
    clock = [(number // int(rate), number % int(rate)) for number in numbers]
    return [f"{s // 3600:02d}:{s // 60 % 60:02d}:{s % 60:02d}{mark}{frame:02d}" for s, frame in clock]


def gaps(stream: api.FapStream) -> list[int]:
    """Frames of which nothing is known."""
    return [int(frame) for frame in np.flatnonzero(~stream.mask.any(axis=1))]


def rows_of(stream: api.FapStream) -> list[float]:
    """Which row of the file each frame is."""
    return [round(float(value), 6) for value in stream.frames[:, 2] / OPEN * 10000]


# ---- timecodes -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("rate", [24, 25, 30, 48, 50, 60])
def test_a_timecode_counts_to_where_it_begins_anew(rate: int, take: Write) -> None:
    stream = api.read_stream(take({"Timecode": timecodes(3 * rate, rate)}))
    assert (stream.fps, len(stream.frames), gaps(stream)) == (rate, 3 * rate, [])
    assert rows_of(stream) == list(range(3 * rate))
    assert stream.assumed == (
        () if rate == 60 else (f"its timecode begins anew after {rate}: it counts {rate} frames per second",)
    )


def test_a_count_of_which_every_second_number_is_written_is_half_as_fast(take: Write) -> None:
    stream = api.read_stream(take({"Timecode": timecodes(90, 60, step=2)}))
    assert (stream.fps, len(stream.frames), gaps(stream)) == (30.0, 90, [])


def test_rows_at_24_in_a_count_of_60_are_24(take: Write) -> None:
    numbers = [round(2.5 * row) for row in range(72)]
    codes = [f"10:00:{number // 60:02d}:{number % 60:02d}" for number in numbers]
    stream = api.read_stream(take({"Timecode": codes}))
    assert (stream.fps, len(stream.frames), rows_of(stream)) == (24.0, 72, list(range(72)))


def test_a_real_clock_beside_the_count_drifts_by_less_than_a_frame(take: Write) -> None:
    """Live Link Face writes parts of a frame: 31.652, 33.651, ..."""
    numbers = [31.652 + 1.9995 * row for row in range(300)]
    codes = [f"13:13:{4 + int(number // 60):02d}:{number % 60:06.3f}" for number in numbers]
    stream = api.read_stream(take({"Timecode": codes}))
    assert (stream.fps, rows_of(stream)) == (30.0, list(range(300)))


def test_drop_frame_leaves_out_numbers_and_no_frames(take: Write) -> None:
    codes = ["00:00:59;28", "00:00:59;29", "00:01:00;02", "00:01:00;03", "00:01:00;04"]
    stream = api.read_stream(take({"Timecode": codes}))
    assert stream.fps == pytest.approx(30000 / 1001)
    assert rows_of(stream) == [0, 1, 2, 3, 4]


def test_a_tenth_minute_of_drop_frame_leaves_out_nothing(take: Write) -> None:
    codes = ["00:09:59;28", "00:09:59;29", "00:10:00;00", "00:10:00;01"]
    assert rows_of(api.read_stream(take({"Timecode": codes}))) == [0, 1, 2, 3]


def test_thousandths_in_the_place_of_frames(take: Write) -> None:
    codes = [f"10:00:{row // 25:02d}:{40 * row % 1000:03d}" for row in range(60)]
    stream = api.read_stream(take({"Timecode": codes}))
    assert (stream.fps, len(stream.frames), gaps(stream)) == (25.0, 60, [])
    assert stream.assumed == ("its timecode counts milliseconds",)


@pytest.mark.parametrize("day", ["10:00:{:06.3f}", "2024-03-20T10:00:{:06.3f}Z", "2024-03-20 10:00:{:06.3f}"])
def test_times_of_day_and_dates(day: str, take: Write) -> None:
    stream = api.read_stream(take({"time": [day.format(row / 25) for row in range(50)]}))
    assert (stream.fps, rows_of(stream)) == (25.0, list(range(50)))


def test_a_take_over_midnight_goes_on(take: Write) -> None:
    codes = [f"23:59:59:{frame:02d}" for frame in range(30)] + [f"00:00:00:{frame:02d}" for frame in range(30)]
    stream = api.read_stream(take({"Timecode": codes}))
    assert (stream.fps, len(stream.frames), gaps(stream)) == (30.0, 60, [])


def test_a_repeated_timecode_costs_one_row(take: Write) -> None:
    codes = timecodes(90, 30)
    codes[40] = codes[39]
    stream = api.read_stream(take({"Timecode": codes}))
    assert (stream.fps, len(stream.frames), gaps(stream)) == (30.0, 90, [40])
    assert "1 row repeats the time before: left out" in stream.assumed


def test_missing_timecodes_are_unknown_frames(take: Write) -> None:
    codes = timecodes(90, 30)
    stream = api.read_stream(take({"Timecode": [*codes[:20], *codes[25:40], *codes[41:]]}))
    assert (len(stream.frames), gaps(stream)) == (90, [20, 21, 22, 23, 24, 40])


def test_a_rate_overrules_a_timecode_and_that_is_said(take: Write) -> None:
    path = take({"Timecode": timecodes(60, 30)})
    stream = api.read_stream(path, rate=60.0)
    assert (stream.fps, len(stream.frames), gaps(stream)) == (60.0, 60, [])
    assert stream.assumed[-1] == "its own 30 frames per second are overruled by the rate of 60"
    assert api.read_stream(path, rate=30.0).fps == 30.0


# ---- times ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize("rate", [15, 24, 25, 30, 48, 50, 60, 90, 120, 240])
@pytest.mark.parametrize("seconds", [2, 300])
def test_rounded_times_have_the_rate_of_the_whole_take(rate: int, seconds: int, take: Write) -> None:
    count = min(rate * seconds, 5000)
    stream = api.read_stream(
        take({"frame": range(1, count + 1), "timestamp": [f"{n / rate:.3f}" for n in range(count)]})
    )
    assert (stream.fps, len(stream.frames)) == (rate, count)
    assert rows_of(stream) == list(range(count))
    assert stream.assumed == ()


@pytest.mark.parametrize("rate", [24000 / 1001, 30000 / 1001, 60000 / 1001])
def test_broadcast_rates_are_told_from_whole_ones(rate: float, take: Write) -> None:
    stream = api.read_stream(take({"timestamp": [f"{n / rate:.3f}" for n in range(1200)]}))
    assert stream.fps == pytest.approx(rate, rel=1e-9)
    assert rows_of(stream) == list(range(1200))


def test_rounded_times_with_gaps(take: Write) -> None:
    kept = [n for n in range(300) if n not in (50, 51, 52, 200)]
    stream = api.read_stream(take({"timestamp": [f"{n / 60:.3f}" for n in kept]}))
    assert (stream.fps, len(stream.frames), gaps(stream)) == (60.0, 300, [50, 51, 52, 200])


@pytest.mark.parametrize(
    ("name", "unit", "said"),
    [
        ("timestamp", 1e-3, True), ("time", 1e-6, True), ("timestamp_ms", 1e-3, False), ("timeMs", 1e-3, False),
        ("Time (s)", 1.0, False), ("time_us", 1e-6, False), ("Time [ms]", 1e-3, False), ("elapsed", 1.0, False),
        ("timeCode", 1.0, False), ("timestamp_ms", 1.0, True), ("frame_time", 1.0, False), ("ms", 1e-3, False),
    ],
)  # fmt: skip
def test_times_by_any_name_and_in_any_unit(name: str, unit: float, said: bool, take: Write) -> None:
    stream = api.read_stream(take({name: [f"{n / 25 / unit:.9g}" for n in range(50)]}))
    assert (stream.fps, rows_of(stream)) == (25.0, list(range(50)))
    assert any("its times are in" in assumed for assumed in stream.assumed) is said


def test_milliseconds_of_an_epoch(take: Write) -> None:
    start = 1710921600000
    stream = api.read_stream(take({"timestamp": [start + int(n * 1000 / 30) for n in range(90)]}))
    assert (stream.fps, len(stream.frames), gaps(stream)) == (30.0, 90, [])


@pytest.mark.parametrize("step", [50.0, 5000.0, 1e-5])
def test_times_that_make_no_rate_are_in_another_unit_or_refused(step: float, take: Write) -> None:
    path = take({"timestamp_s": [f"{n * step:g}" for n in range(50)]})
    if step == 50.0:
        assert api.read_stream(path).fps == 20.0
    elif step == 5000.0:
        assert api.read_stream(path).fps == 200.0
    else:
        with pytest.raises(FormatError, match=r"line 2, column timestamp_s: .*name the rate \(--rate\)"):
            api.read_stream(path)
        assert api.read_stream(path, rate=40.0).fps == 40.0


@pytest.mark.parametrize("stamp", ["{:.3f}", "0"])
def test_single_images_have_no_times_and_obey_the_rate(stamp: str, take: Write) -> None:
    path = take({"frame": range(1, 31), "timestamp": [stamp.format(n / 1000) for n in range(30)]})
    stream = api.read_stream(path)
    assert (stream.fps, len(stream.frames)) == (30.0, 30)
    assert stream.assumed[-1] == "the file contains no times: 30 frames per second"
    assert api.read_stream(path, rate=24.0).fps == 24.0


def test_times_that_are_all_the_same_want_a_rate(take: Write) -> None:
    path = take({"timestamp": [7.5] * 10})
    with pytest.raises(FormatError, match=r"line 3, column timestamp: must be later.*--rate"):
        api.read_stream(path)
    assert api.read_stream(path, rate=24.0).fps == 24.0


def test_the_jitter_of_a_webcam_keeps_the_usual_rate_and_the_times(take: Write) -> None:
    times = np.arange(200) / 30 + np.random.default_rng(1).uniform(-0.006, 0.006, 200)
    stream = api.read_stream(take({"timestamp": [f"{time:.5f}" for time in times - times[0]]}))
    assert stream.fps == 30.0
    expected = np.interp(np.arange(len(stream.frames)) / 30, times - times[0], np.arange(200.0))
    np.testing.assert_allclose(stream.frames[:, 2] / OPEN * 10000, expected, atol=0.01)


def test_a_row_without_a_time_is_left_out_and_one_that_falls_back_is_refused(take: Write) -> None:
    stream = api.read_stream(take({"timestamp": [0, 0.04, "", 0.12, 0.16]}))
    assert (rows_of(stream)[:2], gaps(stream)) == ([0, 1], [2])
    assert "1 row states no time: left out" in stream.assumed
    with pytest.raises(FormatError, match="line 5, column timestamp: must be later than the row before: sort"):
        api.read_stream(take({"timestamp": [0, 0.04, 0.12, 0.08, 0.16]}))


def test_a_rate_overrules_times_and_that_is_said(take: Write) -> None:
    stream = api.read_stream(take({"timestamp": [n / 25 for n in range(50)]}), rate=50.0)
    assert (stream.fps, len(stream.frames)) == (50.0, 50)
    assert stream.assumed == ("its own 25 frames per second are overruled by the rate of 50",)


# ---- numbers, and nothing ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "name", ["frame", "frame_number", "frame_idx", "frame_id", "Frame Number", "frameIndex", "Unnamed: 0"]
)
def test_frame_numbers_are_places(name: str, take: Write) -> None:
    stream = api.read_stream(take({name: [1, 2, 3, 7, 8, 10]}))
    assert (stream.fps, len(stream.frames), gaps(stream)) == (30.0, 10, [3, 4, 5, 8])
    assert stream.assumed == ("the file contains no times: 30 frames per second",)
    assert api.read_stream(take({name: [1, 2, 3, 7, 8, 10]}), rate=24.0).fps == 24.0


def test_rows_without_values_are_unknown_in_place(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    path.write_text(
        "Timecode,BlendShapeCount,JawOpen,EyeBlinkLeft\n0:0:0:00,52,1,0\n0:0:0:01,0\n0:0:0:02,0,0,0\n0:0:0:03,52,1,0\n"
    )
    assert gaps(api.read_stream(path)) == [1, 2]
    path.write_text("timestamp,jawOpen,eyeBlinkLeft\n0,1,0\n0.04,,\n0.08\n0.12,1,0\n")
    assert gaps(api.read_stream(path)) == [1, 2]


@pytest.mark.parametrize(
    ("document", "fps", "count"),
    [
        ({"fps": 25, "frames": [{"blendshapes": {"jawOpen": 0}}] * 4}, 25.0, 4),
        ({"frameRate": 50.0, "frames": [{"blendshapes": {"jawOpen": 0}}] * 4}, 50.0, 4),
        ([{"frame": n, "blendshapes": {"jawOpen": 0}} for n in (0, 1, 4)], 30.0, 5),
        ([{"timestamp": 1710921600000 + 40 * n, "blendshapes": {"jawOpen": 0}} for n in range(9)], 25.0, 9),
        ([{"time": f"2024-03-20T08:00:00.{40 * n:03d}Z", "blendshapes": {"jawOpen": 0}} for n in range(9)], 25.0, 9),
        ([{"timeMs": 5000.5 + 20 * n, "blendshapes": {"jawOpen": 0}} for n in range(9)], 50.0, 9),
    ],
)
def test_json_has_the_same_model(document: object, fps: float, count: int, tmp_path: Path) -> None:
    (tmp_path / "a.json").write_text(json.dumps(document))
    stream = api.read_stream(tmp_path / "a.json")
    assert (stream.fps, len(stream.frames)) == (fps, count)


# ---- where a stream begins -----------------------------------------------------------------------------


def test_a_stream_begins_where_it_is_told(take: Write) -> None:
    path = take({"timestamp": [10 + n / 25 for n in range(50)]})
    assert api.read_stream(path).assumed == ("its times begin at 10 s, which is frame 0",)
    later = api.read_stream(path, start=11.0)
    assert rows_of(later) == list(range(25, 50))
    earlier = api.read_stream(path, start=9.8)
    assert gaps(earlier) == [0, 1, 2, 3, 4]
    assert len(earlier.frames) == 55
    assert later.assumed == earlier.assumed == ()


def test_a_stream_begins_at_a_timecode(take: Write) -> None:
    path = take({"Timecode": timecodes(90, 30, first=3600 * 30)})
    assert rows_of(api.read_stream(path, start="01:00:01:15"))[0] == 45
    with pytest.raises(ParameterError, match=r"start must not be later than the last row"):
        api.read_stream(path, start="01:00:09:00")
    with pytest.raises(ParameterError, match="start must be seconds, or a timecode"):
        api.read_stream(path, start="noon")


@pytest.mark.parametrize("step", [2.0, 2000.0])
def test_no_unit_is_made_up_for_times_of_no_camera(step: float, take: Write) -> None:
    """Two seconds apart, or two thousand milliseconds: not 500 a second."""
    with pytest.raises(FormatError, match=r"no frame rate from 1 to 1000 per second; name the rate \(--rate\)"):
        api.read_stream(take({"timestamp": [f"{step * n:g}" for n in range(30)]}))


def test_a_file_that_states_no_frame_rate_of_a_recording_is_refused(tmp_path: Path) -> None:
    (tmp_path / "a.json").write_text(json.dumps({"fps": 48000, "frames": [{"blendshapes": {"jawOpen": 0}}] * 4}))
    with pytest.raises(FormatError, match="states 48000 frames per second: name the rate"):
        api.read_stream(tmp_path / "a.json")
    assert api.read_stream(tmp_path / "a.json", rate=25.0).fps == 25.0
