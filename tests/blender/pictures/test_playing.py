"""Playing a FAP stream on a face: what the .blend moves is what the API simulates."""

from __future__ import annotations

import json
from pathlib import Path

import bpy
import numpy as np
import pytest
import risorius.api as api
from risorius import cli
from risorius.errors import ParameterError, SceneError
from risorius.scene.bake.motion import SIMULATED, FapMotion
from risorius.scene.jobs.labelling import Labels
from risorius.scene.jobs.playing import play_stream
from risorius.scene.mesh import evaluated_vertices


@pytest.fixture
def stream() -> api.FapStream:
    """Six frames at 12 per second: the jaw opens, then a viseme; brows rise."""
    frames = np.full((6, 68), np.nan)
    frames[:, 30] = frames[:, 31] = np.linspace(0.0, 120.0, 6)
    frames[:3, 2] = np.linspace(0.0, 200.0, 3)
    return api.FapStream(frames, fps=12.0, name="a test", visemes={4: api.VisemeField(10)})


@pytest.mark.slow
@pytest.mark.parametrize("inertia", [False, True])
def test_a_stream_is_baked_as_the_api_plays_it(inertia: bool, stream: api.FapStream, tmp_path: Path) -> None:
    made = play_stream(tmp_path / "face.blend", stream, inertia=inertia)
    bpy.ops.wm.open_mainfile(filepath=str(made.blend))
    scene = bpy.context.scene
    assert scene.render.fps / scene.render.fps_base == pytest.approx(12.0)
    assert scene.frame_end - scene.frame_start == 5
    face = api.default_face()
    shown = list(api.play(face, stream, inertia=inertia))
    clip = face.simulate(stream.expanded(), fps=12.0, integrator="reduced" if inertia else "balance")
    np.testing.assert_allclose(shown, clip.positions, atol=1e-12)
    obj = bpy.data.objects["Risorius Head"]
    for index in (0, 2, 5):
        scene.frame_set(scene.frame_start + index)
        seen = evaluated_vertices(obj)
        assert np.abs(seen - clip.positions[index]).max() < 2.0e-4
    assert np.abs(clip.positions[5] - clip.positions[0]).max() > 1.0e-3


def test_labels_of_a_blend_are_refused(stream: api.FapStream, tmp_path: Path) -> None:
    with pytest.raises(ParameterError, match="labels need a film"):
        play_stream(tmp_path / "face.blend", stream, labels=Labels(tmp_path / "labels"))
    assert not list(tmp_path.iterdir())


@pytest.mark.slow
def test_an_unknown_frame_is_bridged_and_said(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    rows = ["timestamp,jawOpen", "0.00,0.6", "0.04,0.6", "0.08,", "0.12,0.6"]
    (tmp_path / "take.csv").write_text("\n".join(rows))
    assert cli.main(["fap", "play", str(tmp_path / "take.csv"), str(tmp_path / "a.blend"), "--json"]) == 0
    said = capsys.readouterr()
    line = "1 unknown frame (2): bridged from those around"
    assert json.loads(said.out[said.out.index("{") :])["assumed"] == [line]
    assert f"note: take: {line}" in said.err
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "a.blend"))
    scene, obj = bpy.context.scene, bpy.data.objects["Risorius Head"]
    shown = []
    for frame in range(scene.frame_start, scene.frame_start + 4):
        scene.frame_set(frame)
        shown.append(evaluated_vertices(obj))
    assert max(np.abs(other - shown[0]).max() for other in shown) < 1e-4


@pytest.mark.slow
def test_the_verb_plays_a_bitstream(stream: api.FapStream, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    api.write_fba(tmp_path / "a.fba", stream)
    assert cli.main(["fap", "play", str(tmp_path / "a.fba"), str(tmp_path / "a.blend"), "--json"]) == 0
    said = capsys.readouterr()
    assert json.loads(said.out[said.out.index("{") :])["shape_keys"] > 0
    assert (tmp_path / "a.blend").is_file()
    assert "%" in said.err


def test_an_unwritable_place_is_refused_before_the_work(stream: api.FapStream, tmp_path: Path) -> None:
    with pytest.raises(SceneError, match="cannot be written"):
        play_stream(tmp_path, stream)


def test_inertia_is_simulated_however_long_it_takes() -> None:
    face, frames = api.default_face(), np.zeros((SIMULATED + 1, 68))
    assert FapMotion(frames[:-1]).between(face, "natural") is None
    assert FapMotion(frames).between(face, "natural") is not None
    assert FapMotion(frames, inertia=True).between(face, "natural") is None


@pytest.mark.slow
@pytest.mark.parametrize(("options", "done"), [([], "each frame as it is"), (["--inertia"], "with the inertia")])
def test_the_verb_says_how_it_was_played(
    options: list[str], done: str, stream: api.FapStream, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    api.write_fap(tmp_path / "a.fap", stream)
    call = ["fap", "play", str(tmp_path / "a.fap"), str(tmp_path / "a.blend"), *options]
    assert cli.main(call) == 0
    assert f"motion: {done}" in capsys.readouterr().out
    assert cli.main([*call, "--json"]) == 0
    said = capsys.readouterr().out
    assert json.loads(said[said.index("{") :])["inertia"] is bool(options)
