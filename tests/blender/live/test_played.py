"""A motion that is not baked plays as it will be, as soon as it is worked out."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np
import pytest
import risorius.api as api
from risorius.operators.bake.settings import played_settings
from risorius.operators.emotion.performance import performance_of
from risorius.operators.preview import live
from risorius.progress import run
from risorius.scene.bake.motion import CueMotion
from risorius.scene.bake.target import Target
from risorius.scene.live import played as played_module
from risorius.scene.live import preview
from risorius.scene.live.live_face import LiveFace
from risorius.scene.live.played import PlayedMotion

FPS = 10.0
CUE = api.Cue(api.expression("joy"), onset=0.2, apex=0.0, offset=0.2)


def motion_of_joy(face: api.Face) -> PlayedMotion:
    """A short smile from frame 5 on."""
    return PlayedMotion(face, CueMotion([CUE]), first_frame=5.0, fps=FPS, drive="natural")


@pytest.mark.slow
def test_its_frames_are_those_of_a_bake() -> None:
    face = api.default_face()
    played = motion_of_joy(face)
    assert played.at(6.0) is None
    run(played.work())
    baked = [positions - face.vertices for positions in face.performance([CUE], FPS)]
    for number, displacement in enumerate(baked):
        assert np.abs(played.at(5.0 + number) - displacement).max() < 1e-8
    assert np.abs(played.at(6.25) - (0.75 * baked[1] + 0.25 * baked[2])).max() < 1e-8
    for outside in (4.0, 5.0 + len(baked)):
        assert not played.at(outside).any()


@pytest.mark.slow
def test_no_more_is_held_than_may_be(monkeypatch: pytest.MonkeyPatch) -> None:
    face = api.default_face()
    monkeypatch.setattr(played_module, "MOST", 2 * 4 * face.vertices.size)
    played = motion_of_joy(face)
    run(played.work())
    assert [played.at(5.0 + number) is not None for number in range(5)] == [True, True, False, False, False]


@pytest.mark.slow
def test_blinks_show_where_no_expression_does(head: Any) -> None:
    head.risorius.timeline.variation.blinks = 60.0
    bpy.context.scene.frame_set(1)
    assert bpy.ops.risorius.add_clip() == {"FINISHED"}
    face = LiveFace(Target(head))
    live.play(head, face, bpy.context.scene)
    while face.has_more:
        face.go_on()
    performance = performance_of(head, bpy.context.scene)
    played = face.played(
        played_settings(head, performance),
        CueMotion([]),
        first_frame=performance.first_frame,
        fps=performance.fps,
        drive="natural",
    )
    still = list(face._face.performance(performance.cues, performance.fps))
    shown = [played.at(performance.first_frame + number) for number in range(len(still))]
    beside = [np.abs(each - (without - face._face.vertices)).max() for each, without in zip(shown, still, strict=True)]
    assert max(beside) > 3e-3


@pytest.mark.slow
def test_until_it_is_worked_out_the_apex_shows_and_thereafter_the_motion(head: Any) -> None:
    scene = bpy.context.scene
    head.risorius.emotion.word = "joy"
    scene.frame_set(1)
    assert bpy.ops.risorius.add_clip() == {"FINISHED"}
    performance, face = performance_of(head, scene), LiveFace(Target(head))
    shown: list[Any] = []
    show = face.show

    def watched(target: Target, displacement: Any) -> None:
        shown.append(displacement)
        show(target, displacement)

    face.show = watched  # type: ignore[method-assign]
    scene.frame_set(int(performance.apex()) - 2)
    live.play(head, face, scene)
    first = face._played
    while face._motion is not None:
        face.go_on()
    live.play(head, face, scene)
    assert face._played is first
    off = np.linalg.norm(shown[1] - shown[0], axis=1).max()
    assert 1e-5 < off < 5e-3  # the skin's inertia, and the way there
    scene.frame_set(int(performance.span(0)[1]) + 10)
    live.play(head, face, scene)
    assert len(shown) == 2
    assert not preview.is_shown(head)
    head.risorius.timeline.clips[0].peak = 0.5
    live.play(head, face, scene)
    assert face._played is not first
    face.drop()
    assert not face.has_more


@pytest.mark.slow
def test_speech_shows_with_the_feeling_before_it_is_worked_out_and_thereafter(head: Any, tmp_path: Any) -> None:
    scene = bpy.context.scene
    scene.render.fps = 10
    path = tmp_path / "line.txt"
    path.write_text("0.0 0.2 a\n0.2 0.4 m\n0.4 0.6 a\n", encoding="utf-8")
    speech = head.risorius.speech
    speech.source, speech.timings = "TIMINGS", str(path)
    head.risorius.emotion.word = "surprise"
    scene.frame_set(5)
    assert bpy.ops.risorius.add_speech() == {"FINISHED"}
    face = LiveFace(Target(head))
    shown: list[Any] = []
    face.show = lambda target, displacement: shown.append(displacement)  # type: ignore[method-assign]

    def measured(frame: int) -> Any:
        scene.frame_set(frame)
        live.play(head, face, scene)
        return api.default_face().measure(api.default_face().vertices + shown[-1])

    lips, brow = [api.fap(name).number - 1 for name in ("raise_b_midlip", "lower_t_midlip")], 30
    sketched = measured(6), measured(8)
    assert sketched[0][lips].sum() < -80.0  # an open mouth
    assert sketched[1][lips].sum() > -5.0  # closed for m
    assert sketched[1][brow] > 100.0  # the brow is the emotion's
    first = len(shown)
    while face._motion is not None:
        face.go_on()
    worked_out = measured(6), measured(8)
    for one, other in zip(sketched, worked_out, strict=True):
        assert np.abs(one - other)[lips].max() < 12.0
    assert np.linalg.norm(shown[first] - shown[0], axis=1).max() < 2e-3
    speech.strips[0].mute = True
    live.play(head, face, scene)
    assert face._played is not None
    assert face._played[1].motion.frame_count(10.0) != 8
