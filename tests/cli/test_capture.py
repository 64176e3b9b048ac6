"""The verbs import and export: what they write and print, and their exit codes."""

from __future__ import annotations

import gzip
import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import risorius.api as api
from risorius.cli import main


@pytest.fixture
def recording(tmp_path: Path) -> Path:
    """Five frames of ARKit blend shapes, the third without a face."""
    rows = [f"{i * 0.04:.3f},{'' if i == 2 else 0.1 * i}" for i in range(5)]
    path = tmp_path / "take.csv"
    path.write_text("\n".join(["timestamp,jawOpen", *rows]))
    return path


def run(capsys: pytest.CaptureFixture[str], *arguments: object) -> Any:
    """Run one verb with --json, which must succeed."""
    assert main([*map(str, arguments), "--json"]) == 0
    return json.loads(capsys.readouterr().out)


def test_import_writes_the_stream_of_the_api(
    recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    said = run(capsys, "import", recording, "--out", tmp_path / "a.fap")
    assert (said["name"], said["fps"], said["frames"], said["unknown_frames"]) == ("take", 25.0, 5, 1)
    assert 3 in said["faps"]
    written, read = api.read_fap(tmp_path / "a.fap"), api.read_capture(recording)
    np.testing.assert_array_equal(written.mask, read.mask)
    np.testing.assert_allclose(written.frames, read.frames, atol=0.5)


def test_import_at_another_rate_and_for_people(recording: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(capsys, "import", recording, "--fps", 50)["frames"] == 9
    assert main(["import", str(recording)]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].startswith("take: 5 frames at 25 per second")
    assert lines[0].endswith("1 frames unknown")
    assert any(line.startswith("F3 ") for line in lines)


def test_export_csv_of_a_fap_file_and_of_a_recording(
    recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    run(capsys, "import", recording, "--out", tmp_path / "a.fap")
    said = run(capsys, "export", "csv", tmp_path / "a.fap", "--out", tmp_path / "a.csv")
    assert said["frames"] == 5
    run(capsys, "export", "csv", recording, "--out", tmp_path / "b.csv")
    for name in ("a.csv", "b.csv"):
        back = api.read_capture(tmp_path / name)
        np.testing.assert_array_equal(back.mask, api.read_fap(tmp_path / "a.fap").mask)


@pytest.mark.slow
def test_export_shapes_as_arrays(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "own.toml").write_text("[keys.open]\nshapes = { jawOpen = 1 }\n")
    said = run(capsys, "export", "shapes", "--names", tmp_path / "own.toml", "--out", tmp_path / "a.npz")
    assert said["keys"] == ["open"]
    data = np.load(tmp_path / "a.npz")
    face = api.default_face()
    assert list(data["names"]) == ["open"]
    expected = api.arkit_shapes(face, tmp_path / "own.toml")["open"] - face.vertices
    np.testing.assert_allclose(data["displacement"][0], expected, atol=1e-7)


@pytest.mark.parametrize(
    ("arguments", "code", "named"),
    [
        (["import"], 2, "file"),
        (["import", "a.csv", "--kind", "dance"], 2, "dance"),
        (["import", "a.csv", "--aspect", "0:0"], 2, "aspect"),
        (["import", "gone.csv"], 1, "gone.csv"),
        (["export", "csv", "--out", "a.csv"], 2, "one input file"),
        (["export", "csv", "gone.fap", "--out", "a.csv"], 1, "gone.fap"),
        (["export", "shapes", "a.fap", "--out", "a.npz"], 2, "--mesh"),
        (["export", "shapes", "--out", "a.fbx"], 2, ".npz"),
        (["export", "shapes", "--names", "klingon", "--out", "a.npz"], 1, "oculus_visemes"),
    ],
)
def test_errors_name_the_thing(arguments: list[str], code: int, named: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(arguments) == code
    said = capsys.readouterr()
    assert said.out == ""
    assert named in said.err


def test_a_damaged_recording_names_line_and_column(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "a.csv").write_text("timestamp,jawOpen\n0,0.1\n0.04,wide\n")
    assert main(["import", str(tmp_path / "a.csv")]) == 1
    assert "line 3, column jawOpen: must be a number, but it is 'wide'" in capsys.readouterr().err


def test_shapes_that_need_blender_say_so_without_it(tmp_path: Path) -> None:
    code = "import sys; sys.modules['bpy'] = None; from risorius.cli import main; sys.exit(main(sys.argv[1:]))"
    command = [sys.executable, "-c", code, "export", "shapes", "--out", "a.blend"]
    done = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path, check=False)
    assert done.returncode == 1
    assert "pip install bpy" in done.stderr
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("verb", ["import", "recognise", "measure"])
def test_a_compressed_file_is_told_by_every_verb(verb: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "take.csv.gz").write_bytes(gzip.compress(b"frame,jawOpen\n0,0\n"))
    assert main([verb, str(tmp_path / "take.csv.gz")]) == 1
    assert "it seems to be a compressed file (unpack it)" in capsys.readouterr().err
