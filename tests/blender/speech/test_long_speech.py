"""Long speech in Blender: worked out bit by bit, seen before it is, and cancelled without a trace."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest
import risorius.api as api
from risorius.operators.bake.work import motion_work
from risorius.progress import run
from risorius.scene.bake.speech_motion import SpeechMotion
from risorius.scene.live.played import PlayedMotion
from risorius.speech.accompaniment import BY_RULE

from ...long_speech import lasting

FPS = 10.0
CUES = [api.Cue(api.expression("joy"), onset=0.4, apex=1.0, offset=0.6)]


def test_a_motion_shows_a_moment_before_it_is_worked_out() -> None:
    motion = SpeechMotion(lasting(20.0), CUES, FPS)
    before = motion.at(42)
    assert "made" not in vars(motion)
    run(motion.prepare())
    assert motion.frame_count(FPS) == len(motion.made.stream)
    np.testing.assert_allclose(before, motion.at(42), atol=1.0)


@pytest.mark.parametrize("steps", [1, 3, 6])
def test_cancelling_leaves_nothing(steps: int) -> None:
    motion = SpeechMotion(lasting(20.0), CUES, FPS)
    work = motion.prepare()
    for _ in range(steps):
        next(work)
    work.close()
    assert "made" not in vars(motion)
    run(motion.prepare())  # and it may begin again
    alike = api.say(motion.utterance, cues=CUES, fps=FPS, liveliness=motion.liveliness)
    np.testing.assert_array_equal(motion.made.stream, alike.stream.frames)


def test_a_preview_works_it_out_in_small_steps() -> None:
    motion = SpeechMotion(lasting(120.0), CUES, FPS)
    face = api.default_face()
    played = PlayedMotion(face, motion, first_frame=1.0, fps=FPS, drive="natural")
    assert "made" not in vars(motion)
    work = played.work()
    steps = 0
    while "made" not in vars(motion):
        next(work)
        steps += 1
    assert steps > 10
    work.close()


def spoken(head: Any, folder: Path) -> None:
    """Two words on the timeline, of which nobody has marked the stress."""
    bpy.context.scene.render.fps = 10
    path = folder / "line.csv"
    path.write_text("start,end,phoneme,word\n0.0,0.1,m,mama\n0.1,0.2,a,mama\n0.2,0.3,p,papa\n0.3,0.4,a,papa\n", "utf-8")
    head.risorius.speech.source, head.risorius.speech.timings = "TIMINGS", str(path)
    head.risorius.timeline.variation.head = 1.0
    assert bpy.ops.risorius.add_speech() == {"FINISHED"}


def test_a_bake_that_is_cancelled_while_speech_is_worked_out_changes_nothing(head: Any, tmp_path: Path) -> None:
    spoken(head, tmp_path)
    work = motion_work(head, bpy.context.scene)
    texts = list[str]()
    while not (texts and "sound" in texts[-1]):
        texts.append(next(work).text)
    work.close()
    assert head.data.shape_keys is None
    assert not bpy.data.actions


@pytest.mark.slow
def test_a_bake_says_that_stress_was_assumed(head: Any, tmp_path: Path) -> None:
    spoken(head, tmp_path)
    assert BY_RULE in run(motion_work(head, bpy.context.scene)).remarks
    head.risorius.timeline.variation.head = 0.0  # nothing beats, nothing was assumed
    assert BY_RULE not in run(motion_work(head, bpy.context.scene)).remarks
