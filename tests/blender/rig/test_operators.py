"""Baking to the keys that a face has, by the buttons: what is keyed and told, baked again and taken off."""

from __future__ import annotations

import itertools
from pathlib import Path
from typing import Any

import bpy
import file_state
import numpy as np
import pytest
import risorius.api as api
from risorius.operators.bake.settings import stale_clips, stale_rig_clips
from risorius.operators.bake.work import expression_work
from risorius.scene.bake.notes import BakeKind
from risorius.scene.live.reading import FaceReader
from risorius.scene.rig.kept import kept_clips

pytestmark = pytest.mark.slow


@pytest.fixture
def face(drawn_head: Any) -> Any:
    """The head with keys of its own, to be baked to them."""
    drawn_head.risorius.bake.onto = "KEYS"
    return drawn_head


def clip(obj: Any, word: str, start: int) -> Any:
    """A short clip on the timeline."""
    obj.risorius.timeline.linked = False
    obj.risorius.emotion.word = word
    bpy.context.scene.frame_set(start)
    bpy.ops.risorius.add_clip()
    made = obj.risorius.timeline.clips[obj.risorius.timeline.active]
    made.onset = made.apex = made.offset = 0.2
    return made


def names(obj: Any) -> list[str]:
    """The keys there are."""
    return [key.name for key in obj.data.shape_keys.key_blocks]


def values(obj: Any, frame: int) -> dict[str, float]:
    """The keys that show at a frame."""
    bpy.context.scene.frame_set(frame)
    return {key.name: key.value for key in obj.data.shape_keys.key_blocks if key.value > 1e-5}


def displaced(obj: Any, frame: int) -> np.ndarray:
    """(V, 3) what shows at a frame, from the rest position."""
    bpy.context.scene.frame_set(frame)
    mesh = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    there, rest = np.empty(3 * len(mesh.vertices)), np.empty(3 * len(mesh.vertices))
    mesh.vertices.foreach_get("co", there)
    obj.data.shape_keys.key_blocks["Basis"].data.foreach_get("co", rest)
    return (there - rest).reshape(-1, 3)


def test_an_expression_goes_to_the_keys_there_are_and_says_how_far_they_follow(
    face: Any, capfd: pytest.CaptureFixture[str]
) -> None:
    before = names(face)
    face.data.shape_keys.key_blocks["nose"].mute = True
    assert bpy.ops.risorius.bake_expression() == {"FINISHED"}
    assert names(face) == before
    profile = api.expression("joy", activation=face.risorius.emotion.activation)
    wanted = api.default_face().pose(profile.frame(), emotion=profile.weights).positions - api.default_face().vertices
    shown = displaced(face, 20)
    kept = kept_clips(face)["joy"].followed
    assert kept is not None
    assert kept.explained > 0.6
    skin = api.default_face().outer_skin
    left = float(((shown - wanted)[skin] ** 2).sum() / (wanted[skin] ** 2).sum())
    assert 1.0 - left == pytest.approx(kept.explained, abs=0.02)
    assert "smile_L" in kept.carriers
    told = capfd.readouterr()
    lines = (told.out + told.err).splitlines()
    assert [line for line in lines if line.startswith("Info") and f"{kept.explained:.0%}" in line and "mm" in line]
    assert [line for line in lines if line.startswith("Warning") and "nose: is muted" in line]
    assert not [line for line in lines if line.startswith("Warning") and "the controls show" in line]
    assert not [line for line in lines if "adds to the bake" in line]


def test_baking_again_replaces_wherever_the_playhead_is(face: Any, capfd: pytest.CaptureFixture[str]) -> None:
    bpy.ops.risorius.bake_expression()
    first = values(face, 20)
    capfd.readouterr()
    assert bpy.ops.risorius.bake_expression() == {"FINISHED"}
    assert values(face, 20) == pytest.approx(first, abs=1e-6)
    assert len(bpy.data.actions) == 1
    assert "Warning" not in "".join(line for line in capfd.readouterr() if "left alone" in line)


def test_clips_on_the_rig_are_stale_for_what_they_are_made_of_alone(face: Any) -> None:
    scene, chosen = bpy.context.scene, face.risorius.bake
    bpy.ops.risorius.bake_expression()
    for name, value in (("onto", "NEW"), ("above", False), ("smooth", 3.0), ("creases", True)):
        before = getattr(chosen, name)
        setattr(chosen, name, value)
        assert not stale_rig_clips(face, scene), name
        setattr(chosen, name, before)
    for owner, name, value in ((chosen, "symmetric", True), (chosen, "apex", 2.0), (face.risorius.emotion, "seed", 3)):
        before = getattr(owner, name)
        setattr(owner, name, value)
        assert list(stale_rig_clips(face, scene)) == ["joy"], name
        setattr(owner, name, before)
        assert not stale_rig_clips(face, scene), name
    face.risorius.emotion.activation = 2.0
    chosen.onto = "NEW"
    assert not stale_clips(face, scene)
    assert bpy.ops.risorius.bake_again() == {"FINISHED"}
    assert not stale_rig_clips(face, scene)
    assert "joy" not in names(face)


def test_strips_add_up_where_they_overlap_and_go_with_their_clips(face: Any) -> None:
    clip(face, "joy", 1)
    clip(face, "surprise", 8)
    assert bpy.ops.risorius.bake_strips() == {"FINISHED"}
    assert {name: kept.note.kind for name, kept in kept_clips(face).items()} == {
        "joy": BakeKind.STRIP,
        "surprise": BakeKind.STRIP,
    }
    both = displaced(face, 11)
    joy, surprise = (displaced(face, frame) for frame in (6, 16))
    skin = api.default_face().outer_skin
    flat = np.stack([joy[skin].ravel(), surprise[skin].ravel()], axis=1)
    shares, *_ = np.linalg.lstsq(flat, both[skin].ravel(), rcond=None)
    assert (shares > 0.2).all()
    assert np.linalg.norm(flat @ shares - both[skin].ravel()) < 0.15 * np.linalg.norm(both[skin])
    face.risorius.timeline.active = 1
    bpy.ops.risorius.remove_clip()
    assert list(stale_rig_clips(face, bpy.context.scene)) == ["joy", "surprise"]
    bpy.ops.risorius.bake_again()
    assert list(kept_clips(face)) == ["joy"]
    assert values(face, 19) == {}


def test_a_motion_has_markers_and_lasts_as_long_as_its_clips(face: Any) -> None:
    clip(face, "joy", 3)
    clip(face, "surprise", 20)
    assert bpy.ops.risorius.bake_motion() == {"FINISHED"}
    (kept,) = kept_clips(face).values()
    assert kept.note.markers == (("joy", 3.0), ("surprise", 20.0))
    assert values(face, 10).keys() >= {"smile_L", "smile_R"}
    assert kept.frames == (3.0, 35.0)


def test_six_emotions_come_one_after_another_on_the_users_keys(face: Any) -> None:
    before = names(face)
    assert bpy.ops.risorius.bake_six() == {"FINISHED"}
    assert names(face) == before
    kept = kept_clips(face)
    assert list(kept) == ["joy", "surprise", "fear", "anger", "sadness", "disgust"]
    spans = [clip.frames for clip in kept.values()]
    assert all(one[1] <= other[0] for one, other in itertools.pairwise(spans))
    assert "smile_L" in values(face, int(np.mean(spans[0])))
    assert "browDown" in values(face, int(np.mean(spans[3])))
    assert values(face, round(spans[2][1]) + 1) == {}


def test_taking_clips_off_gives_back_what_was_there(face: Any) -> None:
    keys = face.data.shape_keys
    for frame, value in ((1, 0.1), (60, 0.5)):
        keys.key_blocks["smile_L"].value = value
        keys.key_blocks["smile_L"].keyframe_insert("value", frame=frame)
    bpy.context.scene.frame_set(20)
    before = file_state.file_state()
    bpy.ops.risorius.bake_expression()
    face.risorius.emotion.word = "anger"
    bpy.ops.risorius.bake_expression()
    assert set(kept_clips(face)) == {"joy", "anger"}
    assert bpy.ops.risorius.clear(clip="joy", on_rig=True) == {"FINISHED"}
    assert list(kept_clips(face)) == ["anger"]
    assert bpy.ops.risorius.clear() == {"FINISHED"}
    bpy.context.scene.frame_set(20)
    face.risorius.emotion.word = "joy"
    assert file_state.differences(before, file_state.file_state()) == []
    assert not bpy.ops.risorius.clear.poll()


def test_into_the_action_the_users_own_keyframes_are_kept_outside_the_clip(face: Any) -> None:
    keys = face.data.shape_keys
    for frame, value in ((-20, 0.0), (-10, 0.25), (120, 0.25)):
        keys.key_blocks["smile_L"].value = value
        keys.key_blocks["smile_L"].keyframe_insert("value", frame=frame)
    action = keys.animation_data.action
    face.risorius.bake.above = False
    assert bpy.ops.risorius.bake_expression() == {"FINISHED"}
    assert keys.animation_data.action == action
    assert not keys.animation_data.nla_tracks
    assert values(face, 20)["smile_L"] > 0.3
    assert values(face, -10)["smile_L"] == values(face, 120)["smile_L"] == pytest.approx(0.25)
    assert "smile_L" not in values(face, -20)


def test_clips_of_new_keys_at_the_same_frames_are_warned_of(face: Any, capfd: pytest.CaptureFixture[str]) -> None:
    bpy.ops.risorius.bake_expression()
    face.risorius.bake.onto = "NEW"
    capfd.readouterr()
    bpy.ops.risorius.bake_expression()
    told = "".join(capfd.readouterr())
    assert "joy on the rig and joy of new shape keys play at the same frames and add up" in told
    assert "adds to the bake" not in told
    assert bpy.ops.risorius.clear(clip="joy") == {"FINISHED"}
    assert list(kept_clips(face)) == ["joy"]
    face.risorius.emotion.word, face.risorius.bake.start = "anger", 300
    capfd.readouterr()
    bpy.ops.risorius.bake_expression()
    assert "add up" not in "".join(capfd.readouterr())


def test_a_stream_goes_to_the_users_keys(face: Any, tmp_path: Path) -> None:
    frames = np.full((10, 68), np.nan)
    frames[:, 2] = np.linspace(0.0, 400.0, 10)
    path = tmp_path / "opening.fap"
    api.write_fap(path, api.FapStream(frames, fps=24.0))
    before = names(face)
    bpy.context.scene.frame_set(31)
    assert bpy.ops.risorius.import_fap(filepath=str(path)) == {"FINISHED"}
    assert names(face) == before
    assert kept_clips(face)["opening"].frames == (31.0, 40.0)
    assert values(face, 40)["Jaw Drop"] > 0.5


def test_closed_early_nothing_has_changed(face: Any) -> None:
    before = file_state.file_state()
    work = expression_work(face, bpy.context.scene)
    for step in work:
        if step.fraction > 0.7:
            break
    work.close()
    assert file_state.differences(before, file_state.file_state()) == []


def test_without_keys_of_its_own_the_buttons_say_so(head: Any) -> None:
    head.risorius.bake.onto = "KEYS"
    with pytest.raises(RuntimeError, match="has no shape keys of its own: bake to New Keys"):
        bpy.ops.risorius.bake_expression()
    with pytest.raises(RuntimeError, match="has no shape keys of its own: bake to New Keys"):
        bpy.ops.risorius.bake_six()
    head.risorius.bake.onto = "BONES"
    with pytest.raises(RuntimeError, match="has no armature: bake to New Keys or My Keys"):
        bpy.ops.risorius.bake_motion()


def test_bones_are_baked_to_again_and_taken_off(rigged: Any) -> None:
    head, bones = rigged.head, rigged.bones
    bones["jaw"].rotation_mode = "XYZ"
    bpy.context.view_layer.objects.active = head
    head.risorius.bake.onto, head.risorius.emotion.word = "BONES", "surprise"
    before = posed(bones)
    assert bpy.ops.risorius.bake_expression() == {"FINISHED"}
    kept = kept_clips(head)["surprise"]
    assert kept.note.onto == "bones"
    assert kept.followed.explained > 0.3
    bpy.context.scene.frame_set(20)
    shown = posed(bones)
    assert np.abs(shown - before).max() > 0.01
    assert bpy.ops.risorius.bake_expression() == {"FINISHED"}
    bpy.context.scene.frame_set(20)
    np.testing.assert_allclose(posed(bones), shown, atol=1e-5)
    assert kept_clips(head)["surprise"].followed.explained == pytest.approx(kept.followed.explained, abs=1e-6)
    assert bpy.ops.risorius.clear() == {"FINISHED"}
    bpy.context.view_layer.update()
    np.testing.assert_allclose(posed(bones), before, atol=1e-6)
    assert rigged.rig.animation_data is None or rigged.rig.animation_data.action is None
    assert head.data.shape_keys is None


def test_new_keys_rest_on_the_face_without_the_clips_on_its_bones(rigged: Any) -> None:
    head = rigged.head
    bpy.context.view_layer.objects.active = head
    head.risorius.bake.onto, head.risorius.emotion.word = "BONES", "surprise"
    bpy.ops.risorius.bake_expression()
    bpy.context.scene.frame_set(20)
    head.risorius.bake.onto, head.risorius.emotion.word = "NEW", "joy"
    bpy.ops.risorius.bake_expression()
    at_apex = key_change(head, "joy")
    bpy.ops.risorius.clear()
    bpy.context.scene.frame_set(20)
    bpy.ops.risorius.bake_expression()
    np.testing.assert_allclose(at_apex, key_change(head, "joy"), atol=1e-6)


def posed(bones: Any) -> np.ndarray:
    """(B, 4, 4) where the bones are."""
    return np.array([[list(row) for row in bone.matrix_basis] for bone in bones])


def key_change(head: Any, name: str) -> np.ndarray:
    """(3V,) what a key adds to the Basis."""
    blocks, size = head.data.shape_keys.key_blocks, 3 * len(head.data.vertices)
    there, rest = np.empty(size), np.empty(size)
    blocks[name].data.foreach_get("co", there)
    blocks["Basis"].data.foreach_get("co", rest)
    return there - rest


@pytest.mark.parametrize("onto", ["KEYS", "BONES"])
def test_what_the_controls_show_is_read_off_the_face_wherever_the_playhead_is(
    onto: str, request: pytest.FixtureRequest
) -> None:
    head = request.getfixturevalue("drawn_head") if onto == "KEYS" else request.getfixturevalue("rigged").head
    bpy.context.view_layer.objects.active = head
    head.risorius.bake.onto, head.risorius.emotion.word = onto, "surprise"
    bpy.ops.risorius.bake_expression()
    bpy.context.scene.frame_set(20)
    reading = FaceReader(head).read(bpy.context.evaluated_depsgraph_get(), rule="robust")
    assert not reading.is_resting
    assert reading.faps[2] > 50.0, "the jaw is open"
    assert (reading.faps[[30, 31]] > 50.0).all(), "the brows are raised"
    bpy.context.scene.frame_set(200)
    assert FaceReader(head).read(bpy.context.evaluated_depsgraph_get()).is_resting
