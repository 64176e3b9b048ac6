"""Baking onto the keys that a face already has: which are used, what each does, what is left alone and named."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest
from file_state import State, differences, file_state
from risorius import api
from risorius.errors import ModelError, SceneError
from risorius.face.mesh.parts import Part, Told
from risorius.progress import run
from risorius.scene import mesh as meshes
from risorius.scene.bake.motion import CueMotion
from risorius.scene.bake.target import Target
from risorius.scene.companions import Companion
from risorius.scene.faces import read_face
from risorius.scene.points.stored import store_points
from risorius.scene.rig import key_rig, remove_rig_clips
from risorius.scene.rig.baking import bake_motion_onto

from .keyed import APEX, SHAPES, add_keys, bake, effects, values

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def changes(built_head: Any) -> dict[str, np.ndarray]:
    """What the keys do to the default head."""
    return effects(api.Face.from_arrays(built_head.vertices, built_head.polygons, built_head.points, built_head.parts))


@pytest.fixture
def keyed(head: Any, changes: dict[str, np.ndarray]) -> Any:
    """The default head with six keys."""
    add_keys(head, changes)
    return head


def blocks(obj: Any) -> Any:
    """The keys of an object."""
    return obj.data.shape_keys.key_blocks


def rig_of(obj: Any, *companions: Companion) -> Any:
    """The keys of a face as its rig."""
    return run(key_rig(read_face(obj, companions=companions)))


def without_values(state: State) -> State:
    """Of a state, the shape keys: their names, places, groups, ranges, all but their present values."""
    return {place: value for place, value in state.items() if ".key_blocks" in place and not place.endswith(".value")}


def test_an_emotion_is_keyed_on_keys_of_any_name_and_none_is_added_or_changed(keyed: Any) -> None:
    before = file_state()
    result = bake(keyed)
    after = file_state()
    assert differences(without_values(before), after) == []
    assert len(blocks(keyed)) == 1 + len(SHAPES)
    assert {"Grin.L", "Grin.R"} <= set(result.keys)
    shown = values(keyed.data.shape_keys, APEX)
    assert shown["Grin.L"] == pytest.approx(shown["Grin.R"], abs=0.02)
    assert shown["Grin.L"] > 0.3
    assert max(values(keyed.data.shape_keys, 1).values()) == 0.0
    assert max(values(keyed.data.shape_keys, 40).values()) == 0.0
    assert result.followed is not None
    assert result.followed.explained > 0.3


def test_the_clip_is_what_the_api_finds(keyed: Any, changes: dict[str, np.ndarray]) -> None:
    result = bake(keyed, "surprise")
    source = read_face(keyed)
    face = api.Face.from_arrays(source.vertices, source.polygons, dict(source.points), parts=source.parts)
    profile = api.expression("surprise")
    pose = face.pose(profile.frame(), emotion=profile.weights)
    zeros = np.zeros(len(changes))
    controls = api.Controls(tuple(changes), np.array(list(changes.values())), zeros, zeros + 1.0)
    found = api.retarget(face, controls, [pose.positions], requested=profile.frame())
    shown = values(keyed.data.shape_keys, APEX)
    assert result.followed is not None
    for name, value in zip(found.names, found.values[0], strict=True):
        assert shown[name] == pytest.approx(value, abs=2e-3)


@pytest.mark.parametrize(("low", "high"), [(0.0, 0.25), (-1.0, 1.0), (-0.5, 0.0), (0.0, 2.0)])
def test_values_stay_in_the_range_of_a_slider(keyed: Any, low: float, high: float) -> None:
    for name in ("Grin.L", "Grin.R"):
        blocks(keyed)[name].slider_min, blocks(keyed)[name].slider_max = low, high
    entry = next(entry for entry in rig_of(keyed).entries if entry.name == "Grin.L")
    assert entry.limits == pytest.approx((low, high))
    bake(keyed)
    for frame in range(1, 22):
        shown = values(keyed.data.shape_keys, frame)
        assert low - 1e-6 <= shown["Grin.L"] <= high + 1e-6


def test_a_key_relative_to_another_and_through_a_vertex_group_does_what_it_shows(keyed: Any) -> None:
    group = keyed.vertex_groups.new(name="upper half")
    heights = meshes.rest_vertices(keyed.data)[:, 2]
    group.add(np.flatnonzero(heights > np.median(heights)).tolist(), 0.5, "REPLACE")
    keys = blocks(keyed)
    keys["Grin.L"].vertex_group = "upper half"
    keys["jawOpen"].relative_key = keys["Grin.R"]
    rig = rig_of(keyed)
    for entry, effect in zip(rig.entries, rig.effects, strict=True):
        key = keys[entry.name]
        still = evaluated(keyed)
        key.value = 1.0
        assert np.abs(evaluated(keyed) - still - effect).max() < 2e-6
        key.value = 0.0


def evaluated(obj: Any) -> np.ndarray:
    """(V, 3) the vertices of an object as they show, in the scene's space."""
    bpy.context.view_layer.update()
    seen = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    places = np.empty(3 * len(seen.data.vertices), dtype=np.float32)
    seen.data.vertices.foreach_get("co", places)
    turn = np.array(seen.matrix_world)
    return places.reshape(-1, 3) @ turn[:3, :3].T + turn[:3, 3]


@pytest.mark.parametrize("way", ["turned", "scaled", "parented", "centimetres"])
def test_where_a_head_is_and_how_large_changes_no_value(keyed: Any, way: str) -> None:
    expected = peaks(bake(keyed))
    remove_rig_clips(keyed)
    if way == "turned":
        keyed.rotation_euler, keyed.location = (0.4, 1.1, -0.7), (3.0, 1.0, 2.0)
    elif way == "scaled":
        keyed.scale = (7.0, 7.0, 7.0)
    elif way == "parented":
        parent = bpy.data.objects.new("Parent", None)
        bpy.context.collection.objects.link(parent)
        parent.rotation_euler, parent.scale = (1.0, 0.0, 0.5), (0.2, 0.2, 0.2)
        keyed.parent = parent
    else:
        keyed.scale = (100.0, 100.0, 100.0)
        bpy.context.scene.unit_settings.scale_length = 0.01
    bpy.context.view_layer.update()
    assert peaks(bake(keyed)) == pytest.approx(expected, abs=5e-3)


def peaks(result: Any) -> dict[str, float]:
    """Key -> its value at the peak."""
    return dict(zip(result.followed.names, result.followed.values[0].tolist(), strict=True))


def test_what_an_armature_makes_of_a_face_is_measured(keyed: Any) -> None:
    rig = bpy.data.objects.new("Rig", bpy.data.armatures.new("Rig"))
    bpy.context.collection.objects.link(rig)
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode="EDIT")
    bone = rig.data.edit_bones.new("head")
    bone.head, bone.tail = (0.0, 0.0, 0.0), (0.0, 0.0, 0.1)
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.context.view_layer.objects.active = keyed
    keyed.vertex_groups.new(name="head").add(range(len(keyed.data.vertices)), 1.0, "REPLACE")
    keyed.modifiers.new("Armature", "ARMATURE").object = rig
    expected = peaks(bake(keyed))
    remove_rig_clips(keyed)
    rig.pose.bones["head"].rotation_mode = "XYZ"
    rig.pose.bones["head"].rotation_euler = (0.2, 0.5, 0.1)
    bpy.context.view_layer.update()
    assert peaks(bake(keyed)) == pytest.approx(expected, abs=0.02)


def test_copies_of_vertices_at_seams_change_nothing(keyed: Any) -> None:
    expected = peaks(bake(keyed))
    remove_rig_clips(keyed)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.edge_split(type="EDGE")
    bpy.ops.object.mode_set(mode="OBJECT")
    assert peaks(bake(keyed)) == pytest.approx(expected, abs=0.03)


@pytest.mark.parametrize(
    ("way", "why"),
    [
        ("muted", "is muted"),
        ("locked", "is locked"),
        ("curve", "F-curve is locked"),
        ("driven", "is driven"),
        ("shown", "is part of the resting face"),
        ("no room", "no room in its slider's range"),
    ],
)
def test_keys_that_are_not_free_are_left_alone_and_named(keyed: Any, way: str, why: str) -> None:
    key = blocks(keyed)["jawOpen"]
    if way == "muted":
        key.mute = True
    elif way == "locked":
        if not hasattr(key, "lock_shape"):
            pytest.skip("this Blender has no lock")
        key.lock_shape = True
    elif way == "curve":
        key.keyframe_insert("value", frame=1)
        lock_curves(keyed.data.shape_keys)
    elif way == "driven":
        key.driver_add("value").driver.expression = "0.0"
    elif way == "shown":
        key.value = 0.2
    else:
        key.slider_max = 0.0
    value = key.value
    result = bake(keyed, "surprise")
    assert "jawOpen" not in result.keys
    assert any("jawOpen" in line and why in line for line in result.remarks), result.remarks
    assert values(keyed.data.shape_keys, APEX)["jawOpen"] == pytest.approx(value)


def lock_curves(keys: Any) -> None:
    """Lock all F-curves that keys play."""
    from risorius.scene.fcurves import played_curves

    curves = played_curves(keys.animation_data)
    assert curves is not None
    for curve in curves:
        curve.lock = True


@pytest.fixture
def two(built_head: Any, changes: dict[str, np.ndarray]) -> tuple[Any, Any]:
    """The default head, and its teeth as an object of their own, both with the same keys."""
    teeth = np.isin(built_head.parts, [Part.TEETH_UPPER, Part.TEETH_LOWER])
    made = []
    for name, kept in (("Face", ~teeth), ("Teeth", teeth)):
        number = np.cumsum(kept) - 1
        polygons = [number[list(polygon)].tolist() for polygon in built_head.polygons if kept[list(polygon)].all()]
        obj = bpy.data.objects.new(
            name, meshes.new_mesh(name, built_head.vertices[kept], *meshes.flatten_polygons(polygons))
        )
        bpy.context.collection.objects.link(obj)
        add_keys(obj, changes, kept)
        made.append(obj)
        if name == "Face":
            points = {
                point: int(number[place]) if isinstance(place, int) and kept[place] else built_head.position(point)
                for point, place in built_head.points.items()
            }
            store_points(
                obj, {point: place if isinstance(place, int) else tuple(place) for point, place in points.items()}
            )
    bpy.context.view_layer.objects.active = made[0]
    return made[0], made[1]


def test_companions_with_keys_of_the_same_names_are_keyed_together(two: tuple[Any, Any]) -> None:
    head, teeth = two
    bake(head, "surprise", companions=(Companion(teeth, Told.TEETH),))
    ours, theirs = (values(obj.data.shape_keys, APEX) for obj in two)
    assert ours["jawOpen"] > 0.2
    assert theirs == pytest.approx(ours)
    removed = remove_rig_clips(head)
    assert removed == ("surprise",)
    assert max(values(teeth.data.shape_keys, APEX).values()) == 0.0


def test_companions_driven_by_the_heads_keys_are_counted_and_not_keyed(two: tuple[Any, Any]) -> None:
    head, teeth = two
    alone = rig_of(head, Companion(teeth, Told.TEETH))
    drive(teeth, "jawOpen", head.data.shape_keys, 'key_blocks["jawOpen"].value')
    rig = rig_of(head, Companion(teeth, Told.TEETH))
    jaw = next(i for i, entry in enumerate(rig.entries) if entry.name == "jawOpen")
    assert len(rig.entries[jaw].channel.places) == 1
    assert np.array_equal(rig.effects[jaw], alone.effects[jaw])


def test_companions_driven_by_something_else_are_neither_counted_nor_keyed(two: tuple[Any, Any]) -> None:
    head, teeth = two
    handle = bpy.data.objects.new("Handle", None)
    drive(teeth, "jawOpen", handle, "location.x")
    rig = rig_of(head, Companion(teeth, Told.TEETH))
    jaw = next(i for i, entry in enumerate(rig.entries) if entry.name == "jawOpen")
    assert len(rig.entries[jaw].channel.places) == 1
    assert np.abs(rig.effects[jaw][len(head.data.vertices) :]).max() == 0.0
    assert any("Teeth" in name for name in rig.left_alone)


def test_a_key_that_is_muted_on_a_companion_is_used_on_the_head_alone(two: tuple[Any, Any]) -> None:
    head, teeth = two
    blocks(teeth)["jawOpen"].mute = True
    rig = rig_of(head, Companion(teeth, Told.TEETH))
    jaw = next(i for i, entry in enumerate(rig.entries) if entry.name == "jawOpen")
    assert len(rig.entries[jaw].channel.places) == 1
    assert np.abs(rig.effects[jaw][len(head.data.vertices) :]).max() == 0.0
    assert any("Teeth" in name and "muted" in why for name, why in rig.left_alone.items())


def test_two_objects_of_one_mesh_are_keyed_once(two: tuple[Any, Any]) -> None:
    head, teeth = two
    again = bpy.data.objects.new("Teeth again", teeth.data)
    bpy.context.collection.objects.link(again)
    rig = rig_of(head, Companion(teeth, Told.TEETH), Companion(again, Told.TEETH))
    jaw = next(entry for entry in rig.entries if entry.name == "jawOpen")
    assert len(jaw.channel.places) == 2
    bake(head, "surprise", companions=(Companion(teeth, Told.TEETH), Companion(again, Told.TEETH)))
    assert values(teeth.data.shape_keys, APEX)["jawOpen"] > 0.2


def test_a_motion_is_keyed_in_range_and_replaced_when_it_is_baked_anew(keyed: Any) -> None:
    cue = api.Cue(api.expression("joy"), onset=0.4, apex=0.4, offset=0.4)
    for _ in range(2):
        work = bake_motion_onto(Target(keyed), CueMotion([cue]), key_rig, clip="smile", start=5.0, fps=25.0)
        result = run(work)
    assert result.frame_range == (5.0, 5.0 + 30.0)
    over_time = [values(keyed.data.shape_keys, frame)["Grin.L"] for frame in range(5, 36)]
    assert over_time[0] == pytest.approx(0.0, abs=0.01)
    assert max(over_time) > 0.3
    assert max(over_time) <= 1.0
    assert np.abs(np.diff(over_time, 2)).max() < 0.2  # it may reach the end of its range
    assert len(keyed.data.shape_keys.animation_data.nla_tracks) == 0


def drive(obj: Any, name: str, owner: Any, path: str) -> None:
    """Give a key's value to a driver that reads one number."""
    driver = blocks(obj)[name].driver_add("value").driver
    variable = driver.variables.new()
    if isinstance(owner, bpy.types.Key):
        variable.targets[0].id_type = "KEY"
    variable.targets[0].id, variable.targets[0].data_path = owner, path
    driver.expression = variable.name


def test_keys_that_do_nothing_or_the_same_are_named(keyed: Any, changes: dict[str, np.ndarray]) -> None:
    add_keys(keyed, {"idle": 0.0 * changes["jawOpen"], "again": 0.5 * changes["jawOpen"], "back": -changes["Grin.L"]})
    result = bake(keyed)
    told = " ".join((*result.remarks, *result.told))
    assert "idle" in told
    assert "again (jawOpen)" in told
    assert not {"idle", "again"} & set(result.keys)
    assert result.keys.count("Grin.L") == 1


def refused(obj: Any, match: str, kind: type[Exception] = SceneError) -> None:
    """A bake is refused, and nothing in the file has changed, nor has anything come."""
    before = file_state()
    actions = len(bpy.data.actions)
    with pytest.raises(kind, match=match):
        bake(obj)
    assert differences(before, file_state()) == []
    assert len(bpy.data.actions) == actions


def test_a_face_without_keys_that_can_be_used_is_refused(head: Any, changes: dict[str, np.ndarray]) -> None:
    refused(head, "no shape keys|no controls")
    add_keys(head, {name: 0.0 * change for name, change in changes.items()})
    refused(head, "none of the controls moves the face", ModelError)
    for key in blocks(head):
        key.mute = True
    refused(head, "muted")


def test_absolute_keys_tweak_mode_and_edit_mode_are_refused(keyed: Any) -> None:
    keyed.data.shape_keys.use_relative = False
    refused(keyed, "turn on Relative")
    keyed.data.shape_keys.use_relative = True
    bpy.ops.object.mode_set(mode="EDIT")
    refused(keyed, "Object Mode")
    bpy.ops.object.mode_set(mode="OBJECT")
    blocks(keyed)["jawOpen"].keyframe_insert("value", frame=1)
    animation = keyed.data.shape_keys.animation_data
    track = animation.nla_tracks.new()
    track.strips.new("mine", 1, animation.action)
    animation.action = None
    animation.use_tweak_mode = True
    refused(keyed, "tweak mode")


def test_a_mesh_that_others_share_says_so(keyed: Any) -> None:
    other = bpy.data.objects.new("Twin", keyed.data)
    bpy.context.collection.objects.link(other)
    result = bake(keyed)
    assert any("Twin" in line for line in result.remarks)


def test_linked_heads_are_refused_and_overridden_ones_as_they_can_be_keyed(keyed: Any, tmp_path: Path) -> None:
    keyed.name = "Linked"
    bpy.data.libraries.write(str(tmp_path / "head.blend"), {keyed})
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    with bpy.data.libraries.load(str(tmp_path / "head.blend"), link=True) as (_, here):
        here.objects = ["Linked"]
    linked = here.objects[0]
    bpy.context.collection.objects.link(linked)
    refused(linked, "is linked from another file")
    local = linked.override_create(remap_local_usages=True)
    assert local is not None
    refused(local, "is linked from another file|override")
