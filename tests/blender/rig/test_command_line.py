"""The command line bakes words and streams onto the shape keys that a face in a .blend already has."""

from __future__ import annotations

import json
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import bpy
import numpy as np
import pytest
import risorius.api as api
from risorius import cli
from risorius.scene.mesh import evaluated_vertices, key_vertices, rest_vertices

#: Runs a verb with --json, which must succeed, and gives the object that it prints.
RunJson = Callable[..., Any]


@pytest.fixture(scope="module")
def shapes() -> dict[str, np.ndarray]:
    """The 52 ARKit shapes of the default head."""
    return dict(api.arkit_shapes(api.default_face()))


@pytest.fixture
def arkit(head: Any, shapes: dict[str, np.ndarray], tmp_path: Path) -> Path:
    """A character with the default head's ARKit shapes as its own keys, in a saved .blend at 24 frames per second."""
    head.shape_key_add(name="Basis")
    for name, positions in shapes.items():
        key = head.shape_key_add(name=name, from_mix=False)
        key.value = 0.0
        key.data.foreach_set("co", positions.astype(np.float32).ravel())
    head.data.shape_keys.key_blocks["tongueOut"].mute = True
    bpy.context.scene.render.fps = 24
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "arkit.blend"), check_existing=False)
    return tmp_path / "arkit.blend"


@pytest.fixture
def run_json(capsys: pytest.CaptureFixture[str]) -> RunJson:
    def run(*arguments: object) -> Any:
        assert cli.main([*map(str, arguments), "--json"]) == 0
        printed = capsys.readouterr().out
        return json.loads(printed[printed.index("{") :])

    return run


def keys_in(path: Path) -> dict[str, np.ndarray]:
    """Names and positions of the keys of the only mesh of a .blend, which is opened."""
    bpy.ops.wm.open_mainfile(filepath=str(path))
    (face,) = (obj for obj in bpy.data.objects if obj.type == "MESH")
    return {block.name: key_vertices(block) for block in face.data.shape_keys.key_blocks}


@pytest.mark.slow
def test_words_become_clips_on_the_keys_and_no_key_is_added(arkit: Path, run_json: RunJson) -> None:
    before = keys_in(arkit)
    said = run_json("bake", "joy", "anger", "joy", "--mesh", arkit, "--onto", "keys", "--out", arkit.parent / "o.blend")
    after = keys_in(arkit.parent / "o.blend")
    assert list(after) == list(before)
    for name, positions in before.items():
        np.testing.assert_array_equal(after[name], positions)
    assert [clip["clip"] for clip in said["clips"]] == ["joy", "anger", "joy 2"]
    assert said["shape_keys"] == 0
    (face,) = (obj for obj in bpy.data.objects if obj.type == "MESH")
    blocks = face.data.shape_keys.key_blocks
    ends = [clip["frames"] for clip in said["clips"]]
    assert all(first == int(first) and last == int(last) for first, last in ends)
    assert all(last < first for (_, last), (first, _) in pairwise(ends))
    for clip in said["clips"]:
        bpy.context.scene.frame_set(int(clip["frames"][0]) + 20)
        shown = {block.name: block.value for block in blocks if abs(block.value) > 1e-6}
        assert shown == pytest.approx({name: value for name, value in clip["controls"].items() if abs(value) > 1e-6})
    bpy.context.scene.frame_set(int(ends[0][1]) + 2)
    assert max(block.value for block in blocks) == pytest.approx(0.0, abs=1e-6)


@pytest.mark.slow
def test_what_is_told_of_a_clip_is_what_the_file_shows(arkit: Path, run_json: RunJson) -> None:
    out = arkit.parent / "o.blend"
    options = ["--activation", "5", "--timing", "spontaneous", "--apex", "1", "--symmetric"]
    (clip,) = run_json("bake", "joy", "--mesh", arkit, "--onto", "keys", "--out", out, *options)["clips"]
    timing, profile = api.load_timings()["spontaneous"], api.expression("joy", activation=5.0)
    first, last = clip["frames"]
    assert last - first == pytest.approx((timing.onset + 1.0 + timing.offset) * 24.0, abs=1.0)
    bpy.ops.wm.open_mainfile(filepath=str(out))
    (obj,) = (obj for obj in bpy.data.objects if obj.type == "MESH")
    bpy.context.scene.frame_set(int(first + 24.0 * timing.onset) + 5)
    face = api.default_face()
    shown, pose = evaluated_vertices(obj), face.pose(profile.frame(), emotion=profile.weights)
    assert clip["explained"] > 0.7
    measured = face.measure(shown)
    for name in ("raise_l_cornerlip", "stretch_r_cornerlip", "raise_l_m_eyebrow"):
        index = api.fap(name).number - 1
        told = clip["faps"][name]
        assert told["requested"] == pytest.approx(timing.peak * profile.frame()[index])
        assert told["muscles"] == pytest.approx(timing.peak * pose.achieved[index], abs=15.0)
        assert told["achieved"] == pytest.approx(measured[index], abs=15.0)
    assert clip["left_alone"] == {"tongueOut": "is muted: turn it on in the list of shape keys"}
    for left, value in clip["controls"].items():
        if left.endswith("Left"):
            assert clip["controls"][left.removesuffix("Left") + "Right"] == pytest.approx(value)


@pytest.mark.slow
def test_a_stream_is_played_on_the_keys(arkit: Path, run_json: RunJson, shapes: dict[str, np.ndarray]) -> None:
    frames = np.full((12, 68), np.nan)
    frames[:, 2] = np.linspace(0.0, 300.0, 12)  # open_jaw
    api.write_fap(arkit.parent / "jaw.fap", api.FapStream(frames, fps=24.0, name="jaw"))
    out = arkit.parent / "o.blend"
    (clip,) = run_json("fap", "play", arkit.parent / "jaw.fap", out, "--mesh", arkit, "--onto", "keys")["clips"]
    assert (clip["clip"], clip["frames"]) == ("jaw", [1.0, 12.0])
    assert clip["controls"]["jawOpen"] == max(clip["controls"].values())
    assert clip["faps"]["open_jaw"]["requested"] == pytest.approx(300.0 * clip["peak_step"] / 11.0, abs=1.0)
    bpy.ops.wm.open_mainfile(filepath=str(out))
    (obj,) = (obj for obj in bpy.data.objects if obj.type == "MESH")
    assert set(shapes) == {block.name for block in obj.data.shape_keys.key_blocks[1:]}
    opening = []
    for frame in (1, 6, 12):
        bpy.context.scene.frame_set(frame)
        opening.append(float(np.abs(evaluated_vertices(obj) - rest_vertices(obj.data)).max()))
    assert opening[0] < opening[1] < opening[2]


@pytest.mark.slow
def test_a_recording_of_weights_comes_back_as_weights_of_the_same_keys(arkit: Path, run_json: RunJson) -> None:
    """Live Link Face records jawOpen and a blink; the keys that carry it are those."""
    rows = ["Timecode,BlendShapeCount,jawOpen,eyeBlinkLeft,eyeBlinkRight"]
    rows += [f"00:00:00:{number:02d}.000,3,{number / 11.0:.4f},0,0" for number in range(12)]
    (arkit.parent / "take.csv").write_text("\n".join(rows))
    out = arkit.parent / "o.blend"
    (clip,) = run_json("fap", "play", arkit.parent / "take.csv", out, "--mesh", arkit, "--onto", "keys")["clips"]
    assert max(clip["controls"], key=clip["controls"].get) == "jawOpen"
    assert clip["controls"]["jawOpen"] > 0.5


@pytest.mark.slow
def test_a_film_shows_what_was_baked_onto_the_keys(arkit: Path, run_json: RunJson) -> None:
    frames = np.full((12, 68), np.nan)
    frames[:, 2] = np.linspace(0.0, 400.0, 12)
    api.write_fap(arkit.parent / "jaw.fap", api.FapStream(frames, fps=24.0, name="jaw"))
    out = arkit.parent / "o.mp4"
    said = run_json("fap", "play", arkit.parent / "jaw.fap", out, "--mesh", arkit, "--onto", "keys")
    assert said["frames"] == 12
    assert out.stat().st_size > 1000
    controls = said["clips"][0]["controls"]
    assert controls["jawOpen"] == max(controls.values())


def test_a_face_without_keys_is_refused_and_nothing_is_written(
    head: Any, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "bare.blend"), check_existing=False)
    out = tmp_path / "o.blend"
    assert cli.main(["bake", "joy", "--mesh", str(tmp_path / "bare.blend"), "--onto", "keys", "--out", str(out)]) == 1
    assert "has no controls" in capsys.readouterr().err
    assert not out.exists()


@pytest.mark.slow
def test_words_and_streams_are_baked_onto_bones(rigged: SimpleNamespace, tmp_path: Path, run_json: RunJson) -> None:
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "bones.blend"), check_existing=False)
    said = run_json("bake", "joy", "--mesh", tmp_path / "bones.blend", "--onto", "bones", "--out", tmp_path / "o.blend")
    (clip,) = said["clips"]
    assert {name.rsplit(" ", 2)[0] for name in clip["controls"]} >= {"corner.L", "corner.R"}
    assert clip["left_alone"] == {"skull": "moves the whole head"}
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "o.blend"))
    bpy.context.scene.frame_set(int(clip["frames"][0]) + 15)
    bones = bpy.data.objects["Rig"].pose.bones
    for name, value in clip["controls"].items():
        bone, kind, axis = name.rsplit(" ", 2)
        if kind == "Location":
            assert bones[bone].location["XYZ".index(axis)] == pytest.approx(value, abs=1e-5)
    frames = np.full((12, 68), np.nan)
    frames[:, 2] = np.linspace(0.0, 300.0, 12)
    api.write_fap(tmp_path / "jaw.fap", api.FapStream(frames, fps=24.0, name="jaw"))
    mesh = ["--mesh", tmp_path / "bones.blend", "--onto", "bones"]
    (clip,) = run_json("fap", "play", tmp_path / "jaw.fap", tmp_path / "p.blend", *mesh)["clips"]
    assert any(name.startswith("jaw ") for name in clip["controls"])
    assert clip["frames"] == [1.0, 12.0]
