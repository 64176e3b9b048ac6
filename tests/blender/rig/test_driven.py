"""Shape keys with drivers are keyed at what drives them, never at the key."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np
import pytest
import risorius.api
from risorius.progress import run
from risorius.scene.bake import ClipTiming, Target
from risorius.scene.faces import read_face
from risorius.scene.fcurves import all_curves
from risorius.scene.mesh import basis_vertices, evaluated_vertices, key_vertices, write_key_vertices
from risorius.scene.rig import Rig, bake_expression_onto, key_rig, remove_rig_clips
from risorius.scene.shape_mix import data_path

pytestmark = pytest.mark.slow

KEYS = ("smile", "frown", "open", "raise")


@pytest.fixture
def face(head: Any) -> Any:
    """The default head with four keys of muscles' poses, and an armature with a bone "slider" that moves no skin."""
    made = risorius.api.Face.from_arrays(
        *(lambda h: (h.vertices, h.polygons, h.points))(risorius.api.build_default_head()),
        parts=risorius.api.build_default_head().parts,
    )
    head.shape_key_add(name="Basis")
    for name, word in zip(KEYS, ("joy", "sadness", "surprise", "fear"), strict=True):
        key = head.shape_key_add(name=name, from_mix=False)
        key.value = 0.0
        write_key_vertices(key, made.pose(risorius.api.expression(word).frame()).positions)
    rig = bpy.data.objects.new("Rig", bpy.data.armatures.new("Rig"))
    bpy.context.collection.objects.link(rig)
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode="EDIT")
    bone = rig.data.edit_bones.new("slider")
    bone.tail = (0.0, 0.0, 0.1)
    bpy.ops.object.mode_set(mode="OBJECT")
    return head


def drive(face: Any, key: str, expression: str = "x", **what: Any) -> Any:
    """Give a key a driver that reads something of the armature."""
    driver = face.data.shape_keys.key_blocks[key].driver_add("value").driver
    variable = driver.variables.new()
    variable.name, variable.type = "x", what.get("type", "SINGLE_PROP")
    target = variable.targets[0]
    if variable.type == "SINGLE_PROP" and "id_type" in what:
        target.id_type = what["id_type"]
    target.id = what.get("id", bpy.data.objects["Rig"])
    for name in ("data_path", "bone_target", "transform_type", "transform_space"):
        if name in what:
            setattr(target, name, what[name])
    driver.expression = expression
    return driver


def controls(face: Any) -> Rig:
    """The controls of the face's keys."""
    return run(key_rig(read_face(face)))


def bake(face: Any, word: str = "joy") -> Any:
    """Bake a word onto the face's keys."""
    asked = risorius.api.expression(word)
    timing = ClipTiming(0.4, 1.0, 0.6)
    work = bake_expression_onto(Target(face), asked.frame(), key_rig, clip=word, timing=timing, emotion=asked.weights)
    return run(work)


def at_peak(face: Any, key: str) -> float:
    """What a key shows at the peak of a clip."""
    bpy.context.scene.frame_set(20)
    evaluated = face.evaluated_get(bpy.context.evaluated_depsgraph_get())
    return float(evaluated.data.shape_keys.key_blocks[key].value)


def test_a_property_is_keyed_within_the_limits_of_its_slider(face: Any) -> None:
    rig = bpy.data.objects["Rig"]
    rig["Smile"] = 0.0
    rig.id_properties_ui("Smile").update(min=0.0, max=10.0)
    rig.update_tag()
    drive(face, "smile", "x / 10", data_path='["Smile"]')
    entry = next(entry for entry in controls(face).entries if entry.name == "Rig Smile")
    assert entry.limits == (0.0, 10.0)
    result = bake(face)
    assert "Rig Smile" in result.keys
    keyed = all_curves(face.data.shape_keys.animation_data.action)
    assert {curve.data_path for curve in keyed} == {data_path(key) for key in KEYS[1:]}
    assert at_peak(face, "smile") > 0.8
    assert rig["Smile"] == pytest.approx(10.0 * at_peak(face, "smile"), abs=1e-3)
    remove_rig_clips(face)
    assert at_peak(face, "smile") == pytest.approx(0.0, abs=1e-6)


def test_a_property_of_a_bone_drives_through_another_driver(face: Any) -> None:
    bone = bpy.data.objects["Rig"].pose.bones["slider"]
    bone["first"], bone["then"] = 0.0, 0.0
    bone.id_properties_ui("first").update(min=0.0, max=1.0)
    between = bone.driver_add('["then"]').driver
    variable = between.variables.new()
    variable.name, variable.targets[0].id = "x", bpy.data.objects["Rig"]
    variable.targets[0].data_path = 'pose.bones["slider"]["first"]'
    between.expression = "x"
    drive(face, "smile", data_path='pose.bones["slider"]["then"]')
    assert "slider first" in bake(face).keys
    assert at_peak(face, "smile") > 0.8


@pytest.mark.parametrize("way", ["property", "transform"])
def test_a_slider_from_frown_to_smile_is_two_controls_of_one_channel(face: Any, way: str) -> None:
    bone = bpy.data.objects["Rig"].pose.bones["slider"]
    limit = bone.constraints.new("LIMIT_LOCATION")
    limit.owner_space, limit.use_min_x, limit.use_max_x, limit.min_x, limit.max_x = "LOCAL", True, True, -0.5, 0.5
    read: dict[str, Any] = (
        {"data_path": 'pose.bones["slider"].location[0]'}
        if way == "property"
        else {
            "type": "TRANSFORMS",
            "bone_target": "slider",
            "transform_type": "LOC_X",
            "transform_space": "LOCAL_SPACE",
        }
    )
    drive(face, "smile", "2 * x", **read)
    drive(face, "frown", "-2 * x", **read)
    rig = controls(face)
    pair = {entry.sign: number for number, entry in enumerate(rig.entries) if "slider" in entry.name}
    assert set(pair) == {1, -1}
    assert rig.entries[pair[1]].limits == pytest.approx((0.0, 0.5))
    keys = face.data.shape_keys.key_blocks
    basis = basis_vertices(face.data)
    for sign, key in ((1, "smile"), (-1, "frown")):
        change = key_vertices(keys[key]) - basis
        np.testing.assert_allclose(0.5 * rig.effects[pair[sign]], change, atol=1e-5)
    bake(face, "joy")
    assert at_peak(face, "smile") > 0.7
    remove_rig_clips(face)
    bake(face, "sadness")
    assert at_peak(face, "frown") > 0.7


def test_a_turning_bone_in_quaternion_mode_drives(face: Any) -> None:
    drive(
        face,
        "open",
        type="TRANSFORMS",
        bone_target="slider",
        transform_type="ROT_X",
        transform_space="LOCAL_SPACE",
    )
    assert any("slider Rotation X" in name for name in bake(face, "surprise").keys)
    assert at_peak(face, "open") > 0.6
    turn = bpy.data.objects["Rig"].pose.bones["slider"].rotation_quaternion
    assert turn.magnitude == pytest.approx(1.0, abs=1e-5)


def test_what_no_key_can_be_set_for_is_named_with_the_remedy(face: Any) -> None:
    face.data.shape_keys.key_blocks["smile"].driver_add("value").driver.expression = "frame / 100"
    drive(face, "frown", id=bpy.context.scene, id_type="SCENE", data_path="frame_current")
    bpy.data.objects["Rig"]["idle"] = bpy.data.objects["Rig"]["late"] = 0.0
    bpy.data.objects["Rig"].update_tag()
    drive(face, "open", "0 * x", data_path='["idle"]')
    drive(face, "raise", data_path='["gone"]')
    left = controls(face).left_alone
    face.data.shape_keys.key_blocks["raise"].driver_remove("value")
    drive(face, "raise", "no_such_name * x", data_path='["late"]')
    assert "its driver shows an error: mend it" in controls(face).left_alone["raise"]
    assert "reads nothing that can be keyed: let it read a property" in left["smile"]
    assert "reads Scene: let it read a property" in left["frown"]
    assert "reads Rig idle, which does not move the face" in left["open"]
    assert "reads Rig, where nothing can be keyed for it" in left["raise"]


def test_a_key_that_drives_another_is_keyed_with_what_it_drives(face: Any) -> None:
    drive(face, "frown", "x / 2", id=face.data.shape_keys, id_type="KEY", data_path='key_blocks["smile"].value')
    rig = controls(face)
    assert [entry.name for entry in rig.entries] == ["open", "raise", "smile"]
    keys, rest = face.data.shape_keys.key_blocks, evaluated_vertices(face)
    keys["smile"].value = 1.0
    bpy.context.view_layer.update()
    np.testing.assert_allclose(rig.effects[2], evaluated_vertices(face) - rest, atol=2e-5)
