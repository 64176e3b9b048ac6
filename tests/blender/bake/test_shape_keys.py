"""Own shape keys and clips beside the user's."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest
from risorius.scene import mesh as meshes
from risorius.scene.bake import action as actions
from risorius.scene.bake import shape_keys, tracks
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
    tracks.play(obj.data.shape_keys, action)
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
    tracks.play(keys, joy)
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


def strips_of(keys: Any) -> list[list[str]]:
    """The clips on each of our tracks, the lowest track first."""
    return [
        [strip.action[tracks.CLIP_TAG] for strip in track.strips]
        for track in keys.animation_data.nla_tracks
        if tracks.is_own(track)
    ]


def shown(keys: Any, frame: int) -> dict[str, float]:
    """The keys' values at a frame, zeros left out."""
    bpy.context.scene.frame_set(frame)
    return {block.name: round(block.value, 3) for block in keys.key_blocks[1:] if block.value != 0.0}


def clip_at(cube: Any, clip: str, start: float) -> Any:
    """Write a clip that rises over ten frames and stays, and play it."""
    free = shape_keys.free_names([clip], [cube.data], clip)
    own = shape_keys.write_keys(cube, clip, {free[0]: moved(cube, 0.5)})
    curve = actions.Curve(start + np.array([0.0, 9.0, 10.0]), np.array([0.0, 1.0, 0.0]), linear=True)
    keys = cube.data.shape_keys
    action = actions.write_clip(own.face, clip, clip, {free[0]: curve}, keys=[keys], silent=own.names)
    return action, tracks.play(keys, action)


def test_clips_at_other_times_play_on(cube: Any) -> None:
    for clip, start in (("joy", 1.0), ("fear", 20.4), ("anger", 30.6)):
        assert clip_at(cube, clip, start)[1] == ()
    keys = cube.data.shape_keys
    assert keys.animation_data.action is None
    assert strips_of(keys) == [["joy", "fear", "anger"]]
    assert shown(keys, 10) == {"joy": 1.0}
    assert set(shown(keys, 29)) == {"fear"}
    assert set(shown(keys, 39)) == {"anger"}
    assert shown(keys, 15) == shown(keys, 60) == shown(keys, -5) == {}


def test_the_frames_that_play_are_those_of_all_clips(cube: Any) -> None:
    assert tracks.played_frames(cube.data.shape_keys) is None
    for clip, start, frames in (("joy", 5.0, (5, 15)), ("fear", 30.0, (5, 40)), ("anger", -20.0, (-20, 40))):
        clip_at(cube, clip, start)
        assert tracks.played_frames(cube.data.shape_keys) == frames
    animation = cube.data.shape_keys.animation_data
    animation.nla_tracks[0].strips[-1].frame_start_ui = 50.0
    assert tracks.played_frames(cube.data.shape_keys) == (-20, 60)
    animation.use_nla = False
    assert tracks.played_frames(cube.data.shape_keys) is None


def test_a_clip_before_the_others_plays_too(cube: Any) -> None:
    for clip, start in (("fear", 20.0), ("anger", 40.0), ("joy", 1.0)):
        clip_at(cube, clip, start)
    keys = cube.data.shape_keys
    assert shown(keys, 10) == {"joy": 1.0}
    assert shown(keys, 29) == {"fear": 1.0}
    assert shown(keys, 49) == {"anger": 1.0}
    assert shown(keys, -5) == shown(keys, 70) == {}


def test_the_newest_of_clips_at_one_time_shows_and_the_other_is_named(cube: Any) -> None:
    clip_at(cube, "joy", 1.0)
    _, said = clip_at(cube, "fear", 5.0)
    assert any("joy" in remark and "no longer plays" in remark for remark in said)
    assert shown(cube.data.shape_keys, 14) == {"fear": 1.0}
    clip_at(cube, "anger", 40.0)
    clip_at(cube, "joy", 1.0)
    keys = cube.data.shape_keys
    assert shown(keys, 10) == {"joy": 1.0}
    assert shown(keys, 49) == {"anger": 1.0}


def test_a_clip_baked_anew_has_one_strip(cube: Any) -> None:
    for start in (1.0, 30.0, 5.0):
        clip_at(cube, "joy", 60.0)
        clip_at(cube, "fear", start)
    keys = cube.data.shape_keys
    assert sorted(name for track in strips_of(keys) for name in track) == ["fear", "joy"]
    assert shown(keys, 14) == {"fear": 1.0}


@pytest.mark.parametrize("cause", ["off", "solo", "mute"])
def test_what_keeps_our_tracks_from_playing_is_said(cube: Any, cause: str) -> None:
    clip_at(cube, "joy", 1.0)
    clip_at(cube, "fear", 20.0)
    animation = cube.data.shape_keys.animation_data
    if cause == "off":
        animation.use_nla = False
    elif cause == "solo":
        track = animation.nla_tracks.new()
        track.name, track.is_solo = "Mine", True
    else:
        animation.nla_tracks[0].mute = True
    (said,) = clip_at(cube, "anger", 40.0)[1]
    assert {"off": "turned off", "solo": "Mine is solo", "mute": "is muted"}[cause] in said


def test_names_beyond_what_blender_keeps_are_cut_between_letters(cube: Any) -> None:
    name = "とても嬉しい顔の表情テスト長い名前その一二三四五"
    for _ in range(2):
        clip_at(cube, name, 1.0)
    keys = cube.data.shape_keys
    (block,) = keys.key_blocks[1:]
    assert name.startswith(block.name)
    assert len(block.name) == 21
    assert shown(keys, 10) == {block.name: 1.0}
    assert shape_keys.read_own(cube.data).clips == {name: (block.name,)}
    assert block.name in shape_keys.shortened(name)[0]
    assert shape_keys.shortened(name[:21]) == ()
    assert shape_keys.fitting(name, " 01") == name[:20] + " 01"
    shape_keys.remove_keys(cube)
    assert cube.data.shape_keys is None


def test_a_linked_clip_stays_as_it_is(cube: Any, tmp_path: Path) -> None:
    action, _ = clip_at(cube, "joy", 1.0)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "character.blend"), copy=True)
    bpy.data.actions.remove(action)
    with bpy.data.libraries.load(str(tmp_path / "character.blend"), link=True) as (_, here):
        here.actions = ["joy"]
    linked = bpy.data.actions["joy"]
    keys = cube.data.shape_keys
    keys.animation_data.action = linked
    made, _ = clip_at(cube, "joy", 50.0)
    assert made.library is None
    assert keys.animation_data.action == made
    assert tuple(linked.frame_range) == (1.0, 11.0)


def test_keys_relative_to_a_replaced_one_go_on_adding_what_they_added(cube: Any) -> None:
    basis = cube.shape_key_add(name="Basis")
    smile = cube.shape_key_add(name="smile", from_mix=False)
    more = cube.shape_key_add(name="more", from_mix=False)
    more.relative_key, more.data[0].co.z = smile, more.data[0].co.z + 0.25
    smile.relative_key, smile.vertex_group, smile.mute = more, "", True
    shape_keys.write_shape(cube.data.shape_keys, smile, moved(cube, 0.5))
    assert (smile.relative_key, smile.mute) == (basis, False)
    added = [(a.co - b.co).length for a, b in zip(more.data, smile.data, strict=True)]
    np.testing.assert_allclose(added, [0.25] + [0.0] * (len(added) - 1), atol=1e-6)
