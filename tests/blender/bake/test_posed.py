"""A face that a rig has brought into another shape is posed as it shows; one that a rig only carries is as it was."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np
import pytest
from risorius.errors import SceneError
from risorius.progress import run
from risorius.scene import bake
from risorius.scene import mesh as meshes
from risorius.scene.bake.remarks import shown_remarks
from risorius.scene.faces import read_face
from risorius.scene.fingerprint import fingerprint
from risorius.scene.live.live_face import LiveFace
from risorius.scene.points.bound import followed, places
from risorius.scene.points.kept import read_kept
from risorius.scene.points.stored import store_points

TIMING = bake.ClipTiming(onset=0.2, apex=0.2, offset=0.2, start=1.0, fps=25.0)


@pytest.fixture
def rigged(head: Any) -> Any:
    """The default head on an armature: one bone for all, one for its lower half with smooth weights."""
    rig = bpy.data.objects.new("Rig", bpy.data.armatures.new("Rig"))
    bpy.context.scene.collection.objects.link(rig)
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode="EDIT")
    for name in ("head", "low"):
        bone = rig.data.edit_bones.new(name)
        bone.head, bone.tail = (0.0, 0.0, 0.0), (0.0, 0.0, 0.1)
    rig.data.edit_bones["low"].parent = rig.data.edit_bones["head"]
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.context.view_layer.objects.active = head
    heights = meshes.rest_vertices(head.data)[:, 2]
    middle = 0.004  # metres: the nose's bottom, however dense the mesh is above and below
    low = np.clip((middle - heights) / 0.06, 0.0, 1.0)
    groups = {name: head.vertex_groups.new(name=name) for name in ("head", "low")}
    for vertex, weight in enumerate(low.tolist()):
        groups["head"].add([vertex], 1.0 - weight, "REPLACE")
        groups["low"].add([vertex], weight, "REPLACE")
    head.modifiers.new("Armature", "ARMATURE").object = rig
    for bone in rig.pose.bones:
        bone.rotation_mode = "XYZ"
    return rig


def reshape(rig: Any, *, turn: float = 0.3) -> None:
    """A broad lower face, its head turned, radians."""
    rig.pose.bones["low"].scale = (1.3, 1.0, 1.1)
    rig.pose.bones["low"].location = (0.0, -0.004, 0.0)
    rig.pose.bones["head"].rotation_euler = (turn / 3.0, turn, turn / 6.0)
    bpy.context.view_layer.update()


def applied(head: Any) -> Any:
    """Another object: the head as it shows, and the points where they show."""
    shown, polygons = meshes.evaluated_vertices(head), meshes.polygon_arrays(head.data)
    obj = bpy.data.objects.new("Applied", meshes.new_mesh("Applied", shown, *polygons))
    bpy.context.collection.objects.link(obj)
    parts = meshes.read_parts(head.data)
    assert parts is not None
    meshes.write_parts(obj.data, parts)
    kept = followed(read_kept(head), head.data).kept
    store_points(obj, {n: tuple(p) for n, p in places(kept, shown).items()})
    return obj


def baked(obj: Any, faps: np.ndarray) -> np.ndarray:
    """(V, 3) what shows of a bake at its apex."""
    run(bake.bake_expression(bake.Target(obj), faps, clip="clip", timing=TIMING, drive="exact"))
    bpy.context.scene.frame_set(8)
    return meshes.evaluated_vertices(obj)


@pytest.fixture
def faps() -> np.ndarray:
    """(68,) an open mouth, drawn corners, half shut eyes."""
    asked = np.full(68, np.nan)
    asked[[2, 5, 6, 18, 19]] = 250.0, 100.0, 100.0, 500.0, 500.0
    return asked


@pytest.mark.slow
@pytest.mark.smoke
@pytest.mark.parametrize(("turn", "within"), [(0.0, 0.02), (0.3, 0.05)])  # a turned mesh has its axes from its points
def test_a_face_that_a_rig_reshapes_is_posed_as_it_shows(
    head: Any, rigged: Any, faps: np.ndarray, turn: float, within: float
) -> None:
    reshape(rigged, turn=turn)
    other = applied(head)
    wanted, before = baked(other, faps), meshes.evaluated_vertices(head)
    found = baked(head, faps)
    moved = np.linalg.norm(wanted - meshes.rest_vertices(other.data), axis=1)
    assert moved.max() > 5e-3
    assert np.linalg.norm(found - wanted, axis=1).max() < within * moved.max()
    assert f"{head.name}: posed on the face as it shows, in the shape that its rig gives it" in shown_remarks(head)
    bpy.context.scene.frame_set(1)
    np.testing.assert_allclose(meshes.evaluated_vertices(head), before, atol=1e-6)
    target = bake.Target(head)
    live = LiveFace(target)
    live.show(target, live.pose(faps, drive="exact", exact=True).displacement)
    bpy.context.view_layer.update()
    np.testing.assert_allclose(meshes.evaluated_vertices(head), found, atol=1e-5)


def test_a_head_that_a_rig_only_carries_is_as_it_was(head: Any, rigged: Any) -> None:
    before = read_face(head)
    bone = rigged.pose.bones["head"]
    bone.rotation_euler, bone.location = (0.4, 0.5, 0.2), (0.1, 0.2, 0.3)
    bpy.context.view_layer.update()
    after = read_face(head)
    np.testing.assert_array_equal(after.vertices, before.vertices)
    assert after.fingerprint.matches(before.fingerprint)
    assert not shown_remarks(head)


def test_a_shape_is_noticed_and_an_animation_is_none(head: Any, rigged: Any) -> None:
    before = read_face(head).fingerprint
    reshape(rigged)
    assert not fingerprint(head).matches(before), "what the rig does now has not been looked at"
    shaped = read_face(head).fingerprint
    assert not shaped.matches(before)
    assert fingerprint(head).matches(shaped)
    rigged.pose.bones["head"].rotation_euler = (0.2, 0.1, 0.0)
    bpy.context.view_layer.update()
    assert read_face(head).fingerprint.matches(shaped), "the head has only been turned"
    low = rigged.pose.bones["low"]
    low.keyframe_insert("scale", frame=1)
    low.scale = (1.0, 1.0, 1.0)
    low.keyframe_insert("scale", frame=9)
    bpy.context.scene.frame_set(1)
    assert read_face(head).fingerprint.matches(before)


def test_nothing_of_it_stays_in_the_file(head: Any, rigged: Any) -> None:
    counts = [len(each) for each in (bpy.data.scenes, bpy.data.objects, bpy.data.meshes, bpy.data.shape_keys)]
    head.shape_key_add(name="Basis")
    head.shape_key_add(name="mine").value = 0.5
    reshape(rigged)
    read_face(head)
    counts[-1] += 1
    assert [len(each) for each in (bpy.data.scenes, bpy.data.objects, bpy.data.meshes, bpy.data.shape_keys)] == counts


def test_a_face_that_a_rig_flattens_is_refused_with_the_remedy(head: Any, rigged: Any, faps: np.ndarray) -> None:
    rigged.pose.bones["low"].scale = (1.0, 0.0, 1.0)
    bpy.context.view_layer.update()
    source = read_face(head)
    moved = np.full_like(source.vertices, 0.01)
    with pytest.raises(SceneError, match=r"its rig flattens \d+ vertices .* \(Alt S\)"):
        source.pieces[0].key_positions(moved)
