"""The panel Speak: texts and timings are baked where the playhead is, with their sound and the feeling chosen."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest
import risorius.api as api
from risorius.operators.speech.ops import RISORIUS_OT_speak
from risorius.operators.speech.props import _matching
from risorius.scene.bake.shape_keys import read_own
from risorius.scene.mesh import evaluated_vertices
from risorius.scene.sounds import first_heard, frames_heard

TIMINGS = "0.0 0.1 m\n0.1 0.2 i\n0.2 0.3 p\n"


@pytest.fixture
def timings(tmp_path: Path) -> Path:
    """Three sounds in three tenths of a second."""
    path = tmp_path / "line.txt"
    path.write_text(TIMINGS, encoding="utf-8")
    return path


@pytest.fixture
def speech(head: Any) -> Any:
    """What is said, on a face that is not alive, at ten frames per second."""
    bpy.context.scene.render.fps = 10
    return head.risorius.speech


def strips() -> list[Any]:
    """The strips of the sequencer."""
    editor = bpy.context.scene.sequence_editor
    return [] if editor is None else list(editor.strips if hasattr(editor, "strips") else editor.sequences)


def shown(head: Any, frame: int) -> np.ndarray:
    """(68,) FAPs at a frame of the scene."""
    bpy.context.scene.frame_set(frame)
    return api.default_face().measure(evaluated_vertices(head))


@pytest.mark.slow
def test_timings_are_said_from_the_playhead_on_with_the_chosen_emotion(head: Any, speech: Any, timings: Path) -> None:
    head.risorius.emotion.word = "sadness"
    speech.source, speech.timings = "TIMINGS", str(timings)
    bpy.context.scene.frame_set(20)
    assert bpy.ops.risorius.speak() == {"FINISHED"}
    assert list(read_own(head.data).clips) == ["line"]
    assert head.data.shape_keys.animation_data.action.frame_range[0] == 20.0
    assert not strips()
    saying = api.say(timings, emotion=api.expression("sadness"), fps=10.0)
    face = api.default_face()
    clip = face.simulate(saying.stream.frames, 10.0, emotions=saying.emotions, planned=True, integrator="balance")
    for place in (0, 2):
        bpy.context.scene.frame_set(20 + place)
        assert np.abs(evaluated_vertices(head) - clip.positions[place]).max() < 2e-4


@pytest.mark.slow
def test_clips_of_the_timeline_show_while_it_speaks(head: Any, speech: Any, timings: Path) -> None:
    head.risorius.timeline.linked = False
    head.risorius.emotion.word = "surprise"
    bpy.context.scene.frame_set(5)
    bpy.ops.risorius.add_clip()
    clip = head.risorius.timeline.clips[0]
    clip.onset, clip.apex, clip.offset = 0.2, 0.5, 0.2
    speech.source, speech.timings = "TIMINGS", str(timings)
    bpy.context.scene.frame_set(1)
    assert bpy.ops.risorius.speak() == {"FINISHED"}
    brow = api.fap("raise_l_i_eyebrow").number - 1
    before, during = shown(head, 1)[brow], shown(head, 9)[brow]
    assert abs(before) < 10.0
    assert during > 80.0
    speech.with_feeling = False
    bpy.context.scene.frame_set(1)
    assert bpy.ops.risorius.speak() == {"FINISHED"}
    assert abs(shown(head, 9)[brow]) < 10.0


@pytest.mark.slow
def test_a_text_is_said_with_its_voice_in_the_file(
    head: Any, speech: Any, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    speech.text, speech.with_feeling = "Pat my map.", False
    bpy.context.scene.frame_set(3)
    assert bpy.ops.risorius.speak() == {"FINISHED"}
    assert list(read_own(head.data).clips) == ["Pat my map."]
    (strip,) = strips()
    assert (strip.type, first_heard(strip)) == ("SOUND", 3)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "said.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "said.blend"))
    (strip,) = strips()
    assert strip.sound.packed_file is not None
    assert frames_heard(strip) >= 8
    assert "Without sound" not in capfd.readouterr().out


@pytest.mark.slow
def test_a_sound_that_is_none_does_not_take_the_bake_away(
    head: Any, speech: Any, timings: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    sound = timings.with_suffix(".wav")
    sound.write_text("no sound")
    speech.source, speech.timings, speech.sound = "TIMINGS", str(timings), str(sound)
    assert bpy.ops.risorius.speak() == {"FINISHED"}
    assert list(read_own(head.data).clips) == ["line"]
    said = capfd.readouterr()
    assert "Warning: Without sound:" in said.out + said.err


@pytest.mark.parametrize(
    ("fields", "problem"),
    [
        ({"text": "yes", "voice": "martian"}, "must be a language of eSpeak NG"),
        ({"text": "…"}, "must have words that the voice en can say"),
        ({"source": "TIMINGS", "timings": "/no/such.TextGrid"}, "cannot be read"),
        ({"source": "TIMINGS", "sound": "/no/such.wav"}, "does not exist: check the path of the sound"),
    ],
)
def test_what_cannot_be_said_is_refused_and_nothing_changes(
    head: Any, speech: Any, timings: Path, fields: dict[str, str], problem: str
) -> None:
    for name, value in {"timings": str(timings), **fields}.items():
        setattr(speech, name, value)
    with pytest.raises(RuntimeError, match=problem):
        bpy.ops.risorius.speak()
    assert head.data.shape_keys is None
    assert not strips()


def test_without_anything_to_say_the_button_is_grey(head: Any, speech: Any) -> None:
    assert RISORIUS_OT_speak.refusal(bpy.context) == "Nothing is said yet: write a text"
    speech.source = "TIMINGS"
    assert RISORIUS_OT_speak.refusal(bpy.context) == "Nothing is said yet: choose a file of timings"
    assert not bpy.ops.risorius.speak.poll()


def test_voices_are_found_by_code_and_name(speech: Any) -> None:
    assert ("de", "German") in list(_matching(speech, bpy.context, "germ"))
    assert ("fr-fr", "French (France)") in list(_matching(speech, bpy.context, "fr"))
    assert not list(_matching(speech, bpy.context, "martian"))
