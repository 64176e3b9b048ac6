"""How clips on a rig play: after one another, over one another, over an animation of the user's, taken off again."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np
import pytest
from risorius.scene.bake.remarks import shown_remarks
from risorius.scene.rig import remove_rig_clips
from risorius.scene.rig.channels import Channel, Place
from risorius.scene.rig.clips import Keyframes, write_rig_clip
from risorius.scene.shape_mix import data_path, moving_keys, resting_values

NAMES = ("smile", "frown", 'odd "name".001')


@pytest.fixture
def face() -> Any:
    """A mesh with three keys of the user's."""
    mesh = bpy.data.meshes.new("Face")
    mesh.from_pydata([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [], [(0, 1, 2)])
    obj = bpy.data.objects.new("Face", mesh)
    bpy.context.collection.objects.link(obj)
    for name in ("Basis", *NAMES):
        obj.shape_key_add(name=name).value = 0.0
    return obj


def lay(face: Any, clip: str, peaks: dict[str, float], start: float, *, end: float = 0.0, **options: Any) -> Any:
    """Lay a clip of 20 frames that keys all keys, those that are named with a peak in its middle."""
    keys, frames = face.data.shape_keys, np.linspace(start, end or start + 20.0, 5)
    shape = np.array([0.0, 1.0, 1.0, 1.0, 0.0])
    values = {Channel(name, Place(keys, data_path(name)), 0.0, 1.0): peaks.get(name, 0.0) * shape for name in NAMES}
    return write_rig_clip(face, clip, Keyframes(frames, values, linear=True), **options)


def shown(face: Any, frame: float) -> dict[str, float]:
    """What the keys are at a frame, without those at 0."""
    bpy.context.scene.frame_set(int(frame))
    found = {key.name: round(key.value, 4) for key in face.data.shape_keys.key_blocks}
    return {name: value for name, value in found.items() if value != 0.0}


def animate(face: Any, name: str, start: float, end: float) -> None:
    """Key a key by hand."""
    key = face.data.shape_keys.key_blocks[name]
    for frame, value in ((start, 0.2), (end, 0.6)):
        key.value = value
        key.keyframe_insert("value", frame=frame)


def test_clips_play_one_after_another_and_at_rest_between(face: Any) -> None:
    for number, name in enumerate(NAMES):
        lay(face, f"clip {number}", {name: 1.0}, 10.0 + 30.0 * number)
    for order in (range(100), reversed(range(100))):
        for frame in order:
            (number,), within = {(frame - 10) // 30}, (frame - 10) % 30
            at_apex = 0 <= number < 3 and 5 <= within <= 15
            if at_apex:
                assert shown(face, frame) == {NAMES[number]: 1.0}, frame
            elif not 0 < within < 20:
                assert shown(face, frame) == {}, frame


def test_of_clips_baked_apart_the_newest_shows_and_the_other_outside_it(face: Any) -> None:
    lay(face, "long", {"smile": 1.0}, 10.0, end=110.0)
    lay(face, "late", {"frown": 0.5}, 80.0)
    assert shown(face, 50) == {"smile": 1.0}
    assert shown(face, 90) == {"frown": 0.5}
    assert shown(face, 5) == {}
    assert shown(face, 120) == {}


def test_what_adds_to_a_clip_shows_with_it(face: Any) -> None:
    lay(face, "long", {"smile": 0.5}, 10.0, end=110.0)
    lay(face, "added", {"smile": 0.25, "frown": 0.5}, 80.0, adding=True)
    assert shown(face, 50) == {"smile": 0.5}
    assert shown(face, 85) == {"smile": 0.75, "frown": 0.5}


@pytest.mark.parametrize("left", [["first"], ["second"], []])
def test_taking_off_leaves_the_others_playing_and_the_rest_at_rest(face: Any, left: list[str]) -> None:
    lay(face, "first", {"smile": 1.0, NAMES[2]: 1.0}, 10.0)
    lay(face, "second", {"frown": 1.0, NAMES[2]: 0.5}, 20.0)
    shown(face, 25)
    remove_rig_clips(face, [clip for clip in ("first", "second") if clip not in left])
    bpy.context.view_layer.update()
    if not left:
        assert [key.value for key in face.data.shape_keys.key_blocks] == [0.0] * 4
    assert shown(face, 15) == ({"smile": 1.0, NAMES[2]: 1.0} if left == ["first"] else {})
    assert shown(face, 30) == ({"frown": 1.0, NAMES[2]: 0.5} if left == ["second"] else {})
    assert shown(face, 60) == {}


def test_an_action_that_keys_other_things_stays_the_one_that_plays(face: Any) -> None:
    animate(face, "frown", 1, 50)
    action = face.data.shape_keys.animation_data.action
    channel = Channel("smile", Place(face.data.shape_keys, data_path("smile")), 0.0, 1.0)
    write_rig_clip(face, "joy", Keyframes(np.array([1.0, 10.0, 20.0]), {channel: np.array([0.0, 1.0, 0.0])}))
    assert face.data.shape_keys.animation_data.action == action
    assert shown(face, 10)["smile"] == 1.0
    assert shown(face, 50) == {"frown": 0.6}


def test_a_clip_on_top_of_an_animation_adds_to_it_and_leaves_it_as_it_was(face: Any) -> None:
    animate(face, "smile", 1, 50)
    before = [shown(face, frame) for frame in range(1, 60)]
    action = face.data.shape_keys.animation_data.action
    lay(face, "joy", {"smile": 0.3, "frown": 0.5}, 10.0)
    under = before[19]["smile"]
    assert shown(face, 20) == {"smile": pytest.approx(under + 0.3, abs=2e-4), "frown": 0.5}
    remove_rig_clips(face)
    assert face.data.shape_keys.animation_data.action == action
    assert not face.data.shape_keys.animation_data.nla_tracks
    assert [shown(face, frame) for frame in range(1, 60)] == before


def test_a_clip_is_no_part_of_the_resting_face_and_no_animation_of_the_users(face: Any) -> None:
    keys = face.data.shape_keys
    steady = Channel("smile", Place(keys, data_path("smile")), 0.0, 1.0)
    write_rig_clip(face, "steady", Keyframes(np.array([1.0, 20.0]), {steady: np.array([0.4, 0.4])}))
    lay(face, "moving", {"frown": 1.0}, 30.0)
    for frame in (10, 40):
        shown(face, frame)
        assert resting_values(face.data) == {}
        assert moving_keys(face.data) == ()
        assert shown_remarks(face) == ()
    animate(face, NAMES[2], 1, 50)
    shown(face, 40)
    assert moving_keys(face.data) == (NAMES[2],)
