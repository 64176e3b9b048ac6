"""The timeline: clips are added, moved, edited in the Emotion panel, and played as the API blends them."""

from __future__ import annotations

from contextlib import ExitStack
from typing import Any

import bpy
import numpy as np
import pytest
import risorius.api as api
from risorius.operators.changes import listen, listen_to_time
from risorius.operators.emotion.performance import performance_of
from risorius.operators.timeline.titles import clip_title

pytestmark = pytest.mark.smoke


def add(obj: Any, word: str, start: int) -> Any:
    """A clip of a word, by the operator; returns it."""
    timeline = obj.risorius.timeline
    timeline.linked = False
    obj.risorius.emotion.word = word
    bpy.context.scene.frame_set(start)
    assert bpy.ops.risorius.add_clip() == {"FINISHED"}
    return timeline.clips[timeline.active]


def titles(obj: Any) -> list[str]:
    return [clip_title(clip) for clip in obj.risorius.timeline.clips]


def test_a_clip_is_what_the_emotion_panel_shows_at_the_current_frame(head: Any) -> None:
    emotion = head.risorius.emotion
    emotion.word, emotion.seed = "fear", 5
    emotion.variant, emotion.activation = "8", 6.0
    bpy.context.scene.frame_set(37)
    bpy.ops.risorius.add_clip()
    (clip,) = head.risorius.timeline.clips
    shown = (clip.emotion.word, clip.emotion.variant, round(clip.emotion.activation, 4), clip.emotion.seed)
    assert shown == ("fear", "8", 6.0, 5)
    assert clip.start == 37


def test_the_panel_edits_the_selected_clip_while_linked(head: Any) -> None:
    timeline, emotion = head.risorius.timeline, head.risorius.emotion
    add(head, "joy", 1)
    add(head, "anger", 50)
    timeline.linked = True
    timeline.active = 0
    assert emotion.word == "joy"
    emotion.word = "sadness"
    emotion.activation = 2.0
    assert titles(head) == ["sadness", "anger"]
    assert timeline.clips[0].emotion.activation == pytest.approx(2.0)
    timeline.linked = False
    emotion.word = "disgust"
    assert titles(head) == ["sadness", "anger"]


def test_a_script_that_changes_a_clip_changes_the_panel(head: Any) -> None:
    add(head, "joy", 1)
    head.risorius.timeline.linked = True
    head.risorius.timeline.clips[0].emotion.word = "fear"
    assert head.risorius.emotion.word == "fear"
    assert head.risorius.timeline.clips[0].emotion.word == "fear"


def test_the_performance_is_the_apis_sequence(head: Any) -> None:
    bpy.context.scene.render.fps = 25
    first = add(head, "joy", 11)
    first.peak = 0.5
    second = add(head, "anger", 31)
    second.onset, second.ramp, second.peak = 0.2, "cosine", 1.0
    performance = performance_of(head, bpy.context.scene)
    cues = [
        api.Cue(api.expression("joy"), onset=0.5, apex=1.2, offset=0.8, peak=0.5),
        api.Cue(api.expression("anger"), start=0.8, onset=0.2, apex=1.2, offset=0.8, ramp=api.Ramp.COSINE),
    ]
    assert performance.first_frame == 11.0
    np.testing.assert_allclose(api.sequence(performance.cues), api.sequence(cues), rtol=1e-5, atol=1e-3)


def test_mute_and_solo_decide_what_plays(head: Any) -> None:
    for number, word in enumerate(("joy", "anger", "fear")):
        add(head, word, 1 + 10 * number)
    clips = head.risorius.timeline.clips

    def playing() -> list[str]:
        return [str(cue.profile.word) for cue in performance_of(head, bpy.context.scene).cues]

    clips[0].mute = True
    assert playing() == ["anger", "fear"]
    clips[2].solo = True
    assert playing() == ["fear"]
    clips[2].solo, clips[1].mute, clips[2].mute = False, True, True
    assert playing() == []
    assert not performance_of(head, bpy.context.scene).shares(15.0).any()


def test_clips_are_moved_duplicated_sorted_and_removed(head: Any) -> None:
    for start, word in ((40, "joy"), (20, "anger"), (1, "fear")):
        add(head, word, start)
    timeline = head.risorius.timeline
    bpy.ops.risorius.move_clip(direction="UP")
    assert titles(head) == ["joy", "fear", "anger"]
    assert timeline.active == 1
    timeline.clips[1].peak = 0.3
    bpy.ops.risorius.duplicate_clip()
    assert titles(head) == ["joy", "fear", "fear", "anger"]
    assert timeline.clips[2].peak == pytest.approx(0.3)
    assert timeline.clips[2].start == 1 + round(2.5 * bpy.context.scene.render.fps)
    timeline.active = 3
    bpy.ops.risorius.sort_clips()
    assert titles(head) == ["fear", "anger", "joy", "fear"]
    assert timeline.active == 1
    bpy.ops.risorius.remove_clip()
    assert titles(head) == ["fear", "joy", "fear"]
    bpy.ops.risorius.clear_clips()
    assert titles(head) == []
    assert not bpy.ops.risorius.remove_clip.poll()


def test_a_timing_preset_sets_all_times(head: Any) -> None:
    clip = add(head, "joy", 1)
    bpy.ops.risorius.time_clip(timing="spontaneous")
    preset = api.load_timings()["spontaneous"]
    times = [clip.onset, clip.apex, clip.offset, clip.peak]
    assert times == pytest.approx([preset.onset, preset.apex, preset.offset, preset.peak])
    assert clip.ramp == preset.ramp


def test_retiming_a_clip_tells_the_preview(head: Any) -> None:
    clip = add(head, "joy", 1)
    heard: list[Any] = []
    with ExitStack() as undo:
        listen_to_time(heard.append, undo)
        clip.start = 20
        clip.mute = True
    assert heard == [head, head]


def test_the_face_is_asked_to_show_the_clip_that_is_added_or_selected(head: Any) -> None:
    add(head, "joy", 1)
    add(head, "fear", 20)
    timeline = head.risorius.timeline
    timeline.linked = True
    heard: list[tuple[Any, str]] = []

    def listener(obj: Any) -> None:
        heard.append((obj, obj.risorius.emotion.word))

    with ExitStack() as undo:
        listen(listener, undo)
        timeline.active = 0
        assert heard[-1] == (head, "joy")
        heard.clear()
        bpy.ops.risorius.add_clip()
    assert heard[-1] == (head, "joy")
    assert titles(head) == ["joy", "fear", "joy"]


def test_one_undo_takes_an_added_clip_back(head: Any) -> None:
    bpy.ops.ed.undo_push(message="start")
    assert bpy.ops.risorius.add_clip("EXEC_DEFAULT", True) == {"FINISHED"}
    assert len(bpy.context.object.risorius.timeline.clips) == 1
    bpy.ops.ed.undo()
    assert len(bpy.context.object.risorius.timeline.clips) == 0
