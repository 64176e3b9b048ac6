"""Clips of a batch: what a row asks for is in the files, and the same row gives the same bytes."""

from __future__ import annotations

import csv
import json
import subprocess
import sys
import textwrap
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest
import risorius.api as api
from risorius import cli
from risorius.scene.jobs.shown import stream
from risorius.scene.mesh import evaluated_vertices

TABLE = """id,emotion,fap,text,activation,seed,apex,outputs,size,yaw
joy,joy,,,6,3,0.1,film still blend glb fap labels,64,20
calm,neutral,,,,,0.1,still film,64,0
still,anger,,,,,,still labels,64,-20
jaw,,take.fap,,,,,film still fap,64,0
"""


def batch(table: Path, out: Path, *options: str, capsys: pytest.CaptureFixture[str], code: int = 0) -> Any:
    """Run the verb; what it says as JSON."""
    capsys.readouterr()
    assert cli.main(["batch", str(table), "--out", str(out), *options, "--json"]) == code
    said = capsys.readouterr().out
    return json.loads(said[said.index("{") :])


@pytest.fixture
def table(tmp_path: Path) -> Path:
    """Four rows, one of which plays a stream."""
    frames = np.full((6, 68), np.nan)
    frames[:, 2] = np.linspace(0.0, 300.0, 6)
    api.write_stream(tmp_path / "take.fap", api.FapStream(frames, fps=12.0, name="take"))
    path = tmp_path / "jobs.csv"
    path.write_text(TABLE)
    return path


def pictured(path: Path) -> np.ndarray:
    """(height, width, 3) of a picture."""
    image = bpy.data.images.load(str(path))
    width, height = image.size
    return np.array(image.pixels[:]).reshape(height, width, -1)[..., :3]


@pytest.mark.slow
@pytest.mark.smoke
def test_a_batch_makes_what_its_rows_ask_for(table: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "set"
    said = batch(table, out, capsys=capsys)
    assert sorted(said["made"]) == ["calm", "jaw", "joy", "still"]
    there = {folder.name: {path.name for path in folder.iterdir()} for folder in out.iterdir() if folder.is_dir()}
    assert there["joy"] == {"film.mp4", "still.png", "clip.blend", "clip.glb", "clip.fap", "labels", "job.json"}
    assert there["still"] == {"still.png", "labels", "job.json"}
    frames = {name: (out / name / "labels" / "frames.csv").read_text().splitlines() for name in ("joy", "still")}
    made = json.loads((out / "joy" / "job.json").read_text())
    assert len(frames["joy"]) == 1 + made["frames"]
    assert len(frames["still"]) == 2
    assert "labels/frames.csv" in made["files"]
    assert there["jaw"] == {"film.mp4", "still.png", "clip.fap", "job.json"}
    read = api.read_stream(out / "jaw" / "clip.fap")
    assert read.fps == 12.0
    np.testing.assert_allclose(read.frames[:, 2], np.linspace(0.0, 300.0, 6), atol=0.5)
    calm, angry = (pictured(out / name / "still.png") for name in ("calm", "still"))
    assert np.abs(calm - angry).mean() > 0.01
    bpy.ops.wm.open_mainfile(filepath=str(out / "joy" / "clip.blend"))
    bpy.context.scene.frame_set(bpy.context.scene.frame_end // 2)
    shown = evaluated_vertices(bpy.data.objects["Risorius Head"])
    assert np.abs(shown - api.default_face().vertices).max() > 2e-3
    assert set(batch(table, out, capsys=capsys)["kept"]) == {"calm", "jaw", "joy", "still"}


@pytest.mark.slow
def test_the_same_row_gives_the_same_bytes_in_whatever_order_and_process(
    table: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    batch(table, tmp_path / "first", capsys=capsys)
    lines = TABLE.splitlines()
    other = table.with_name("other.csv")
    other.write_text("\n".join([lines[0], *reversed(lines[1:])]))
    command = [sys.executable, "-m", "risorius", "batch", str(other), "--out", str(tmp_path / "second")]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    for name in ("joy", "calm", "still", "jaw"):
        first, second = (
            json.loads((tmp_path / part / name / "job.json").read_text())["files"] for part in ("first", "second")
        )
        assert {file for file in first if first[file] != second[file]} <= {"clip.blend"}, name


@pytest.mark.slow
@pytest.mark.parametrize(
    ("column", "value"),
    [
        ("yaw", "30"), ("pitch", "20"), ("roll", "30"), ("lens", "40"), ("distance", "2"), ("light", "0.5"),
        ("light_yaw", "120"), ("skin", "#803010"), ("background", "#ff0000"), ("activation", "3"), ("seed", "4"),
    ],
)  # fmt: skip
def test_each_column_of_the_picture_changes_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], column: str, value: str
) -> None:
    path = tmp_path / "jobs.csv"
    path.write_text(f"id,emotion,outputs,size,{column}\nplain,joy,still,64,\nother,joy,still,64,{value}\n")
    batch(path, tmp_path / "set", capsys=capsys)
    plain, other = (pictured(tmp_path / "set" / name / "still.png") for name in ("plain", "other"))
    assert np.abs(plain - other).max() > 0.02


@pytest.mark.slow
def test_the_background_has_the_colour_that_is_asked_for(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "jobs.csv"
    path.write_text(
        "id,emotion,outputs,size,background,light\na,neutral,still,64,#336699,1\nb,neutral,still,64,#336699,2\n"
    )
    batch(path, tmp_path / "set", capsys=capsys)
    for name in ("a", "b"):
        corner = pictured(tmp_path / "set" / name / "still.png")[-1, 0]
        np.testing.assert_allclose(corner, np.array([0x33, 0x66, 0x99]) / 255.0, atol=1.5 / 255.0)


@pytest.mark.slow
def test_a_bad_row_and_a_job_that_fails_are_told_and_the_rest_is_made(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    cube = tmp_path / "cube.obj"
    cube.write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n")
    path = tmp_path / "jobs.csv"
    path.write_text("id,emotion,head,outputs,size\na,joi,,still,64\nb,joy,cube.obj,still,64\nc,joy,,still,64\n")
    said = batch(path, tmp_path / "set", capsys=capsys, code=1)
    assert said["made"] == ["c"]
    assert list(said["failed"]) == ["b"]
    assert "line 2, column emotion" in said["bad_rows"][0]


@pytest.mark.slow
def test_labels_by_themselves_are_of_the_motion(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "jobs.csv"
    path.write_text("id,emotion,outputs,size,fps,apex,activation\na,joy,labels,64,5,0.2,7\n")
    batch(path, tmp_path / "set", capsys=capsys)
    with (tmp_path / "set" / "a" / "labels" / "faps.csv").open() as file:
        rows = [row for row in csv.DictReader(file) if row["fap"] == "12"]
    achieved = np.array([float(row["achieved"]) for row in rows])
    assert abs(achieved[0]) < 1.0
    assert achieved.max() > 50.0


@pytest.mark.slow
def test_a_face_that_rests_has_no_glb_and_says_so(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "jobs.csv"
    path.write_text("id,emotion,outputs,size\na,neutral,glb,64\n")
    said = batch(path, tmp_path / "set", capsys=capsys, code=1)
    assert "leave glb out, or let the face move" in said["failed"]["a"]


def test_the_still_of_a_stream_is_no_blink_and_no_turn_of_the_head() -> None:
    frames = np.full((5, 68), np.nan)
    frames[:, [11, 18, 19, 47, 48]] = 0.0
    frames[1, [47, 48]] = 9000.0  # a turn of the head, in units of 1e-5 rad
    frames[2, 11] = 300.0
    frames[3, [11, 18, 19]] = 400.0, 1000.0, 1000.0  # more, but in a blink
    shown = stream(api.FapStream(frames, fps=25.0))(25.0)
    assert shown.apex == 2
    only_turns = np.where(np.isin(np.arange(68), (47, 48)), frames, 0.0)
    assert stream(api.FapStream(only_turns, fps=25.0))(25.0).apex == 1


FARM = """
    import sys
    assert not [name for name in sys.modules if name.split(".")[0] == "risorius"]
    import bpy
    bpy.ops.wm.open_mainfile(filepath=sys.argv[1])
    scene = bpy.context.scene
    scene.render.filepath = sys.argv[2]
    scene.frame_start, scene.frame_end = (int(word) for word in sys.argv[3].split("-"))
    bpy.ops.render.render(animation=True)
    assert not [name for name in sys.modules if name.split(".")[0] == "risorius"]
"""


@pytest.mark.slow
def test_a_farm_renders_a_clip_without_risorius(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """As a task of a farm does: open the .blend, set frames and where they go, render; nothing else."""
    path = tmp_path / "jobs.csv"
    path.write_text("id,emotion,outputs,size,apex,yaw\njoy,joy,blend still,64,0.1,20\n")
    batch(path, tmp_path / "set", capsys=capsys)
    clip, pictures = tmp_path / "set" / "joy" / "clip.blend", {}
    bpy.ops.wm.open_mainfile(filepath=str(clip))
    apex = int((0.2 + api.load_timings()["natural"].onset + 0.1) * 25.0) + bpy.context.scene.frame_start
    for frame in (1, apex):
        name = str(tmp_path / "farm" / "####")
        command = [sys.executable, "-I", "-c", textwrap.dedent(FARM), str(clip), name, f"{frame}-{frame}"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        pictures[frame] = pictured(tmp_path / "farm" / f"{frame:04d}.png")
    still = pictured(tmp_path / "set" / "joy" / "still.png")
    finer, other = (float(np.abs(pictures[frame] - still).mean()) for frame in (apex, 1))
    assert finer < 0.015  # the still is drawn finer
    assert other > 1.4 * finer
    assert np.abs(pictures[1] - pictures[apex]).max() > 0.2
