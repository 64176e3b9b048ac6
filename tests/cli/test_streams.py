"""The verbs of FAP streams: info, convert, play, tables."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import risorius.api as api
from risorius.cli import main

Run = Callable[..., Any]


@pytest.fixture
def run_json(capsys: pytest.CaptureFixture[str]) -> Run:
    """Run one verb with --json, which must succeed, and return the object that it prints."""

    def run(*arguments: object) -> Any:
        assert main([*map(str, arguments), "--json"]) == 0
        return json.loads(capsys.readouterr().out)

    return run


@pytest.fixture
def joy(shared: Path) -> Path:
    """A sample of speech with joy."""
    return shared / "samples" / "fap" / "xface_joy.fap"


def test_info_says_what_a_stream_holds(run_json: Run, joy: Path) -> None:
    said = run_json("fap", "info", joy)
    assert (said["frames"], said["fps"], len(said["faps"]), said["damage"]) == (108, 25.0, 42, [])
    stream = api.read_fap(joy)
    assert said["ranges"]["4"] == [np.nanmin(stream.frames[:, 3]), np.nanmax(stream.frames[:, 3])]
    assert run_json("fap", joy) == said


@pytest.mark.parametrize("suffix", ["fap", "fba", "json", "csv"])
def test_a_stream_goes_through_every_format(run_json: Run, joy: Path, tmp_path: Path, suffix: str) -> None:
    between, back = tmp_path / f"x.{suffix}", tmp_path / "back.fap"
    said = run_json("fap", "convert", joy, between, "--quantiser", 0)
    assert said["bytes"] == between.stat().st_size
    run_json("fap", "convert", between, "--out", back)
    np.testing.assert_array_equal(api.read_fap(back).frames, api.read_fap(joy).frames)
    assert api.read_fap(back).fps == 25.0


def test_a_bitstream_takes_a_few_kilobits_per_second(run_json: Run, joy: Path, tmp_path: Path) -> None:
    said = run_json("fap", "convert", joy, tmp_path / "x.fba", "--quantiser", 4)
    assert 1.0 < said["kilobits_per_second"] < 4.0


def test_filling_and_expanding(run_json: Run, tmp_path: Path) -> None:
    path = tmp_path / "x.fap"
    mask = " ".join("1" if number in (1, 31) else "0" for number in range(1, 69))
    path.write_text(f"2.1 x 25 1\n{mask}\n0 10 0 63 0 40\n", encoding="ascii")
    assert run_json("fap", "info", path)["faps"] == [31]
    assert run_json("fap", "info", path)["visemes"] == 1
    assert run_json("fap", "info", path, "--fill", "copy")["faps"] == [31, 32]
    expanded = run_json("fap", "info", path, "--expand")
    assert expanded["visemes"] == 0
    assert {3, 31} <= set(expanded["faps"])


def test_damage_is_said_and_refused_when_asked(
    run_json: Run, capsys: pytest.CaptureFixture[str], joy: Path, tmp_path: Path
) -> None:
    path = tmp_path / "x.fba"
    run_json("fap", "convert", joy, path)
    path.write_bytes(path.read_bytes()[:-40])
    assert len(run_json("fap", "info", path)["damage"]) == 1
    assert main(["fap", "info", str(path), "--strict"]) == 1
    said = capsys.readouterr()
    assert said.out == ""
    assert "cut off" in said.err


@pytest.mark.slow
def test_tables_are_written_with_their_error(run_json: Run, tmp_path: Path) -> None:
    out = tmp_path / "face.json"
    said = run_json("tables", "--out", out, "--faps", 23, 65, "--steps", 1)
    assert set(said["tables"]) == {"23", "65"}
    assert 0.0 < said["tables"]["23"]["rms_mm"] <= said["tables"]["23"]["largest_mm"]
    assert set(api.read_animation_tables(out).tables) == {23, 65}
    run_json("tables", "--out", tmp_path / "face.wrl", "--faps", 65, "--steps", 1)
    assert "FaceDefTables" in (tmp_path / "face.wrl").read_text()


@pytest.mark.parametrize(
    "arguments",
    [
        ["fap"],
        ["fap", "info"],
        ["fap", "convert", "a.fap"],
        ["fap", "joy", "anger"],
        ["fap", "play", "a.fap"],
        ["tables"],
        ["tables", "--out", "x.png"],
        ["fap", "info", "x.fap", "--fill", "guess"],
    ],
)
def test_wrong_usage_exits_with_2(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(arguments) == 2
    assert capsys.readouterr().out == ""


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        (["fap", "info", "gone.fba"], "gone.fba"),
        (["fap", "info", "gone.json"], "gone.json"),
        (["fap", "info", "film.mp4"], "film.mp4"),
        (["fap", "surprise", "--out", "x.doc"], "x.doc"),
        (["fap", "surprise", "--out", "x.fba", "--quantiser", "99"], "quantiser"),
        (["tables", "--out", "x.json", "--faps", "1"], "faps"),
    ],
)
def test_errors_exit_with_1_and_name_the_thing(
    arguments: list[str], named: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(arguments) == 1
    said = capsys.readouterr()
    assert said.out == ""
    assert named in said.err


@pytest.mark.slow
def test_playing_needs_blender_and_says_so(joy: Path, tmp_path: Path) -> None:
    """In an interpreter where bpy cannot be imported, wherever the tests run."""
    code = "import sys; sys.modules['bpy'] = None; from risorius.cli import main; sys.exit(main(sys.argv[1:]))"
    command = [sys.executable, "-c", code, "fap", "play", str(joy), "x.blend"]
    done = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path, check=False)
    assert done.returncode == 1
    assert "pip install bpy" in done.stderr
    assert list(tmp_path.iterdir()) == []


def test_options_may_stand_before_what_is_done_and_of_may_be_left_out(run_json: Run, joy: Path) -> None:
    said = run_json("fap", "info", joy, "--fill", "hold")
    assert run_json("fap", "--fill", "hold", "info", joy) == said
    assert run_json("fap", "--fill", "hold", joy) == run_json("fap", "of", joy, "--fill", "hold") == said


def test_a_trackers_recording_is_a_stream_like_any_other(run_json: Run, tmp_path: Path) -> None:
    (tmp_path / "a.json").write_text('[{"blendshapes": {"jawOpen": 0}}, {"blendshapes": {"jawOpen": 1}}]')
    said = run_json("fap", "info", tmp_path / "a.json")
    assert said["format"] == "mediapipe"
    assert said["assumed"] == ["the file contains no times: 30 frames per second"]
    run_json("fap", "convert", tmp_path / "a.json", tmp_path / "a.fba")
    assert run_json("fap", "info", tmp_path / "a.fba")["format"] == "fba"
    assert set(run_json("recognise", tmp_path / "a.json")) == {*map(str, api.ARCHETYPES), "assumed"}
    assert set(run_json("recognise", tmp_path / "a.fba")) == set(map(str, api.ARCHETYPES))
    run_json("export", "csv", tmp_path / "a.fba", "--out", tmp_path / "a.csv")
    assert run_json("fap", "info", tmp_path / "a.csv")["format"] == "faps"


@pytest.mark.parametrize("verb", [["import"], ["fap", "info"], ["recognise"]])
def test_what_was_assumed_is_said_and_can_be_overruled(
    verb: list[str], capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    path = tmp_path / "take.csv"
    path.write_text("frame,jawOpen\n0,0.1\n1,0.2\n4,0.3\n")
    assert main([*verb, str(path)]) == 0
    assert capsys.readouterr().err == "note: take.csv: the file contains no times: 30 frames per second\n"
    assert main([*verb, str(path), "--rate", "24"]) == 0
    assert capsys.readouterr().err == ""


def test_a_stream_begins_where_it_is_told(run_json: Run, tmp_path: Path) -> None:
    (tmp_path / "take.csv").write_text("timestamp,jawOpen\n2.00,0\n2.04,0\n2.08,0\n")
    said = run_json("import", tmp_path / "take.csv")
    assert (said["frames"], said["assumed"]) == (3, ["its times begin at 2 s, which is frame 0"])
    said = run_json("import", tmp_path / "take.csv", "--start", 0)
    assert (said["frames"], said["unknown_frames"], said["assumed"]) == (53, 50, [])


@pytest.mark.parametrize("name", ["take.csv", "take.txt", "take.dat"])
def test_every_verb_that_reads_streams_reads_recordings(
    name: str, run_json: Run, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / name
    path.write_text("timestamp;jawOpen;earWiggle\n0,00;0,1;1\n0,04;0,2;1\n0,08;0,3;1\n")
    for verb in (["import"], ["fap", "info"], ["fap"]):
        said = run_json(*verb, path)
        assert (said["format"], said["fps"], said["assumed"]) == ("arkit", 25.0, ["not read: earWiggle"])
    said = run_json("recognise", path)
    assert (set(said), said["assumed"]) == ({*map(str, api.ARCHETYPES), "assumed"}, ["not read: earWiggle"])
    for options in (["--words"], ["--over-time"]):
        assert run_json("recognise", path, *options)["assumed"] == ["not read: earWiggle"]
    run_json("fap", "convert", path, tmp_path / "a.fap")
    if name != "take.dat":
        measured = run_json("measure", path, "--out", tmp_path / "b.fap")[str(path)]
        assert (measured["frames"], measured["format"], next(iter(measured["ranges"]))) == (3, "arkit", "3")
        assert (tmp_path / "a.fap").read_text().splitlines()[1:] == (tmp_path / "b.fap").read_text().splitlines()[1:]


def test_what_is_no_recording_is_said_to_be_what_it_is(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "clip.mp4"
    path.write_bytes(b"\x00\x00\x00\x18ftypmp42")
    for verb in (["import"], ["fap", "info"], ["recognise"], ["measure"]):
        if verb == ["measure"]:
            path = path.rename(tmp_path / "clip.csv")
        assert main([*verb, str(path)]) == 1
        assert "it seems to be a video (track it: risorius track)" in capsys.readouterr().err
