"""A clip on keys above what plays already: added to it, taken off again, baked anew, saved, with heads that change."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest
from file_state import differences, file_state
from risorius import api
from risorius.face.mesh.parts import Part
from risorius.scene.rig import remove_rig_clips

from .keyed import APEX, add_keys, bake, effects, values

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def changes(built_head: Any) -> dict[str, np.ndarray]:
    """What the keys do to the default head."""
    return effects(api.Face.from_arrays(built_head.vertices, built_head.polygons, built_head.points, built_head.parts))


@pytest.fixture
def keyed(head: Any, built_head: Any, changes: dict[str, np.ndarray]) -> Any:
    """The default head with six keys, and one that moves its upper teeth, which no emotion does."""
    teeth = (built_head.parts == Part.TEETH_UPPER)[:, None] * np.array([0.0, -0.001, 0.0])
    add_keys(head, changes | {"teeth": teeth})
    return head


def animate(head: Any, *names: str) -> Any:
    """Key some keys by hand: 0.1 at frame 1, 0.3 at frame 30."""
    keys = head.data.shape_keys
    for name in names:
        for frame, value in ((1, 0.1), (30, 0.3)):
            keys.key_blocks[name].value = value
            keys.key_blocks[name].keyframe_insert("value", frame=frame)
    bpy.context.scene.frame_set(1)
    return keys


def as_strip(keys: Any, name: str = "mine") -> Any:
    """Make what plays a strip on a track of the user's."""
    animation = keys.animation_data
    action = animation.action
    slot = getattr(animation, "action_slot", None)
    track = animation.nla_tracks.new()
    track.name = name
    animation.action = None
    strip = track.strips.new(name, 1, action)
    if slot is not None:
        strip.action_slot = slot
    return track


def shown(keys: Any, frames: range = range(1, 31)) -> list[dict[str, float]]:
    """The keys' values over time."""
    return [values(keys, frame) for frame in frames]


def settled(keys: Any) -> dict[str, object]:
    """The file at frame 1."""
    bpy.context.scene.frame_set(1)
    return file_state()


@pytest.mark.parametrize("strip", [False, True], ids=["action", "strip"])
@pytest.mark.parametrize("names", ["Grin.L Grin.R", "teeth", "Grin.L teeth"], ids=["same", "other", "both"])
def test_a_layer_adds_to_what_plays_and_comes_off_without_a_trace(keyed: Any, names: str, strip: bool) -> None:
    keys = animate(keyed, *names.split())
    if strip:
        as_strip(keys)
    before, played = settled(keys), shown(keys)
    result = bake(keyed)
    peak = dict(zip(result.followed.names, result.followed.values[0], strict=True))  # type: ignore[union-attr]
    at_apex = values(keys, APEX)
    for name in at_apex:
        below = played[APEX - 1][name] if name in names.split() else 0.0
        assert at_apex[name] == pytest.approx(min(below + peak.get(name, 0.0), 1.0), abs=0.01), name
    assert values(keys, 30) == pytest.approx(played[29], abs=1e-4)
    assert remove_rig_clips(keyed) == ("joy",)
    assert differences(before, settled(keys)) == []
    assert shown(keys) == [pytest.approx(each) for each in played]


@pytest.mark.parametrize("way", ["muted", "solo", "above", "off"])
def test_tracks_of_the_users_stay_as_they_are(keyed: Any, way: str) -> None:
    keys = animate(keyed, "Grin.L")
    track = as_strip(keys)
    if way == "muted":
        track.mute = True
    elif way == "solo":
        track.is_solo = True
    elif way == "off":
        keys.animation_data.use_nla = False
    elif way == "above":
        bake(keyed, "anger", clip="first")
        over = keys.animation_data.nla_tracks.new()
        over.name = "above all"
    before = settled(keys)
    result = bake(keyed)
    if way in ("solo", "off"):
        assert any("does not play" in line for line in result.remarks)
    remove_rig_clips(keyed, ["joy"])
    assert differences(before, settled(keys)) == []


def test_baking_a_clip_anew_replaces_it(keyed: Any) -> None:
    keys = animate(keyed, "Grin.L")
    bake(keyed, "anger", clip="mine")
    bake(keyed, "joy", clip="mine")
    once = shown(keys)
    bake(keyed, "joy", clip="mine")
    assert shown(keys) == [pytest.approx(each, abs=1e-5) for each in once]
    tracks = [track.name for track in keys.animation_data.nla_tracks]
    assert len(tracks) == 2
    assert len([action for action in bpy.data.actions if "mine" in action.name]) == 1


def test_two_clips_that_overlap_both_play_and_come_off_one_by_one(keyed: Any) -> None:
    bake(keyed, "joy")
    alone = shown(keyed.data.shape_keys)
    bake(keyed, "surprise", start=11.0)
    assert values(keyed.data.shape_keys, 24)["jawOpen"] > 0.1
    assert values(keyed.data.shape_keys, 6)["Grin.L"] == pytest.approx(alone[5]["Grin.L"], abs=1e-4)
    assert remove_rig_clips(keyed, ["surprise"]) == ("surprise",)
    assert shown(keyed.data.shape_keys) == [pytest.approx(each, abs=1e-5) for each in alone]


def test_into_the_action_keys_what_plays_and_leaves_the_rest_of_it(keyed: Any) -> None:
    keys = animate(keyed, "Grin.L", "teeth")
    for frame, value in ((60, 0.7), (80, 0.2)):
        keys.key_blocks["Grin.L"].value = value
        keys.key_blocks["Grin.L"].keyframe_insert("value", frame=frame)
    action, played = keys.animation_data.action, shown(keys, range(55, 90))
    teeth = [each["teeth"] for each in shown(keys)]
    result = bake(keyed, above=False)
    assert keys.animation_data.action == action
    assert len(keys.animation_data.nla_tracks) == 0
    assert values(keys, APEX)["Grin.L"] == pytest.approx(
        dict(zip(result.followed.names, result.followed.values[0], strict=True))["Grin.L"],  # type: ignore[union-attr]
        abs=0.01,
    )
    assert [each["teeth"] for each in shown(keys)] == pytest.approx(teeth)
    assert shown(keys, range(60, 90)) == [pytest.approx(each, abs=1e-5) for each in played[5:]]


def test_into_the_action_again_leaves_nothing_of_the_first(keyed: Any) -> None:
    keys = animate(keyed, "teeth")
    bake(keyed, "anger", above=False)
    once = shown(keys)
    bake(keyed, "joy", above=False)
    bake(keyed, "anger", above=False)
    assert shown(keys) == [pytest.approx(each, abs=1e-5) for each in once]


def test_a_head_that_is_renamed_or_saved_keeps_its_clips(keyed: Any, tmp_path: Path) -> None:
    keys = animate(keyed, "Grin.L")
    before, played = settled(keys), shown(keys)
    bake(keyed)
    during = shown(keys)
    keyed.name = "Someone else"
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "kept.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "kept.blend"))
    head = bpy.data.objects["Someone else"]
    keys = head.data.shape_keys
    assert shown(keys) == [pytest.approx(each) for each in during]
    assert remove_rig_clips(head) == ("joy",)
    assert shown(keys) == [pytest.approx(each) for each in played]
    left = [each for each in differences(before, settled(keys)) if ".objects[" in each or "shape_keys[" in each]
    assert [each for each in left if "Someone" not in each and "name" not in each and "objects[" not in each] == []


def test_a_duplicate_of_a_head_has_clips_of_its_own(keyed: Any) -> None:
    bake(keyed)
    during = shown(keyed.data.shape_keys)
    for obj in bpy.context.view_layer.objects:
        obj.select_set(obj == keyed)
    bpy.ops.object.duplicate()
    twin = bpy.context.object
    assert twin.data.shape_keys != keyed.data.shape_keys
    bake(twin, "anger", clip="joy")
    assert shown(keyed.data.shape_keys) == [pytest.approx(each) for each in during]
    anger = shown(twin.data.shape_keys)
    remove_rig_clips(keyed)
    assert shown(twin.data.shape_keys) == [pytest.approx(each) for each in anger]


def test_a_duplicate_keeps_what_it_plays_when_the_first_head_is_cleared_or_deleted(keyed: Any) -> None:
    bake(keyed)
    for obj in bpy.context.view_layer.objects:
        obj.select_set(obj == keyed)
    bpy.ops.object.duplicate()
    twin = bpy.context.object
    during = shown(twin.data.shape_keys)
    assert during[APEX - 1]["Grin.L"] > 0.3
    remove_rig_clips(keyed)
    assert shown(twin.data.shape_keys) == [pytest.approx(each) for each in during]
    bpy.data.objects.remove(keyed)
    bake(twin, "surprise")
    assert values(twin.data.shape_keys, APEX)["jawOpen"] > 0.1
