"""Nothing of the user's is changed: all that a character's file holds is the same before and after every operation."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest
from file_state import State, differences, file_state
from risorius import api
from risorius.face.mesh.parts import Part
from risorius.operators.active import target_of
from risorius.progress import run
from risorius.scene import mesh as meshes
from risorius.scene.live import preview
from risorius.scene.live.live_face import LiveFace


def cut_out(head: Any, name: str, parts: set[Part]) -> Any:
    """An object of its own for some parts of a head, which loses them."""
    told, copy = meshes.read_parts(head.data), head.copy()
    copy.data, copy.name = head.data.copy(), name
    bpy.context.collection.objects.link(copy)
    for obj, kept in ((copy, np.isin(told, list(parts))), (head, ~np.isin(told, list(parts)))):
        vertices, (corners, sizes) = meshes.rest_vertices(obj.data), meshes.polygon_arrays(obj.data)
        number = np.cumsum(kept) - 1
        polygons = [p for p in meshes.polygon_sequence(corners, sizes) if kept[list(p)].all()]
        mesh = meshes.new_mesh(
            name, vertices[kept], *meshes.flatten_polygons([[number[v] for v in p] for p in polygons])
        )
        obj.data = mesh
    return copy


@pytest.fixture
def character(head: Any, tmp_path: Path) -> Any:
    """A head with eyes of its own, lashes, keys, drivers, actions, NLA, a rig, a prop of another file, materials."""
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end, scene.render.fps, scene.frame_current = 5, 77, 30, 12
    scene["shot"] = {"take": 3}
    scene.timeline_markers.new("blink", frame=9)
    _with_library(tmp_path)
    eyes = cut_out(head, "Eyes", {Part.EYEBALL_L, Part.EYEBALL_R})
    head.name = "Body"
    rig = _rigged([head, eyes])
    _keyed(head)
    material = bpy.data.materials.new("Skin of mine")
    material.use_nodes = True
    head.data.materials.append(material)
    head.data.attributes.new("mine", "FLOAT", "POINT")
    head.data.attributes.active = head.data.attributes["mine"]
    modifier = head.modifiers.new("Smooth", "SMOOTH")
    modifier.iterations = 0
    head["outfit"] = "red"
    track = rig.animation_data.nla_tracks.new()
    track.strips.new("walk", 1, rig.animation_data.action)
    for obj in bpy.context.view_layer.objects:
        obj.select_set(obj.name == "Body")
    bpy.context.view_layer.objects.active = head
    head.active_shape_key_index = 1
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "character.blend"))
    return head


def _with_library(folder: Path) -> None:
    """A linked object with an action, which this file's driver looks at."""
    prop = bpy.data.objects.new("Prop", bpy.data.meshes.new("Prop"))
    prop.keyframe_insert("location", frame=1)
    bpy.data.libraries.write(str(folder / "props.blend"), {prop})
    bpy.data.objects.remove(prop)
    with bpy.data.libraries.load(str(folder / "props.blend"), link=True) as (_, here):
        here.objects = ["Prop"]
    bpy.context.collection.objects.link(here.objects[0])


def _rigged(objects: list[Any]) -> Any:
    """A walking armature whose bone carries the objects."""
    rig = bpy.data.objects.new("Rig", bpy.data.armatures.new("Rig"))
    bpy.context.collection.objects.link(rig)
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode="EDIT")
    bone = rig.data.edit_bones.new("Head")
    bone.head, bone.tail = (0.0, 0.0, 0.0), (0.0, 0.0, 0.2)
    bpy.ops.object.mode_set(mode="OBJECT")
    rig.keyframe_insert("location", frame=1)
    for obj in objects:
        obj.vertex_groups.new(name="Head").add(range(len(obj.data.vertices)), 1.0, "REPLACE")
        obj.modifiers.new("Armature", "ARMATURE").object = rig
        obj.parent = rig
    return rig


def _keyed(head: Any) -> None:
    """Keys of the user's: one shown, one relative to it, one driven by the linked object, one animated."""
    for name in ("Basis", "younger", "thin", "driven", "played"):
        key = head.shape_key_add(name=name, from_mix=False)
    blocks = head.data.shape_keys.key_blocks
    for number, key in enumerate(blocks[1:]):
        meshes.write_key_vertices(key, meshes.rest_vertices(head.data) * (1.0 + 0.001 * number))
    blocks["younger"].value = 0.4
    blocks["thin"].relative_key, blocks["thin"].vertex_group = blocks["younger"], "Head"
    driver = blocks["driven"].driver_add("value").driver
    variable = driver.variables.new()
    variable.targets[0].id, variable.targets[0].data_path = bpy.data.objects["Prop"], "location.x"
    driver.expression = variable.name
    for frame, value in ((1, 0.0), (30, 0.8)):
        blocks["played"].value = value
        blocks["played"].keyframe_insert("value", frame=frame)
    bpy.context.scene.frame_set(12)


def six(character: Any, folder: Path) -> None:
    assert bpy.ops.risorius.bake_six() == {"FINISHED"}


def one_expression(character: Any, folder: Path) -> None:
    character.risorius.emotion.word = "fear"
    assert bpy.ops.risorius.bake_expression() == {"FINISHED"}


def creased_expression(character: Any, folder: Path) -> None:
    character.risorius.bake.creases = True
    assert bpy.ops.risorius.bake_expression() == {"FINISHED"}


def _timeline(character: Any) -> None:
    """Two clips."""
    for word, frame in (("joy", 5), ("anger", 40)):
        character.risorius.emotion.word = word
        bpy.context.scene.frame_set(frame)
        assert bpy.ops.risorius.add_clip() == {"FINISHED"}
    bpy.context.scene.frame_set(12)


def strips(character: Any, folder: Path) -> None:
    _timeline(character)
    assert bpy.ops.risorius.bake_strips() == {"FINISHED"}


def motion(character: Any, folder: Path) -> None:
    bake = character.risorius.bake
    bake.onset = bake.apex = bake.offset = 0.1
    assert bpy.ops.risorius.bake_motion() == {"FINISHED"}


def film(character: Any, folder: Path) -> None:
    chosen = bpy.context.scene.risorius.film
    chosen.path, chosen.width, chosen.height = str(folder / "film.mp4"), 64, 64
    bpy.context.scene.frame_end, before = 8, bpy.context.scene.frame_end
    assert bpy.ops.risorius.render_film() == {"FINISHED"}
    bpy.context.scene.frame_end = before


def gltf(character: Any, folder: Path) -> None:
    one_expression(character, folder)
    bpy.context.scene.risorius.film.model = str(folder / "face.glb")
    assert bpy.ops.risorius.export_gltf() == {"FINISHED"}


def engine_shapes(character: Any, folder: Path) -> None:
    bpy.context.scene.risorius.shapes.names = "oculus_visemes"
    assert bpy.ops.risorius.make_shapes() == {"FINISHED"}


def previewed(character: Any, folder: Path) -> None:
    assert bpy.ops.risorius.find_points() == {"FINISHED"}
    target = target_of(character)
    live = LiveFace(target)
    run(live.prepare())
    pose = live.pose(api.expression("joy").frame(), drive="natural", emotion=api.expression("joy").weights)
    live.show(target, pose.displacement)
    preview.remove_all()


def baked_and_cleared(character: Any, folder: Path) -> None:
    creased_expression(character, folder)
    assert bpy.ops.risorius.clear() == {"FINISHED"}
    assert not character.add_rest_position_attribute


@pytest.mark.slow
@pytest.mark.parametrize(
    "operation",
    [six, one_expression, creased_expression, strips, motion, film, gltf, engine_shapes, previewed, baked_and_cleared],
    ids=lambda operation: operation.__name__,
)
def test_all_of_the_users_is_the_same(character: Any, operation: Callable[[Any, Path], None], tmp_path: Path) -> None:
    before = file_state()
    operation(character, tmp_path)
    found = differences(before, file_state())
    if operation is engine_shapes:  # these keys are the user's from now on
        found = [one for one in found if ".key_blocks.length:" not in one]
    assert found == []


@pytest.mark.slow
def test_a_change_anywhere_is_a_difference(character: Any) -> None:
    before = file_state()
    assert len(before) > 3000
    changes: list[Callable[[], None]] = [
        lambda: setattr(character.data.shape_keys.key_blocks["younger"], "value", 0.41),
        lambda: setattr(character.data.shape_keys.key_blocks["thin"].data[7], "co", (1.0, 2.0, 3.0)),
        lambda: setattr(character.modifiers["Smooth"], "factor", 0.51),
        lambda: setattr(bpy.context.scene, "frame_end", 78),
        lambda: character.__setitem__("outfit", "blue"),
        lambda: character.vertex_groups["Head"].add([5], 0.5, "REPLACE"),
        lambda: setattr(bpy.data.objects["Rig"].animation_data.nla_tracks[0], "mute", True),
        lambda: bpy.data.materials["Skin of mine"].node_tree.nodes.clear(),
        lambda: setattr(character.data.shape_keys.animation_data.drivers[0].driver, "expression", "0"),
        lambda: (
            setattr(bpy.data.objects["Rig"].animation_data.action.fcurves[0].keyframe_points[0], "co", (2.0, 1.0))
            if hasattr(bpy.data.objects["Rig"].animation_data.action, "fcurves")
            else setattr(character, "pass_index", 3)
        ),
    ]
    last: State = before
    for change in changes:
        change()
        now = file_state()
        assert differences(last, now) != []
        last = now
