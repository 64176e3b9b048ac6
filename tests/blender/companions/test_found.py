"""The objects of a character are found by name, by place and by shape; what is not its own is left alone."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import bpy
import pytest
from mathutils import Matrix
from risorius.scene.following.found import find_followers
from risorius.scene.following.kinds import Follows

RIGHT = {"Eyes": Follows.EYES, "Teeth": Follows.TEETH, "Tongue": Follows.TONGUE, "Brows": Follows.SKIN}


def found(face: Any) -> dict[str, Follows]:
    bpy.context.view_layer.update()
    return {follower.obj.name: follower.follows for follower in find_followers(face)}


def hat(name: str, centre: tuple[float, float, float] = (0.0, 0.02, 0.16)) -> Any:
    """Half a ball on the crown."""
    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.09, location=centre)
    obj = bpy.context.object
    obj.name = obj.data.name = name
    return obj


def test_a_character_is_found_by_its_names(character: Callable) -> None:
    made = character()
    hat("Wolf3D_Headwear")
    assert found(made["Face"]) == {**RIGHT, "Wolf3D_Headwear": Follows.SKULL}


def test_a_character_without_names_is_found_by_places_and_shapes(character: Callable) -> None:
    made = character()
    for number, name in enumerate(RIGHT):
        made[name].name = made[name].data.name = f"Mesh.{number:03d}"
    hat("Mesh.100")
    told = {f"Mesh.{number:03d}": follows for number, follows in enumerate(RIGHT.values())}
    assert found(made["Face"]) == {**told, "Mesh.100": Follows.SKULL}


def test_materials_collections_and_groups_name_what_its_own_name_does_not(character: Callable) -> None:
    made = character()
    for number, name in enumerate(RIGHT):
        made[name].name = made[name].data.name = f"Mesh.{number:03d}"
    made["Brows"].data.materials.append(bpy.data.materials.new("Std_Hair"))
    made["Tongue"].vertex_groups.new(name="teeth_lower")
    drawer = bpy.data.collections.new("Eyes")
    bpy.context.scene.collection.children.link(drawer)
    drawer.objects.link(made["Eyes"])
    assert found(made["Face"])["Mesh.003"] is Follows.SKULL
    assert found(made["Face"])["Mesh.002"] is Follows.TEETH_LOWER
    assert found(made["Face"])["Mesh.000"] is Follows.EYES


def test_a_name_in_the_wrong_place_is_not_believed(character: Callable) -> None:
    made = character()
    hat("Glass Eye")
    hat("Teeth of a shark", (1.0, 0.0, 0.0))
    assert found(made["Face"]) == {**RIGHT, "Glass Eye": Follows.SKULL}


ELSEWHERE = Matrix.Rotation(1.0, 4, "Z") @ Matrix.Translation((3.0, 4.0, 5.0))


@pytest.mark.parametrize("matrix", [Matrix.Scale(100.0, 4), ELSEWHERE], ids=["large", "elsewhere"])
def test_they_are_found_wherever_and_however_large_the_character_is(character: Callable, matrix: Matrix) -> None:
    made = character()
    for obj in made.values():
        obj.matrix_world = matrix
    assert found(made["Face"]) == RIGHT


def test_what_is_not_the_faces_own_is_left_alone(character: Callable) -> None:
    made = character()
    bpy.ops.mesh.primitive_plane_add(size=4.0, location=(0.0, 0.0, -0.2))
    bpy.context.object.name = "Ground"
    bpy.ops.mesh.primitive_cube_add(size=0.5, location=(0.0, 0.0, -0.45))
    bpy.context.object.name = "Torso"
    hat("WGT-rig_head")
    hidden = hat("Hair of a variant")
    hidden.hide_render = hidden.hide_viewport = True
    twin = made["Face"].copy()
    twin.data = made["Face"].data.copy()
    bpy.context.collection.objects.link(twin)
    assert found(made["Face"]) == RIGHT


def test_what_hangs_on_another_rig_is_another_characters(character: Callable) -> None:
    made = character()
    ours, theirs = (bpy.data.objects.new(name, bpy.data.armatures.new(name)) for name in ("Ours", "Theirs"))
    for rig in (ours, theirs):
        bpy.context.collection.objects.link(rig)
    made["Face"].modifiers.new("Armature", "ARMATURE").object = ours
    made["Eyes"].parent = ours
    made["Teeth"].modifiers.new("Armature", "ARMATURE").object = theirs
    assert found(made["Face"]) == {name: follows for name, follows in RIGHT.items() if name != "Teeth"}


def test_hair_that_is_no_mesh_is_named(character: Callable) -> None:
    made = character()
    curve = bpy.data.curves.new("Hair", "CURVE")
    spline = curve.splines.new("POLY")
    spline.points.add(1)
    spline.points[0].co, spline.points[1].co = (0.0, 0.0, 0.1, 1.0), (0.0, 0.05, 0.12, 1.0)
    bpy.context.collection.objects.link(bpy.data.objects.new("Hair", curve))
    bpy.context.view_layer.update()
    last = {follower.obj.name: follower for follower in find_followers(made["Face"])}["Hair"]
    assert (last.follows, last.why_not) == (Follows.NONE, "is not a mesh")


def test_what_cannot_be_written_to_is_named_with_the_reason(character: Callable) -> None:
    made = character()
    made["Teeth"].shape_key_add(name="Basis")
    made["Teeth"].data.shape_keys.use_relative = False
    follower = {follower.obj.name: follower for follower in find_followers(made["Face"])}["Teeth"]
    assert follower.follows is Follows.NONE
    assert "absolute shape keys" in follower.why_not
