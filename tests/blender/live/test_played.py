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
