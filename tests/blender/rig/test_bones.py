"""Bones as controls: what moves the face is found and measured, within limits, and keyed as a bone keeps its turns."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import bpy
import numpy as np
import pytest
import risorius.api
from file_state import differences, file_state
from risorius.errors import SceneError
from risorius.progress import run
from risorius.scene.bake import ClipTiming, Target
from risorius.scene.faces import face_of, read_face
from risorius.scene.mesh import evaluated_vertices
from risorius.scene.rig import Rig, bake_expression_onto, bone_rig, remove_rig_clips
from risorius.scene.rig.channels import Channel, Form, Place
from risorius.scene.rig.turns import keyed_values

pytestmark = pytest.mark.slow

TIMING = ClipTiming(0.4, 1.0, 0.6)


def found(rigged: SimpleNamespace) -> Rig:
    """The controls of the small rig."""
    return run(bone_rig(read_face(rigged.head)))


def moved(rigged: SimpleNamespace, rest: Any) -> Any:
    """How the head differs from `rest` as Blender shows it."""
    bpy.context.view_layer.update()
    return evaluated_vertices(rigged.head) - rest


def joy(rigged: SimpleNamespace) -> Any:
    """Bake joy onto the bones."""
    word = risorius.api.expression("joy")
    work = bake_expression_onto(
        Target(rigged.head), word.frame(), bone_rig, clip="joy", timing=TIMING, emotion=word.weights
    )
    return run(work)


def names(rig: Rig) -> set[str]:
    """Names of the bones that are controls."""
    return {entry.channel.name.rsplit(" ", 2)[0] for entry in rig.entries}


def test_what_a_bone_does_is_what_blender_shows(rigged: SimpleNamespace) -> None:
    rig, rest = found(rigged), evaluated_vertices(rigged.head)
    (number,) = [i for i, entry in enumerate(rig.entries) if entry.name == "corner.L Location Z"]
    rigged.bones["corner.L"].location[2] = 0.006
    shown = moved(rigged, rest)
    assert np.abs(shown).max() > 0.004
    np.testing.assert_allclose(0.006 * rig.effects[number], shown, atol=2e-5)


@pytest.mark.skipif(bpy.app.version < (4, 4), reason="reading all that an armature has crashes this Blender")
def test_nothing_of_the_file_changes_however_far_it_comes(rigged: SimpleNamespace) -> None:
    source, _ = read_face(rigged.head), file_state()  # reading it makes Cycles add settings of its own
    before = file_state()
    work = bone_rig(source)
    for _ in range(12):
        next(work)
    work.close()
    assert differences(before, file_state()) + differences(file_state(), before) == []
    run(bone_rig(source))
    assert differences(before, file_state()) + differences(file_state(), before) == []


def test_a_bone_that_moves_the_whole_head_is_left_alone_and_named(rigged: SimpleNamespace) -> None:
    rig = found(rigged)
    assert names(rig) == {"jaw", "corner.L", "corner.R", "brow.L", "brow.R"}
    assert rig.left_alone == {"skull": "moves the whole head"}


def test_hidden_locked_and_driven_channels_are_left_alone(rigged: SimpleNamespace) -> None:
    bones = rigged.bones
    hidden = bones["brow.L"] if hasattr(bones["brow.L"], "hide") else bones["brow.L"].bone
    hidden.hide = True
    bones["brow.R"].bone.hide_select = True
    bones["corner.R"].lock_location = bones["corner.R"].lock_rotation = bones["corner.R"].lock_scale = (True,) * 3
    bones["corner.L"].driver_add("location", 0).driver.expression = "0.0"
    rig = found(rigged)
    assert names(rig) == {"jaw", "corner.L"}
    assert "corner.L Location X" not in {entry.channel.name for entry in rig.entries}
    assert rig.left_alone["corner.L Location X"] == "is driven"


def test_constraints_that_limit_are_limits(rigged: SimpleNamespace) -> None:
    limit = rigged.bones["brow.L"].constraints.new("LIMIT_LOCATION")
    limit.owner_space, limit.use_min_z, limit.max_z, limit.use_max_z = "LOCAL", True, 0.005, True
    limits = {entry.channel.name: (entry.channel.low, entry.channel.high) for entry in found(rigged).entries}
    assert limits["brow.L Location Z"] == pytest.approx((0.0, 0.005))
    low, high = limits["brow.R Location Z"]
    assert -0.04 < low < -0.01
    assert 0.01 < high < 0.04


@pytest.mark.parametrize("mode", ["QUATERNION", "AXIS_ANGLE", "ZYX"])
def test_joy_shows_on_the_bones_however_they_keep_turns(rigged: SimpleNamespace, mode: str) -> None:
    for bone in rigged.bones:
        bone.rotation_mode = mode
    bpy.context.scene.frame_set(1)
    rest = evaluated_vertices(rigged.head)
    result = joy(rigged)
    assert result.followed.explained > 0.6
    bpy.context.scene.frame_set(20)
    corner = 1e3 * moved(rigged, rest)[vertex_at(rigged, "8.3")]
    assert corner[2] > 3.0
    assert corner[0] > 2.0
    bpy.context.scene.frame_set(60)
    assert np.abs(moved(rigged, rest)).max() < 1e-6
    assert remove_rig_clips(rigged.head) == ("joy",)


def vertex_at(rigged: SimpleNamespace, point: str) -> int:
    """The vertex of a feature point."""
    from risorius.scene.points.stored import stored_points

    vertex = stored_points(rigged.head)[point]
    assert isinstance(vertex, int)
    return vertex


def test_a_clip_adds_to_an_animation_of_the_same_bone(rigged: SimpleNamespace) -> None:
    corner = rigged.bones["corner.L"]
    for frame, turn in ((1, (1.0, 0.0, 0.0, 0.0)), (60, (0.8, 0.0, 0.6, 0.0))):
        corner.rotation_quaternion, corner.scale = turn, (1.0, 1.0, 1.0 + frame / 600.0)
        corner.keyframe_insert("rotation_quaternion", frame=frame)
        corner.keyframe_insert("scale", frame=frame)
    shown = {}
    for step in ("alone", "with joy", "again"):
        bpy.context.scene.frame_set(60)
        shown[step, 60] = np.array([*corner.rotation_quaternion, *corner.scale])
        bpy.context.scene.frame_set(20)
        shown[step, 20] = np.array([*corner.rotation_quaternion, *corner.scale])
        joy(rigged) if step == "alone" else remove_rig_clips(rigged.head)
    np.testing.assert_allclose(shown["with joy", 60], shown["alone", 60], atol=1e-5)
    assert np.abs(shown["with joy", 20] - shown["alone", 20]).max() > 0.01
    for frame in (20, 60):
        np.testing.assert_allclose(shown["again", frame], shown["alone", frame], atol=1e-6)


def test_a_head_that_the_rig_carries_is_read_the_right_way_round(rigged: SimpleNamespace) -> None:
    straight = found(rigged)
    rigged.bones["skull"].rotation_mode = "XYZ"
    rigged.bones["skull"].rotation_euler = (0.0, 0.6, 0.3)
    bpy.context.view_layer.update()
    turned = found(rigged)
    assert [entry.name for entry in turned.entries] == [entry.name for entry in straight.entries]
    np.testing.assert_allclose(turned.effects, straight.effects, atol=2e-3 * np.abs(straight.effects).max())


def test_what_cannot_be_keyed_is_refused_with_the_remedy(rigged: SimpleNamespace) -> None:
    rigged.rig.data.pose_position = "REST"
    with pytest.raises(SceneError, match="rest position: set it to Pose Position"):
        found(rigged)
    rigged.rig.data.pose_position = "POSE"
    bpy.context.view_layer.objects.active = rigged.rig
    bpy.ops.object.mode_set(mode="EDIT")
    with pytest.raises(SceneError, match=r"edit mode: leave it first \(Tab\)"):
        found(rigged)
    bpy.ops.object.mode_set(mode="OBJECT")
    for bone in rigged.bones:
        bone.lock_location = bone.lock_rotation = bone.lock_scale = (True,) * 3
    with pytest.raises(SceneError, match="no controls that can be used: Rig: none that is shown"):
        found(rigged).controls()
    rigged.head.modifiers.clear()
    with pytest.raises(SceneError, match="has no armature: bind it to one"):
        found(rigged)


def test_turns_become_quaternions_after_the_one_at_rest() -> None:
    from mathutils import Quaternion

    rest = Quaternion((0.3, 0.5, -0.4, 0.7)).normalized()
    channels = [
        Channel(
            f"bone Rotation {axis}",
            Place(bpy.context.scene, "turn", i),
            -1.0,
            1.0,
            form=Form.QUATERNION,
            turn=tuple(rest),
        )
        for i, axis in enumerate("XYZ")
    ]
    vector = np.array([0.4, -0.2, 0.9])
    keyed = keyed_values({channel: np.array([0.0, v]) for channel, v in zip(channels, vector, strict=True)})
    parts = np.array([channel.resting + values for channel, values in keyed.items()])
    expected = rest @ Quaternion(vector / np.linalg.norm(vector), float(np.linalg.norm(vector)))
    np.testing.assert_allclose(parts[:, 0], rest, atol=1e-6)
    np.testing.assert_allclose(parts[:, 1], expected, atol=1e-6)
    assert [channel.neutral for channel in keyed] == [1.0, 0.0, 0.0, 0.0]


def test_what_is_told_is_what_the_rig_shows_although_bones_turn_on_arcs(rigged: SimpleNamespace) -> None:
    word = risorius.api.expression("surprise")
    asked = face_of(read_face(rigged.head)).pose(word.frame(), emotion=word.weights).positions
    bpy.context.scene.frame_set(1)
    rest = evaluated_vertices(rigged.head)
    told, linear = {}, replace(found(rigged), evaluate=None)
    for way, find in (("rounds", bone_rig), ("linear", lambda source: found_work(linear))):
        work = bake_expression_onto(
            Target(rigged.head), word.frame(), find, clip="surprise", timing=TIMING, emotion=word.weights
        )
        result = run(work)
        bpy.context.scene.frame_set(20)
        skin = face_of(read_face(rigged.head)).outer_skin
        off = float(np.sqrt(((moved(rigged, rest) - (asked - rest))[skin] ** 2).sum(axis=1).mean()))
        told[way] = off, result.followed.off_at_peak
        remove_rig_clips(rigged.head)
    assert told["rounds"][1] == pytest.approx(told["rounds"][0], rel=0.03)
    assert told["rounds"][0] < told["linear"][0]


def found_work(rig: Rig) -> Any:
    """Controls that are known already, as work."""
    return rig
    yield
