"""Baking a timeline: one motion with markers, or a strip per clip; what is out of date says so."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np
import pytest
import risorius.api as api
from risorius.errors import SolverError
from risorius.face.face import Face
from risorius.operators.active import object_of
from risorius.operators.bake.settings import stale_clips
from risorius.operators.emotion.performance import drawn_ways, performance_of
from risorius.operators.emotion.profile import Wanted
from risorius.scene.bake import shape_keys
from risorius.scene.bake.notes import BakeKind
from risorius.scene.fingerprint import uid_of
from risorius.scene.mesh import key_vertices


def clip(obj: Any, word: str, start: int, **times: float) -> None:
    """A short clip."""
    timeline = obj.risorius.timeline
    timeline.linked = False
    obj.risorius.emotion.word = word
    bpy.context.scene.frame_set(start)
    bpy.ops.risorius.add_clip()
    made = timeline.clips[timeline.active]
    for name, value in {"onset": 0.2, "apex": 0.2, "offset": 0.2, **times}.items():
        setattr(made, name, value)


def shown(obj: Any, frame: int) -> np.ndarray:
    """Displacement (V, 3) of the evaluated head at a frame."""
    bpy.context.scene.frame_set(frame)
    mesh = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    there = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("co", there)
    return there.reshape(-1, 3) - key_vertices(obj.data.shape_keys.key_blocks["Basis"])


@pytest.mark.slow
def test_one_motion_is_the_apis_performance_with_a_marker_per_clip(head: Any) -> None:
    bpy.context.scene.render.fps = 25
    clip(head, "joy", 3)
    clip(head, "surprise", 11)
    head.risorius.timeline.variation.head = 1.0
    assert bpy.ops.risorius.bake_motion() == {"FINISHED"}
    action = head.data.shape_keys.animation_data.action
    assert [(marker.name, marker.frame) for marker in action.pose_markers] == [("joy", 3), ("surprise", 11)]
    assert tuple(action.frame_range) == (3.0, 26.0)
    face = api.default_face()
    cues = [
        api.Cue(api.expression(word), start=start, onset=0.2, apex=0.2, offset=0.2)
        for word, start in (("joy", 0.0), ("surprise", 0.32))
    ]
    lively = api.Liveliness(head=api.Drawn(1.0, 1))
    frames = list(face.performance(cues, 25.0, liveliness=lively))
    for frame in (12, 18):
        np.testing.assert_allclose(shown(head, frame), frames[frame - 3] - face.vertices, atol=2e-4)


@pytest.mark.slow
def test_strips_add_up_to_the_poses_shares_where_clips_overlap(head: Any) -> None:
    bpy.context.scene.render.fps = 25
    clip(head, "joy", 1, apex=0.6)
    clip(head, "anger", 13, apex=0.6)
    clip(head, "joy", 60)
    assert bpy.ops.risorius.bake_strips() == {"FINISHED"}
    keys = head.data.shape_keys
    assert [block.name for block in keys.key_blocks] == ["Basis", "joy", "anger", "joy 2"]
    tracks = keys.animation_data.nla_tracks
    assert [[round(strip.frame_start) for strip in track.strips] for track in tracks] == [[1, 60], [13]]
    assert keys.animation_data.action is None
    performance = performance_of(head, bpy.context.scene)
    for frame in (8, 15, 18, 24, 45, 66):
        bpy.context.scene.frame_set(frame)
        values = [keys.key_blocks[name].value for name in ("joy", "anger", "joy 2")]
        assert values == pytest.approx(performance.shares(float(frame)).tolist(), abs=0.03), frame
    posed = api.default_face().pose(api.expression("joy").frame(), emotion=api.expression("joy").weights)
    np.testing.assert_allclose(shown(head, 66), posed.positions - api.default_face().vertices, atol=2e-6)


@pytest.mark.slow
def test_strips_of_clips_that_are_gone_go_with_the_next_bake(head: Any) -> None:
    clip(head, "joy", 1)
    clip(head, "anger", 30)
    bpy.ops.risorius.bake_strips()
    bpy.ops.risorius.remove_clip()
    assert dict(stale_clips(head, bpy.context.scene)) == {"anger": BakeKind.STRIP}
    bpy.ops.risorius.bake_again()
    assert list(shape_keys.read_own(head.data).clips) == ["joy"]
    assert len(bpy.data.actions) == 1
    bpy.ops.risorius.clear()
    assert not bpy.data.actions
    assert head.data.shape_keys is None


@pytest.mark.slow
def test_what_is_out_of_date_says_so_until_it_is_baked_again(head: Any) -> None:
    scene = bpy.context.scene
    clip(head, "joy", 1)
    bpy.ops.risorius.bake_strips()
    assert not stale_clips(head, scene)
    assert not bpy.ops.risorius.bake_again.poll()
    made = head.risorius.timeline.clips[0]
    for name, value in (("start", 5), ("peak", 0.5), ("apex", 0.4)):
        before = getattr(made, name)
        setattr(made, name, value)
        assert set(stale_clips(head, scene)) == {"joy"}, name
        setattr(made, name, before)
        assert not stale_clips(head, scene), name
    made.emotion.activation = 3.0
    assert bpy.ops.risorius.bake_again() == {"FINISHED"}
    assert not stale_clips(head, scene)


@pytest.mark.slow
def test_a_baked_expression_is_out_of_date_only_for_its_own_word(head: Any) -> None:
    scene, emotion = bpy.context.scene, head.risorius.emotion
    bpy.ops.risorius.bake_expression()
    emotion.word = "fear"
    assert not stale_clips(head, scene)
    emotion.word = "joy"
    assert not stale_clips(head, scene)
    emotion.activation = 2.0
    assert dict(stale_clips(head, scene)) == {"joy": BakeKind.EXPRESSION}


@pytest.mark.slow
def test_a_bake_that_fails_or_is_cancelled_changes_nothing(head: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    from risorius.operators.bake.ops import strips_work

    clip(head, "joy", 1)
    clip(head, "anger", 30)
    work = strips_work(head, bpy.context.scene)
    for _ in range(4):
        next(work)
    work.close()
    assert head.data.shape_keys is None
    assert not bpy.data.actions

    def failing(*_: Any, **__: Any) -> None:
        raise SolverError("no balance")

    monkeypatch.setattr(Face, "pose", failing)
    with pytest.raises(RuntimeError, match="no balance"):
        bpy.ops.risorius.bake_strips()
    assert head.data.shape_keys is None


def test_draws_differ_between_clips_of_one_word_and_follow_the_seed(head: Any) -> None:
    clip(head, "joy", 1)
    clip(head, "joy", 30)
    variation = head.risorius.timeline.variation

    def drawn() -> list[np.ndarray]:
        return [wanted.faps for wanted in performance_of(head, bpy.context.scene).wanted]

    same = drawn()
    np.testing.assert_array_equal(*same)
    variation.draws = 0.5
    first = drawn()
    assert np.nanmax(np.abs(first[0] - first[1])) > 5.0
    variation.draws_seed = 2
    assert np.nanmax(np.abs(first[0] - drawn()[0])) > 5.0
    for wanted, cue in zip(drawn(), performance_of(head, bpy.context.scene).cues, strict=True):
        np.testing.assert_array_equal(wanted, cue.profile.frame())


def test_the_way_of_showing_an_emotion_is_drawn_and_said(head: Any) -> None:
    for start in range(1, 302, 30):
        clip(head, "anger", start)
    head.risorius.timeline.clips[0].emotion.variant = "pressed"
    head.risorius.timeline.variation.draws = 1.0

    def shown() -> list[tuple[str, Wanted]]:
        performance = performance_of(head, bpy.context.scene)
        return list(zip(performance.titles, performance.wanted, strict=True))

    ways = [wanted.profile.prototypes["anger"] for _, wanted in shown()]
    assert ways[0] == "pressed"
    assert set(ways[1:]) == {"bared", "pressed", "glaring"}
    said = drawn_ways(shown())
    assert len(said) == len(ways) - 1  # the first was chosen
    assert said[0] == f"{shown()[1][0]}: anger is shown {ways[1]}, drawn by its seed"
    head.risorius.emotion.drive = "exact"
    assert drawn_ways(shown()) == ()


def test_muted_clips_grey_the_bakes_with_a_reason(head: Any) -> None:
    clip(head, "joy", 1)
    assert bpy.ops.risorius.bake_motion.poll()
    head.risorius.timeline.clips[0].mute = True
    assert not bpy.ops.risorius.bake_motion.poll()
    assert not bpy.ops.risorius.bake_strips.poll()
    assert object_of(uid_of(head)) == head
