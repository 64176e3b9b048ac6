"""The command line's jobs, and that what they bake plays without Risorius."""

from __future__ import annotations

import json
import subprocess
import sys
import textwrap
from functools import partial
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest
import risorius.api as api
from risorius import cli
from risorius.errors import FormatError, ModelError, ParameterError, SceneError
from risorius.progress import run
from risorius.scene import mesh as meshes
from risorius.scene.bake.performance import PAUSE, cues_of
from risorius.scene.jobs import words
from risorius.scene.jobs.inputs import Input
from risorius.scene.jobs.sheet import apex_frame
from risorius.scene.jobs.subjects import subject
from risorius.scene.pictures.look import Engine, Look

REPLAY = """
    import sys
    assert not [name for name in sys.modules if name.split(".")[0] == "risorius"]
    import bpy, numpy as np
    bpy.ops.wm.open_mainfile(filepath=sys.argv[1])
    obj = bpy.data.objects["Risorius Head"]
    frames = []
    for frame in map(int, sys.argv[3:]):
        bpy.context.scene.frame_set(frame)
        mesh = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
        flat = np.empty(3 * len(mesh.vertices), dtype=np.float32)
        mesh.vertices.foreach_get("co", flat)
        frames.append(flat)
    np.save(sys.argv[2], np.array(frames))
    assert not [name for name in sys.modules if name.split(".")[0] == "risorius"]
"""


def played(blend: Path, frames: list[int]) -> np.ndarray:
    """(frames, V, 3) that a fresh Blender without Risorius shows."""
    out = blend.with_suffix(".npy")
    arguments = [sys.executable, "-c", textwrap.dedent(REPLAY), str(blend), str(out), *map(str, frames)]
    done = subprocess.run(arguments, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return np.load(out).reshape(len(frames), -1, 3)


@pytest.mark.slow
@pytest.mark.smoke
def test_a_baked_file_plays_without_risorius(tmp_path: Path) -> None:
    blend = tmp_path / "faces.blend"
    made = dict(words.bake_file(blend, words=["joy", "fear"], fps=25.0))
    assert made["shape_keys"] == 2
    cues = cues_of(["joy", "fear"])
    between = int(25.0 * (cues[1].start - 0.5 * PAUSE)) + 1
    shown = played(blend, [*(apex_frame(cue, 25.0) for cue in cues), 1, between, 500])
    face = api.default_face()
    for resting in shown[2:]:
        np.testing.assert_allclose(resting, face.vertices, atol=1e-6)
    for positions, cue in zip(shown[:2], cues, strict=True):
        pose = face.pose(cue.profile.frame(), emotion=cue.profile.weights)
        np.testing.assert_allclose(positions, pose.positions, atol=2e-6)


@pytest.mark.slow
def test_a_baked_motion_plays_without_risorius(tmp_path: Path) -> None:
    blend = tmp_path / "motion.blend"
    made = dict(words.bake_file(blend, words=["anger"], fps=12.0, dynamic=True))
    assert made["error_mm"] <= 0.1
    cues = cues_of(["anger"])
    end = max(cue.start + cue.duration for cue in cues)
    rest = api.Cue(api.expression("neutral"), start=end, onset=0.0, apex=PAUSE, offset=0.0)
    positions = np.array(list(api.default_face().performance([*cues, rest], 12.0)))
    count = len(api.sequence(cues, fps=12.0))
    numbers = [1, count // 3, count // 2, count - 3]
    shown = played(blend, [1 + number for number in numbers])
    assert np.linalg.norm(shown - positions[numbers], axis=2).max() <= 1.01e-4


@pytest.mark.slow
def test_the_demo_leaves_film_file_and_sheet(tmp_path: Path) -> None:
    steps: list[Any] = []
    look = Look(Engine.WORKBENCH, 64, 64)
    load = partial(subject, Input(fps=4.0))
    made = dict(run(words._demo(tmp_path / "out", load, cues_of(["joy", "sad"]), look), steps.append))
    assert {path.name for path in (tmp_path / "out").iterdir()} == {"risorius.blend", "risorius.mp4", "risorius.png"}
    assert made["frames"] == len(api.sequence(cues_of(["joy", "sad"]), fps=4.0)) + 1
    fractions = [step.fraction for step in steps]
    assert len(fractions) > 10
    assert fractions == sorted(fractions)


def test_a_contact_sheet_keeps_clear_of_blinks() -> None:
    (cue,) = cues_of(["joy"])
    end = apex_frame(cue, 25.0)
    closure = np.zeros(80)
    assert apex_frame(cue, 25.0, closure=closure) == end
    closure[end - 4 :] = 0.5  # frames count from 1: the last with open eyes is the fourth before the end
    assert apex_frame(cue, 25.0, closure=closure) == end - 4
    assert apex_frame(cue, 25.0, closure=np.ones(80)) == end


@pytest.mark.slow
def test_the_demos_face_blinks_looks_about_and_is_never_still(tmp_path: Path) -> None:
    fps, look = 12.5, Look(Engine.WORKBENCH, 16, 16)
    run(words._demo(tmp_path, partial(subject, Input(fps=fps)), cues_of(["joy"]), look), lambda step: None)
    (cue,) = cues_of(["joy"])
    head, face = bpy.data.objects["Risorius Head"], api.default_face()
    begin, end = 1 + int(np.ceil((cue.start + cue.onset) * fps)), apex_frame(cue, fps)
    shown = [shown_at(head, frame) for frame in range(1, bpy.context.scene.frame_end + 1)]
    nose = np.array([positions[face.points["9.3"].vertices[0]] for positions in shown[begin - 1 : end]])
    assert np.linalg.norm(np.diff(nose, axis=0), axis=1).min() > 2e-5
    upper, lower = (face.points[name].vertices[0] for name in ("3.1", "3.3"))
    gaps = np.array([np.linalg.norm(positions[upper] - positions[lower]) for positions in shown])
    assert gaps.min() < 0.3 * gaps[0] < gaps[end - 1]
    gaze = [face.measure(positions)[[22, 24]] for positions in shown[:end:4]]
    assert np.ptp(gaze, axis=0).max() > 1000.0  # units of 0.00001 rad


def shown_at(head: Any, frame: int) -> np.ndarray:
    """(V, 3) what Blender shows of a head at a frame."""
    bpy.context.scene.frame_set(frame)
    return meshes.evaluated_vertices(head, bpy.context.evaluated_depsgraph_get())


@pytest.mark.slow
@pytest.mark.parametrize("name", ["ict", "makehuman"])
def test_other_heads_from_files(shared: Path, tmp_path: Path, name: str) -> None:
    mesh, points = shared / "heads" / f"{name}.npz", shared / "heads" / f"{name}.fp.json"
    blend = tmp_path / "first.blend"
    words.bake_file(blend, mesh=mesh, points=points, words=["joy"])
    obj = bpy.data.objects[name]
    block = obj.data.shape_keys.key_blocks["joy"]
    moved = np.linalg.norm(meshes.key_vertices(block) - meshes.rest_vertices(obj.data), axis=1)
    assert 0.002 < moved.max() < 0.03
    again = tmp_path / "again.blend"
    words.bake_file(again, mesh=blend, words=["joy"])
    block = bpy.data.objects[name].data.shape_keys.key_blocks["joy"]
    assert len(bpy.data.objects[name].data.shape_keys.key_blocks) == 2


def test_wrong_requests_are_refused_and_nothing_is_written(tmp_path: Path) -> None:
    out = tmp_path / "x.blend"
    for options, error, match in (
        ({"words": ["angryy"]}, ParameterError, "emotion word"),
        ({"words": []}, ParameterError, "words"),
        ({"words": ["joy"], "fps": 0.0}, ParameterError, "fps"),
        ({"words": ["joy"], "mesh": tmp_path / "none.npz"}, FormatError, "none.npz"),
        ({"words": ["joy"], "mesh": tmp_path / "none.blend"}, FormatError, "does not exist"),
        ({"words": ["joy"], "mesh": tmp_path / "none.fbx"}, FormatError, "not a .npz, .obj"),
    ):
        with pytest.raises(error, match=match):
            words.bake_file(out, **options)
        assert not out.exists()
    with pytest.raises(ParameterError, match="engine"):
        words.demo(tmp_path, engine="POVRAY")
    with pytest.raises(SceneError, match="cannot be written"):
        words.render_film(tmp_path, words=["joy"])


@pytest.mark.slow
def test_a_mesh_without_points_and_without_a_face_is_refused(tmp_path: Path) -> None:
    obj = tmp_path / "triangle.obj"
    obj.write_text("v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n")
    with pytest.raises(ModelError, match=r"triangle: .*face"):
        run(subject(Input(obj)))


@pytest.mark.slow
@pytest.mark.smoke
def test_the_command_line_bakes(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "faces.blend"
    assert cli.main(["bake", "joy", "--out", str(out), "--json"]) == 0
    printed = capsys.readouterr().out
    assert json.loads(printed[printed.index("{") :])["shape_keys"] == 1
    assert out.is_file()
