"""Speech dragged in a timeline editor: as a whole, or at its end, with its sound; Esc leaves it as it was."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest
from risorius.operators.speech.bars import SpokenTimes
from risorius.operators.timeline.bars import Grip, lay_out
from risorius.operators.timeline.drag import _Dragged
from risorius.scene.sounds import first_heard, frames_heard
from risorius.speech.waves import wav_of

RATE = 16000


@pytest.fixture
def strip(head: Any, tmp_path: Path) -> Any:
    """A second of speech from frame 11 on, at ten frames per second, beside a clip."""
    bpy.context.scene.render.fps = 10
    (tmp_path / "line.txt").write_text("0.0 0.2 m\n0.2 1.0 a\n", encoding="utf-8")
    tone = 0.3 * np.sin(2.0 * np.pi * 200.0 * np.arange(RATE) / RATE)
    (tmp_path / "line.wav").write_bytes(wav_of(tone[:, None], RATE))
    speech = head.risorius.speech
    speech.source, speech.timings, speech.sound = "TIMINGS", str(tmp_path / "line.txt"), str(tmp_path / "line.wav")
    bpy.ops.risorius.add_clip()
    bpy.context.scene.frame_set(11)
    assert bpy.ops.risorius.add_speech() == {"FINISHED"}
    return speech.strips[0]


def heard() -> tuple[int, int]:
    """First frame and length of the sound."""
    editor = bpy.context.scene.sequence_editor
    (sound,) = editor.strips if hasattr(editor, "strips") else editor.sequences
    return first_heard(sound), frames_heard(sound)


def test_a_bar_lies_where_it_is_said_and_its_end_is_a_grip(strip: Any) -> None:
    (bar,) = lay_out([SpokenTimes.of(strip)], 10.0, lambda frame: 10.0 * frame, 200.0, 1.0)
    assert bar.corners == pytest.approx((110.0, 110.0, 210.0, 210.0))
    middle = (bar.low + bar.high) / 2.0
    assert bar.grip(160.0, middle, 5.0) is Grip.START
    assert bar.grip(208.0, middle, 5.0) is Grip.OFFSET


@pytest.mark.parametrize("grip", [Grip.START, Grip.ONSET])
def test_it_is_dragged_with_its_sound(strip: Any, grip: Grip) -> None:
    dragged = _Dragged.of(strip.id_data, 1, grip)
    assert dragged.by(strip.id_data, 4.4, 10.0) == "Start: frame 15"
    dragged.finish(strip.id_data, bpy.context.scene)
    assert (strip.start, heard()) == (15, (15, 10))
    dragged.undo(strip.id_data)
    assert (strip.start, heard()) == (11, (11, 10))


def test_its_end_is_dragged_and_its_sound_is_as_long(strip: Any) -> None:
    dragged = _Dragged.of(strip.id_data, 1, Grip.OFFSET)
    assert dragged.by(strip.id_data, 5.2, 10.0) == "Stretch: 1.50, 1.50 s"
    assert heard() == (11, 10)
    dragged.finish(strip.id_data, bpy.context.scene)
    assert heard() == (11, 15)
    again = _Dragged.of(strip.id_data, 1, Grip.OFFSET)
    again.by(strip.id_data, 100.0, 10.0)
    assert strip.stretch == pytest.approx(4.0)
    again.undo(strip.id_data)
    assert strip.stretch == pytest.approx(1.5)


def test_a_clip_is_dragged_as_before(strip: Any) -> None:
    head = strip.id_data
    clip = head.risorius.timeline.clips[0]
    before = clip.apex
    dragged = _Dragged.of(head, 0, Grip.APEX)
    assert dragged.by(head, 3.0, 10.0) == f"Apex: {before + 0.3:.2f} s"
    dragged.undo(head)
    assert clip.apex == pytest.approx(before)
