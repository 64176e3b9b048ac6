"""Own shape keys and clips beside the user's."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np
import pytest
from risorius.scene import mesh as meshes
from risorius.scene.bake import action as actions
from risorius.scene.bake import shape_keys
from risorius.scene.fcurves import key_curves

pytestmark = pytest.mark.smoke


def moved(obj: Any, by: float) -> np.ndarray:
    return meshes.rest_vertices(obj.data) + np.array([0.0, 0.0, by])


def key_names(obj: Any) -> list[str]:
    return [] if obj.data.shape_keys is None else [block.name for block in obj.data.shape_keys.key_blocks]


def write(obj: Any, clip: str, *amounts: float) -> Any:
    """Write a clip with one key per amount, and its action."""
    names = [clip if len(amounts) == 1 else f"{clip} {i}" for i in range(len(amounts))]
    free = shape_keys.free_names(names, [obj.data], clip)
    retired = shape_keys.read_own(obj.data).clips.get(clip, ())
    own = shape_keys.write_keys(obj, clip, {n: moved(obj, a) for n, a in zip(free, amounts, strict=True)})
    curve = actions.Curve(np.array([1.0, 10.0]), np.array([0.0, 1.0]), linear=True)
    action = actions.write_clip(
        own.face, clip, f"{obj.name} {clip}", dict.fromkeys(free, curve), keys=[obj.data.shape_keys],
        retired=retired, silent=own.names,
    )  # fmt: skip
    actions.play(obj.data.shape_keys, action)
    return action


def curves(action: Any) -> dict[str, list[float]]:
    return {c.data_path: [p.co[1] for p in c.keyframe_points] for c in key_curves(action)}


def test_keys_are_written_and_the_mesh_is_as_found_after_clearing(cube: Any) -> None:
    before = meshes.rest_vertices(cube.data)
    write(cube, "joy", 0.5)
    assert key_names(cube) == ["Basis", "joy"]
    np.testing.assert_allclose(meshes.key_vertices(cube.data.shape_keys.key_blocks["joy"]), moved(cube, 0.5), atol=1e-6)
    shape_keys.remove_keys(cube)
    assert cube.data.shape_keys is None
    np.testing.assert_array_equal(meshes.rest_vertices(cube.data), before)


def test_the_users_keys_values_drivers_and_groups_stay(cube: Any) -> None:
    cube.shape_key_add(name="Basis")
    mine = cube.shape_key_add(name="joy", from_mix=False)
    mine.value, mine.slider_max = 0.25, 3.0
    group = cube.vertex_groups.new(name="cheek")
    mine.vertex_group = group.name
    driver = mine.driver_add("value").driver
    driver.type, driver.expression = "SCRIPTED", "0.25"
    cube.active_shape_key_index = 1
    mine.data[0].co.z += 7.0
    write(cube, "joy", 0.5)
    write(cube, "fear", 0.1, 0.2)
    assert key_names(cube) == ["Basis", "joy", "joy.001", "fear 0", "fear 1"]
    assert cube.active_shape_key_index == 1
    shape_keys.remove_keys(cube, ["fear"])
    shape_keys.remove_keys(cube)
    assert key_names(cube) == ["Basis", "joy"]
    mine = cube.data.shape_keys.key_blocks["joy"]
    assert (mine.value, mine.slider_max, mine.vertex_group) == (0.25, 3.0, "cheek")
    assert mine.data[0].co.z == pytest.approx(cube.data.shape_keys.key_blocks["Basis"].data[0].co.z + 7.0)
    assert cube.data.shape_keys.animation_data.drivers[0].driver.expression == "0.25"


def test_the_active_key_stays_active(cube: Any) -> None:
    write(cube, "joy", 0.5)
    cube.shape_key_add(name="mine", from_mix=False)
    cube.active_shape_key_index = 2
    write(cube, "fear", 0.5)
    assert cube.active_shape_key.name == "mine"
    shape_keys.remove_keys(cube, ["joy"])
    assert cube.active_shape_key.name == "mine"


def test_a_clip_written_again_replaces_its_own_keys_only(cube: Any) -> None:
    write(cube, "joy", 0.1, 0.2, 0.3)
    write(cube, "fear", 0.4)
    write(cube, "joy", 0.5, 0.6)
    assert sorted(key_names(cube)) == ["Basis", "fear", "joy 0", "joy 1"]
    written = meshes.key_vertices(cube.data.shape_keys.key_blocks["joy 1"])
    np.testing.assert_allclose(written, moved(cube, 0.6), atol=1e-6)


def test_a_key_that_the_user_renames_is_the_users(cube: Any) -> None:
    write(cube, "joy", 0.5)
    cube.data.shape_keys.key_blocks["joy"].name = "my smile"
    write(cube, "joy", 0.7)
    shape_keys.remove_keys(cube)
    assert key_names(cube) == ["Basis", "my smile"]


def test_every_own_action_keys_every_own_shape(cube: Any) -> None:
    joy = write(cube, "joy", 0.5)
    fear = write(cube, "fear", 0.1, 0.2)
    paths = {actions.data_path(name) for name in ("joy", "fear 0", "fear 1")}
    assert set(curves(joy)) == set(curves(fear)) == paths
    assert curves(joy)[actions.data_path("fear 0")] == [0.0]
    assert curves(fear)[actions.data_path("joy")] == [0.0]
    fear = write(cube, "fear", 0.1)
    assert set(curves(joy)) == {actions.data_path("joy"), actions.data_path("fear")}
    assert set(curves(fear)) == set(curves(joy))


def test_clips_play_and_do_not_leak(cube: Any) -> None:
    joy = write(cube, "joy", 0.5)
    fear = write(cube, "fear", 0.1)
    keys = cube.data.shape_keys
    assert keys.animation_data.action == fear
    bpy.context.scene.frame_set(10)
    assert (keys.key_blocks["joy"].value, keys.key_blocks["fear"].value) == (0.0, 1.0)
    actions.play(keys, joy)
    bpy.context.scene.frame_set(10)
    assert (keys.key_blocks["joy"].value, keys.key_blocks["fear"].value) == (1.0, 0.0)
    assert joy.use_fake_user
    assert tuple(joy.frame_range) == (1.0, 10.0)


def test_a_users_action_stays_and_the_clip_goes_on_a_track(cube: Any) -> None:
    cube.shape_key_add(name="Basis")
    cube.shape_key_add(name="blink", from_mix=False).keyframe_insert("value", frame=1)
    keys = cube.data.shape_keys
    mine = keys.animation_data.action
    joy = write(cube, "joy", 0.5)
    assert keys.animation_data.action == mine
    assert [s.action for t in keys.animation_data.nla_tracks for s in t.strips] == [joy]
    bpy.context.scene.frame_set(10)
    assert keys.key_blocks["joy"].value == pytest.approx(1.0)
    actions.remove_clip(shape_keys.own_face(cube.data), "joy", keys=[keys], key_names=["joy"])
    assert keys.animation_data.action == mine
    assert len(keys.animation_data.nla_tracks) == 0


def test_keyframes_that_a_user_adds_to_a_clip_stay(cube: Any) -> None:
    cube.shape_key_add(name="Basis")
    cube.shape_key_add(name="blink", from_mix=False)
    joy = write(cube, "joy", 0.5)
    cube.data.shape_keys.key_blocks["blink"].keyframe_insert("value", frame=3)
    assert write(cube, "joy", 0.6) == joy
    assert actions.data_path("blink") in curves(joy)
    actions.remove_clip(shape_keys.own_face(cube.data), "joy", keys=[cube.data.shape_keys], key_names=["joy"])
    assert set(curves(joy)) == {actions.data_path("blink")}


def test_names_with_quotes_work(cube: Any) -> None:
    action = write(cube, 'a "b" \\ c', 0.5)
    bpy.context.scene.frame_set(10)
    assert cube.data.shape_keys.key_blocks['a "b" \\ c'].value == pytest.approx(1.0)
    assert len(curves(action)) == 1
