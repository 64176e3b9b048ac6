"""Whose face a job takes: from a file of several meshes, with the file's own units, frame rate, scene and animation."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest
import risorius.api as api
from mathutils import Matrix
from risorius import cli
from risorius.errors import FormatError, ModelError
from risorius.progress import run
from risorius.scene.jobs import words
from risorius.scene.jobs.inputs import Input
from risorius.scene.jobs.playing import play_stream
from risorius.scene.jobs.subjects import subject
from risorius.scene.mesh import key_vertices, rest_vertices
from risorius.scene.points.kept import forget_points


def grid(name: str, *, size: float = 0.2, steps: int = 90) -> Any:
    """A flat mesh that is denser than a face."""
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=steps, y_subdivisions=steps, size=size, location=(0.0, 0.05, 1.0))
    bpy.context.object.name = name
    return bpy.context.object


@pytest.fixture
def character(head: Any, tmp_path: Path) -> Path:
    """A .blend in centimetres and at 30 frames per second: a turning head without points, denser hair, a lamp."""
    scene = bpy.context.scene
    scene.unit_settings.scale_length = 0.01
    scene.render.fps, scene.frame_start, scene.frame_end = 30, 11, 99
    head.name = "Lena"
    head.scale = (100.0,) * 3
    forget_points(head)
    root = bpy.data.objects.new("Root", None)
    scene.collection.objects.link(root)
    root.rotation_euler = (0.0, 0.0, 0.3)
    root.keyframe_insert("rotation_euler", frame=11)
    head.parent = root
    grid("Hair")
    scene.collection.objects.link(bpy.data.objects.new("Lamp", bpy.data.lights.new("Lamp", "POINT")))
    scene.collection.children.link(bpy.data.collections.new("Props"))
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "character.blend"))
    return tmp_path / "character.blend"


@pytest.mark.slow
def test_a_characters_file_keeps_its_units_rate_scene_and_animation(character: Path, tmp_path: Path) -> None:
    made = words.bake_file(tmp_path / "out.blend", mesh=character, words=["joy"])
    assert made.face == "Lena"
    assert any("2 meshes" in remark and "--object" in remark for remark in made.remarks)
    bpy.ops.wm.open_mainfile(filepath=str(made.blend))
    scene, face = bpy.context.scene, bpy.data.objects["Lena"]
    assert scene.unit_settings.scale_length == pytest.approx(0.01)
    assert (scene.render.fps, scene.render.fps_base) == (30, 1.0)
    assert (scene.frame_start, scene.frame_end) == (11, 99)
    assert {obj.name for obj in scene.objects} == {"Lena", "Root", "Hair", "Lamp"}
    assert "Props" in scene.collection.children
    assert scene.camera is None
    assert scene.world is None
    assert face.parent.animation_data.action is not None
    joy = face.data.shape_keys.key_blocks["joy"]
    moved = np.linalg.norm(key_vertices(joy) - rest_vertices(face.data), axis=1).max()
    assert 0.002 < moved < 0.03  # metres: the object is scaled by 100, the scene is in centimetres
    profile = api.expression("joy")
    pose = api.default_face().pose(profile.frame(), emotion=profile.weights)
    asked = np.linalg.norm(pose.positions - api.default_face().vertices, axis=1).max()
    assert moved == pytest.approx(asked, rel=0.3)


@pytest.mark.slow
def test_another_rate_that_is_asked_for_is_taken(character: Path, tmp_path: Path) -> None:
    words.bake_file(tmp_path / "out.blend", mesh=character, words=["joy"], object_name="Lena", fps=12.5)
    render = bpy.context.scene.render
    assert render.fps / render.fps_base == pytest.approx(12.5)


@pytest.mark.slow
def test_a_stream_plays_at_the_files_rate(character: Path, tmp_path: Path) -> None:
    frames = np.zeros((13, 68))
    frames[:, 2] = np.linspace(0.0, 200.0, 13)
    stream = api.FapStream(frames, fps=12.0, name="take")
    play_stream(tmp_path / "out.blend", stream, mesh=character, object_name="Lena")
    scene = bpy.context.scene
    assert scene.render.fps == 30
    (action,) = (action for action in bpy.data.actions if action.get("risorius_clip") == "take")
    assert tuple(action.frame_range) == (11.0, 41.0)  # one second


@pytest.mark.slow
def test_a_scene_too_short_for_a_bake_stays_so_and_is_said_to_be(character: Path, tmp_path: Path) -> None:
    made = words.bake_file(tmp_path / "out.blend", mesh=character, words=["joy", "fear"], object_name="Lena")
    assert bpy.context.scene.frame_end == 99
    assert any("ends at frame 99" in remark for remark in made.remarks)


def test_the_named_object_is_taken_though_it_is_less_dense(head: Any, tmp_path: Path) -> None:
    other = head.copy()
    other.data, other.name = head.data.copy(), "Twin"
    bpy.context.collection.objects.link(other)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "two.blend"))
    chosen = run(subject(Input(tmp_path / "two.blend", object_name="Twin")))
    assert chosen.obj.name == "Twin"
    assert chosen.remarks == ()
    with pytest.raises(FormatError, match="no mesh named Nobody: name one of Risorius Head, Twin"):
        run(subject(Input(tmp_path / "two.blend", object_name="Nobody")))


def test_a_face_with_points_is_taken_before_any_other(head: Any, tmp_path: Path) -> None:
    grid("Hair")
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "two.blend"))
    chosen = run(subject(Input(tmp_path / "two.blend")))
    assert chosen.obj.name == "Risorius Head"
    assert "has feature points" in chosen.remarks[0]


@pytest.mark.slow
def test_meshes_without_any_face_are_all_named(tmp_path: Path) -> None:
    grid("Hair", steps=4)
    grid("Wall", steps=5)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "none.blend"))
    with pytest.raises(ModelError, match=r"any of its meshes \(Wall, Hair\).*--object"):
        run(subject(Input(tmp_path / "none.blend")))


@pytest.mark.slow
def test_a_gltf_of_several_meshes_is_searched(head: Any, tmp_path: Path) -> None:
    forget_points(head)
    grid("Hair")
    bpy.ops.export_scene.gltf(filepath=str(tmp_path / "two.glb"), export_format="GLB")
    chosen = run(subject(Input(tmp_path / "two.glb")))
    assert chosen.obj.name == "Risorius Head"
    assert not chosen.in_own_scene


def test_a_file_of_another_blender_is_refused(tmp_path: Path) -> None:
    (tmp_path / "broken.blend").write_bytes(b"no blend")
    with pytest.raises(FormatError, match=r"broken\.blend.*cannot be read"):
        run(subject(Input(tmp_path / "broken.blend")))


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--object", "Face"], "--object needs --mesh"),
        (["--mesh", "a.obj", "--object", "Face"], "--object needs a .blend"),
    ],
)
def test_an_object_is_named_where_there_are_objects(
    options: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert cli.main(["bake", "joy", "--out", "a.blend", *options]) == 2
    assert said in capsys.readouterr().err


@pytest.mark.slow
def test_what_belongs_to_the_face_follows_it(head: Any, tmp_path: Path) -> None:
    """A cap named Eyebrows on the brow gets the expression's key, too; a far wall does not."""
    vertices, polygons = rest_vertices(head.data), [tuple(p.vertices) for p in head.data.polygons]
    high = (vertices[:, 2] > np.quantile(vertices[:, 2], 0.55)) & (vertices[:, 1] < np.quantile(vertices[:, 1], 0.15))
    number = np.cumsum(high) - 1
    mesh = bpy.data.meshes.new("Eyebrows")
    own = [[int(number[v]) for v in p] for p in polygons if high[list(p)].all()]
    mesh.from_pydata((vertices[high] + [0.0, -0.002, 0.0]).tolist(), [], own)
    bpy.context.collection.objects.link(bpy.data.objects.new("Eyebrows", mesh))
    grid("Wall", size=4.0, steps=3)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "brows.blend"))
    words.bake_file(tmp_path / "out.blend", mesh=tmp_path / "brows.blend", words=["surprise"])
    assert "surprise" in bpy.data.objects["Eyebrows"].data.shape_keys.key_blocks
    assert bpy.data.objects["Wall"].data.shape_keys is None


@pytest.mark.slow
def test_what_follows_the_face_in_a_file_is_taken_along(character: Path, tmp_path: Path) -> None:
    bpy.ops.wm.open_mainfile(filepath=str(character))
    face = bpy.data.objects["Lena"]
    grid("Eyelashes", steps=4)
    lashes = bpy.data.objects["Eyelashes"]
    lashes.data.transform(Matrix.Scale(0.02, 4))
    lashes.parent, lashes.location = face, (0.032, -0.085, 0.04)
    bpy.ops.wm.save_mainfile()
    made = words.bake_file(tmp_path / "out.blend", mesh=character, words=["surprise"], object_name="Lena")
    assert "the face is Lena; these follow it: Eyelashes, Hair" in made.remarks
    bpy.ops.wm.open_mainfile(filepath=str(made.blend))
    assert "surprise" in bpy.data.objects["Eyelashes"].data.shape_keys.key_blocks
