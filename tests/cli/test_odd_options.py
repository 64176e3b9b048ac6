"""Options that are out of range, do nothing, or name no file: each is refused in words, and nothing is written."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import risorius.api as api
from risorius.cli import main

STREAM = ["fap", "convert", "a.json", "b.fba"]
MESH = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"

#: What is asked -> a part of what is said about it.
REFUSED: dict[str, tuple[list[str], str]] = {
    "endless refresh": ([*STREAM, "--refresh=inf"], "refresh must be from 0.001"),
    "huge refresh": ([*STREAM, "--refresh=1e308"], "refresh must be from 0.001"),
    "refresh that is lost": ([*STREAM, "--refresh=1e-320"], "refresh must be from 0.001"),
    "rate that is lost": (["fap", "of", "joy", "--out", "b.fap", "--fps=1e-320"], "fps must be from 0.001"),
    "no rate": (["say", "--timings", "p.csv", "--out", "b.fap", "--fps=0"], "fps must be from 0.001"),
    "huge start": (["import", "a.csv", "--out", "b.fap", "--start=-1e308"], "start must be seconds"),
    "rate of a recording": (["import", "a.csv", "--out", "b.fap", "--rate=1e-320"], "rate must be from 0.001"),
    "aspect": (["import", "a.csv", "--out", "b.fap", "--aspect=nan"], "must be WIDTH:HEIGHT"),
    "upright aspect": (["import", "a.csv", "--out", "b.fap", "--aspect=0:0"], "must be WIDTH:HEIGHT"),
    "no value": (["import", "a.csv", "--out=--"], "--out needs a value"),
    "no name": (["import", "a.csv", "--out="], "--out must end in"),
    "null": (["import", "a.csv", "--out=b\0.fap"], "null character"),
    "half a letter": (["import", "a.csv", "--out=b\ud800.fap"], "cannot be written"),
    "another format": (["import", "a.csv", "--out", "b.mp4"], "--out must end in .fap or .fba"),
    "a film as a .blend": (["bake", "joy", "--out", "b.mp4"], "--out must end in .blend"),
    "a .blend as a film": (["render", "joy", "--out", "b.blend"], "--out must end in .mp4"),
    "a text as a film": (["fap", "play", "a.json", "b.txt"], "--out must end in .blend or .mp4"),
    "another table": (["export", "csv", "a.csv", "--out", "b.fap"], "--out must end in .csv"),
    "rate of a word": (["fap", "of", "joy", "--rate=30"], "--rate is for a file"),
    "strength of a file": (["fap", "of", "a.json", "--activation=3"], "--activation is for an emotion word"),
    "mesh of a stream": (["say", "--timings", "a.json", "--out", "b.fap", "--mesh=x.obj"], "--mesh is for a .blend"),
    "lean to nothing": (["say", "--timings", "a.json", "--out", "b.fap", "--lean=2"], "--lean needs --emotion"),
    "fps of a recording": (["recognise", "a.json", "--fps=30"], "--fps is for meshes"),
    "rate of a mesh": (["measure", "a.obj", "--rate=30"], "--rate is for a recording"),
    "names of a table": (["export", "csv", "a.csv", "--out", "b.csv", "--names=x"], "--names does nothing in export"),
    "memory": (["batch", "jobs.csv", "--out", "set", "--memory=inf", "--processes=2"], "--memory above 0"),
}  # fmt: skip


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a stream, a recording, a mesh and a table of jobs."""
    monkeypatch.chdir(tmp_path)
    api.write_fap_json("a.json", api.FapStream(np.zeros((3, 68)), fps=25.0))
    Path("a.csv").write_text("timestamp,jawOpen\n0,0\n0.04,0.5\n0.08,1\n", encoding="utf-8")
    Path("p.csv").write_text("start,end,phoneme\n0,0.2,p\n0.2,0.5,a\n", encoding="utf-8")
    Path("a.obj").write_text(MESH, encoding="utf-8")
    Path("jobs.csv").write_text("emotion\njoy\n", encoding="utf-8")
    return tmp_path


@pytest.mark.parametrize("name", REFUSED)
def test_what_is_out_of_range_or_idle_is_refused(name: str, here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    arguments, said = REFUSED[name]
    before = sorted(path.name for path in here.iterdir())
    assert main(arguments) in (1, 2)
    told = capsys.readouterr()
    assert said in told.err
    assert not told.out
    assert sorted(path.name for path in here.iterdir()) == before


def test_a_stream_is_written_in_the_format_that_its_name_says(here: Path) -> None:
    for ending in api.WRITABLE_STREAMS:
        assert main(["import", "a.csv", "--out", f"b{ending}"]) == 0
        assert len(api.read_stream(f"b{ending}").frames) == 3


def test_options_of_other_formats_are_told(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["fap", "convert", "a.json", "b.fap", "--quantiser=3"]) == 0
    assert "--quantiser is for writing .fba files: not used" in capsys.readouterr().err


def test_long_silence_is_kept_in_a_bitstream_and_many_start_codes_are_passed_at_once() -> None:
    frames = np.full((20_005, 68), np.nan)
    frames[[0, 5, -1], 2] = 100.0
    decoded = api.decode_fba(api.encode_fba(api.FapStream(frames, fps=1.0), refresh=0.001), strict=True)
    np.testing.assert_array_equal(np.isnan(decoded.stream.frames), np.isnan(frames))
