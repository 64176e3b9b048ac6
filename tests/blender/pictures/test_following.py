"""A film shows the face wherever it goes; what keeps it out of the picture is refused or said before rendering."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest
from risorius.errors import SceneError
from risorius.progress import run
from risorius.scene import mesh as meshes
from risorius.scene.pictures import film
from risorius.scene.pictures.following import CarriedFace, rigid_motion
from risorius.scene.pictures.framing import framing_of
from risorius.scene.pictures.lettering import read_picture
from risorius.scene.pictures.look import Camera, Engine, Look

SMALL = Look(width=96, height=96)
OWN = Look(width=96, height=96, camera=Camera.SCENE)


def walk(obj: Any, *, far: float = 2.0, last: int = 5) -> None:
    """Let an object go sideways from frame 1 to the last."""
    for frame, x in ((1, 0.0), (last, far)):
        obj.location.x = x
        obj.keyframe_insert("location", frame=frame)


def own_camera(at: tuple[float, float, float] = (0.0, -2.0, 0.0)) -> Any:
    """A camera of the scene's own, which looks along +Y."""
    camera = bpy.data.objects.new("Mine", bpy.data.cameras.new("Mine"))
    camera.location, camera.rotation_euler = at, (np.pi / 2.0, 0.0, 0.0)
    bpy.context.collection.objects.link(camera)
    bpy.context.scene.camera = camera
    return camera


def filmed(objects: list[Any], folder: Path, look: Look = SMALL, *, end: int = 5) -> tuple[list[Any], tuple[str, ...]]:
    """The pictures of frames 1 to `end`, and the remarks."""
    result = run(film.render_film(objects, None, start=1, end=end, look=look, frames=folder))
    return [read_picture(folder / f"{frame:04d}.png") for frame in range(1, end + 1)], result.remarks


def shown(picture: Any) -> float:
    """The share of a picture that is not its background, which its upper corner shows."""
    return float((np.abs(picture - picture[-1, 0]).max(axis=2) > 0.02).mean())


@pytest.mark.parametrize("carrier", ["own", "parent", "armature"])
def test_the_portrait_camera_goes_where_the_face_goes(head: Any, carrier: str, tmp_path: Path) -> None:
    if carrier == "own":
        walk(head)
    elif carrier == "parent":
        root = bpy.data.objects.new("Root", None)
        bpy.context.collection.objects.link(root)
        head.parent = root
        walk(root)
    else:
        rig = rigged(head)
        walk(rig.pose.bones["Head"])
    pictures, remarks = filmed([head], tmp_path)
    assert remarks == ()
    assert all(shown(picture) > 0.6 * shown(pictures[0]) > 0.2 for picture in pictures)
    assert head.parent is None or head.parent.name in ("Root", "Rig")


def rigged(head: Any) -> Any:
    """An armature of one bone that carries all of the head."""
    rig = bpy.data.objects.new("Rig", bpy.data.armatures.new("Rig"))
    bpy.context.collection.objects.link(rig)
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode="EDIT")
    bone = rig.data.edit_bones.new("Head")
    bone.head, bone.tail = (0.0, 0.0, 0.0), (0.2, 0.0, 0.0)
    bpy.ops.object.mode_set(mode="OBJECT")
    head.vertex_groups.new(name="Head").add(range(len(head.data.vertices)), 1.0, "REPLACE")
    head.modifiers.new("Armature", "ARMATURE").object = rig
    return rig


def test_a_head_that_its_rig_has_turned_is_filmed_from_its_front(head: Any) -> None:
    """A bone turns the head to its left and lifts it: the framing turns and rises with it, by as much."""
    rest = framing_of(head)
    rig = rigged(head)
    bone = rig.pose.bones["Head"]
    bone.rotation_mode = "XYZ"
    bone.rotation_euler = (0.0, 0.0, np.pi / 3.0)
    bone.location.y = 0.4
    bpy.context.view_layer.update()
    graph = bpy.context.evaluated_depsgraph_get()
    carried = CarriedFace(head).framing(graph)
    moved, resting = meshes.evaluated_vertices(head, graph), meshes.rest_vertices(head.data)
    motion = rigid_motion(resting, moved)
    np.testing.assert_allclose(resting @ motion[:3, :3].T + motion[:3, 3], moved, atol=1e-5)
    np.testing.assert_allclose(carried.forward, motion[:3, :3] @ rest.forward, atol=1e-4)
    np.testing.assert_allclose(carried.centre, motion[:3, :3] @ rest.centre + motion[:3, 3], atol=1e-4)


def test_an_expression_does_not_move_the_camera(head: Any) -> None:
    rest = framing_of(head)
    vertices = meshes.rest_vertices(head.data)
    chin = vertices[:, 2] < np.quantile(vertices[:, 2], 0.3)
    meshes.keys_of(head)
    key = head.shape_key_add(name="open", from_mix=False)
    meshes.write_key_vertices(key, vertices - np.outer(chin, [0.0, 0.0, 0.03]))
    key.value = 1.0
    bpy.context.view_layer.update()
    opened = CarriedFace(head).framing(bpy.context.evaluated_depsgraph_get())
    np.testing.assert_array_equal(opened.centre, rest.centre)


@pytest.mark.parametrize("look", [SMALL, OWN], ids=["portrait", "scene"])
def test_a_face_hidden_from_renders_is_refused(head: Any, look: Look, tmp_path: Path) -> None:
    own_camera()
    head.hide_render = True
    with pytest.raises(SceneError, match="Risorius Head: is hidden from renders: turn on its camera icon"):
        filmed([head], tmp_path, look)
    assert not list(tmp_path.iterdir())


def test_a_face_in_a_collection_that_renders_leave_out_is_refused(head: Any, tmp_path: Path) -> None:
    own_camera()
    scene = bpy.context.scene
    inner, outer = bpy.data.collections.new("Inner"), bpy.data.collections.new("Outer")
    scene.collection.children.link(outer)
    outer.children.link(inner)
    inner.objects.link(head)
    scene.collection.objects.unlink(head)
    filmed([head], tmp_path / "seen", OWN, end=1)
    outer.hide_render = True
    with pytest.raises(SceneError, match="is in the collection Outer, which is hidden from renders"):
        filmed([head], tmp_path / "hidden", OWN, end=1)
    outer.hide_render = False
    layer = bpy.context.view_layer.layer_collection.children["Outer"].children["Inner"]
    layer.exclude = True
    with pytest.raises(SceneError, match="the collection Inner, which is excluded from the view layer"):
        filmed([head], tmp_path / "excluded", OWN, end=1)
    filmed([head], tmp_path / "portrait", SMALL, end=1)  # a scene of its own has no collections
    scene.collection.objects.link(head)
    filmed([head], tmp_path / "twice", OWN, end=1)


def test_a_face_hidden_from_cameras_is_refused_where_that_hides_it(head: Any, tmp_path: Path) -> None:
    head.visible_camera = False
    with pytest.raises(SceneError, match="hidden from cameras: turn on Camera"):
        filmed([head], tmp_path, Look(Engine.CYCLES, 16, 16), end=1)


def test_a_face_hidden_by_its_animation_is_refused_or_said_so(head: Any, tmp_path: Path) -> None:
    for frame, hide in ((1, False), (4, True)):
        head.hide_render = hide
        head.keyframe_insert("hide_render", frame=frame)
    bpy.context.scene.frame_set(1)
    _, remarks = filmed([head], tmp_path)
    assert remarks == ("Risorius Head is hidden from renders by its animation in frames 4 to 5",)
    with pytest.raises(SceneError, match="by its animation in frames 4 to 5"):
        run(film.render_film([head], None, start=4, end=5, look=SMALL, frames=tmp_path))


def test_hidden_companions_are_named(head: Any, cube: Any, tmp_path: Path) -> None:
    cube.hide_render, cube.name = True, "Hair"
    _, remarks = filmed([head, cube], tmp_path, end=1)
    assert remarks == ("Hair is hidden from renders: turn on its camera icon in the Outliner",)


def test_a_scenes_camera_that_loses_the_face_is_said_to(head: Any, tmp_path: Path) -> None:
    own_camera()
    walk(head)
    texts: list[str] = []
    work = film.render_film([head], None, start=1, end=5, look=OWN, frames=tmp_path)
    remarks = run(work, lambda step: texts.append(step.text)).remarks
    said = "Risorius Head is not in the picture of Mine in frames 3 to 5: aim the camera at the face"
    assert [remark.startswith(said) for remark in remarks] == [True]
    assert texts.index(remarks[0]) < texts.index("Rendering frame 1 of 5")


def test_a_face_too_far_from_the_scenes_camera_is_said_to_be(head: Any, tmp_path: Path) -> None:
    own_camera((0.0, -80.0, 0.0))
    _, remarks = filmed([head], tmp_path, OWN, end=1)
    assert "not in the picture of Mine" in remarks[0]


def test_a_scenes_cameras_switch_by_their_markers(head: Any, tmp_path: Path) -> None:
    away, near = own_camera((9.0, -2.0, 0.0)), own_camera()
    for frame, camera in ((1, away), (3, near)):
        bpy.context.scene.timeline_markers.new(camera.name, frame=frame).camera = camera
    pictures, _ = filmed([head], tmp_path, OWN, end=3)
    assert shown(pictures[0]) == 0.0
    assert shown(pictures[2]) > 0.01
    assert len(bpy.context.scene.timeline_markers) == 2


def test_what_a_view_layer_leaves_out_is_not_filmed(head: Any, cube: Any, tmp_path: Path) -> None:
    own_camera()
    cube.location.y, cube.scale = -1.0, (0.2,) * 3
    widgets = bpy.data.collections.new("Widgets")
    bpy.context.scene.collection.children.link(widgets)
    widgets.objects.link(cube)
    bpy.context.scene.collection.objects.unlink(cube)
    (before,), _ = filmed([head], tmp_path / "in", OWN, end=1)
    bpy.context.view_layer.layer_collection.children["Widgets"].exclude = True
    (after,), _ = filmed([head], tmp_path / "out", OWN, end=1)
    assert np.abs(before - after).mean() > 0.02
