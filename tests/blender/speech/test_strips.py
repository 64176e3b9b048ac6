"""Speech on the timeline: kept in the file, moved with its sound, baked with the clips into one action."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest
import risorius.api as api
from risorius.operators.bake.settings import motion_of, stale_clips
from risorius.operators.emotion.performance import performance_of
from risorius.operators.speech.strips import speech_of, title_of_strip
from risorius.scene.bake.shape_keys import read_own
from risorius.scene.bake.speech_motion import SpeechMotion
from risorius.scene.mesh import evaluated_vertices
from risorius.scene.sounds import first_heard, frames_heard
from risorius.speech.waves import wav_of

TIMINGS = "start,end,phoneme,word\n0.0,0.1,m,me\n0.1,0.2,i,me\n0.3,0.4,p,up\n0.4,0.6,a,up\n"
RATE = 16000


@pytest.fixture
def speech(head: Any, tmp_path: Path) -> Any:
    """Timings of two words and their sound, chosen on a face, at ten frames per second."""
    bpy.context.scene.render.fps = 10
    path = tmp_path / "line.csv"
    path.write_text(TIMINGS, encoding="utf-8")
    tone = 0.3 * np.sin(2.0 * np.pi * 200.0 * np.arange(RATE) / RATE)
    path.with_suffix(".wav").write_bytes(wav_of(tone[:, None], RATE))
    chosen = head.risorius.speech
    chosen.source, chosen.timings, chosen.sound = "TIMINGS", str(path), str(path.with_suffix(".wav"))
    return chosen


def add(speech: Any, frame: int = 1, **fields: str) -> Any:
    """A strip at a frame."""
    for name, value in fields.items():
        setattr(speech, name, value)
    bpy.context.scene.frame_set(frame)
    assert bpy.ops.risorius.add_speech() == {"FINISHED"}
    return speech.strips[speech.active]


def heard() -> list[Any]:
    """The strips of the sequencer."""
    editor = bpy.context.scene.sequence_editor
    return [] if editor is None else list(editor.strips if hasattr(editor, "strips") else editor.sequences)


def test_a_strip_holds_words_and_their_sounds(speech: Any) -> None:
    strip = add(speech, 20)
    assert (title_of_strip(strip), strip.start) == ("line", 20)
    assert [(word.name, round(word.start, 6), round(word.end, 6)) for word in strip.words] == [
        ("me", 0.0, pytest.approx(0.2)),
        ("up", pytest.approx(0.3), pytest.approx(0.6)),
    ]
    assert [(s.symbol, s.viseme) for word in strip.words for s in word.sounds] == [
        ("m", "1"), ("i", "12"), ("p", "1"), ("a", "10"),
    ]  # fmt: skip
    assert strip.words[1].sounds[1].start == pytest.approx(0.4, abs=1e-6)
    said = speech_of(speech.id_data, 20.0, 10.0)
    assert said is not None
    read = api.read_timings(speech.timings)
    assert [(s.symbol, s.phoneme.viseme) for s in said.utterance.sounds] == [
        (s.symbol, s.phoneme.viseme) for s in read.sounds
    ]
    assert np.allclose([s.start for s in said.utterance.sounds], [s.start for s in read.sounds], atol=1e-6)


def test_its_sound_follows_where_it_goes_and_is_muted_with_it(speech: Any) -> None:
    strip = add(speech, 20)
    (sound,) = heard()
    assert first_heard(sound) == 20
    strip.start = 7
    assert first_heard(sound) == 7
    strip.mute = True
    assert sound.mute
    assert speech_of(speech.id_data, 1.0, 10.0) is None
    assert bpy.context.scene.use_audio_scrub
    assert bpy.context.scene.sync_mode == "AUDIO_SYNC"
    assert bpy.ops.risorius.remove_speech() == {"FINISHED"}
    assert not heard()
    assert not speech.strips


def test_it_lasts_as_long_as_it_is_stretched_and_its_sound_too(speech: Any) -> None:
    strip = add(speech)
    assert bpy.ops.risorius.stretch_speech(stretch=1.5) == {"FINISHED"}
    (sound,) = heard()
    assert frames_heard(sound) == 15
    said = speech_of(speech.id_data, 1.0, 10.0)
    assert said is not None
    assert said.utterance.sounds[-1].end == pytest.approx(0.9, abs=1e-5)
    strip.stretch = 1.0
    assert bpy.ops.risorius.fit_speech_sound() == {"FINISHED"}
    (sound,) = heard()
    assert (frames_heard(sound), sound.sound) == (10, strip.sound)
    assert not bpy.ops.risorius.fit_speech_sound.poll()


def test_a_file_keeps_it(speech: Any, tmp_path: Path) -> None:
    add(speech, 5)
    name = speech.id_data.name
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "said.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "said.blend"))
    (strip,) = bpy.data.objects[name].risorius.speech.strips
    assert [word.name for word in strip.words] == ["me", "up"]
    strip.start = 9
    assert first_heard(heard()[0]) == 9


def test_two_strips_are_one_speech_and_the_later_one_cuts_the_other_off(speech: Any) -> None:
    add(speech, 1)
    add(speech, 5)
    said = speech_of(speech.id_data, 1.0, 10.0)
    assert said is not None
    assert [s.symbol for s in said.utterance.sounds] == ["m", "i", "p", "m", "i", "p", "a"]
    assert said.remarks == ("line: is cut off by the speech that begins in it",)


@pytest.mark.slow
def test_it_is_baked_with_the_clips_as_one_action(speech: Any) -> None:
    head = speech.id_data
    head.risorius.timeline.linked = False
    head.risorius.emotion.word = "surprise"
    bpy.context.scene.frame_set(1)
    bpy.ops.risorius.add_clip()
    clip = head.risorius.timeline.clips[0]
    clip.onset, clip.apex, clip.offset = 0.3, 0.6, 0.3
    add(speech, 4)
    performance = performance_of(head, bpy.context.scene)
    assert performance.markers == [("surprise", 1.0), ("line", 4.0)]
    motion = motion_of(head, performance)
    assert isinstance(motion, SpeechMotion)
    assert bpy.ops.risorius.bake_motion() == {"FINISHED"}
    assert list(read_own(head.data).clips) == ["timeline motion"]
    assert not stale_clips(head, bpy.context.scene)
    face = api.default_face()
    frames = motion.made.stream
    alike = face.simulate(frames, 10.0, emotions=motion.made.emotions, planned=True, integrator="balance")
    for frame in (4, 8):
        bpy.context.scene.frame_set(frame)
        assert np.abs(evaluated_vertices(head) - alike.positions[frame - 1]).max() < 2e-4
    speech.strips[0].words[0].strength = 0.5
    assert list(stale_clips(head, bpy.context.scene)) == ["timeline motion"]
    speech.strips[0].words[0].strength = 1.0
    assert not stale_clips(head, bpy.context.scene)


def test_without_clips_the_chosen_emotion_lasts_as_long_as_the_speech(speech: Any) -> None:
    head = speech.id_data
    head.risorius.emotion.word = "sadness"
    add(speech, 11)
    performance = performance_of(head, bpy.context.scene)
    (cue,) = performance.cues
    assert (performance.first_frame, cue.start, cue.onset, cue.apex) == (11.0, 0.0, 0.0, pytest.approx(0.6))
    speech.with_feeling = False
    assert not performance_of(head, bpy.context.scene).cues


def test_a_sound_that_is_shorter_than_the_speech_is_said(speech: Any, capfd: pytest.CaptureFixture[str]) -> None:
    path = Path(speech.sound)
    path.write_bytes(wav_of(np.zeros((RATE // 4, 1)), RATE))
    add(speech)
    said = capfd.readouterr()
    assert "the sound lasts 0.3 s, but the speech 0.6 s: the mouth goes on without it" in said.out + said.err


def test_a_sound_that_cannot_be_played_does_not_take_the_speech_away(
    speech: Any, capfd: pytest.CaptureFixture[str]
) -> None:
    Path(speech.sound).write_text("no sound")
    strip = add(speech)
    assert strip.sound is None
    said = capfd.readouterr()
    assert "Without sound:" in said.out + said.err


def test_a_preset_keeps_it_with_its_sound(
    speech: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("risorius.operators.library.ops.own_folder", lambda **_: tmp_path)
    strip = add(speech, 5)
    strip.words[1].strength, strip.stretch = 0.5, 1.5
    strip.words[0].sounds[0].viseme = "2"
    strip.sound.pack()
    before = speech_of(speech.id_data, 5.0, 10.0)
    assert bpy.ops.risorius.save_preset(preset="Mine", kind="timeline") == {"FINISHED"}
    assert (tmp_path / "Mine 1.wav").is_file()
    add(speech, 40)
    bpy.context.scene.frame_set(5)
    assert bpy.ops.risorius.load_preset(filepath=str(tmp_path / "Mine.toml")) == {"FINISHED"}
    assert len(speech.strips) == 1
    after = speech_of(speech.id_data, 5.0, 10.0)
    assert before is not None
    assert after is not None
    assert [(s.phoneme, s.strength) for s in after.utterance.sounds] == [
        (s.phoneme, s.strength) for s in before.utterance.sounds
    ]
    assert np.allclose([s.end for s in after.utterance.sounds], [s.end for s in before.utterance.sounds], atol=1e-5)
    assert [first_heard(sound) for sound in heard()] == [5]
    (tmp_path / "Mine 1.wav").unlink()
    assert bpy.ops.risorius.load_preset(filepath=str(tmp_path / "Mine.toml")) == {"FINISHED"}
    assert len(speech.strips) == 1
    said = capfd.readouterr()
    assert "line: without sound:" in said.out + said.err


@pytest.mark.slow
def test_strips_of_clips_leave_speech_out_which_is_said(speech: Any, capfd: pytest.CaptureFixture[str]) -> None:
    bpy.ops.risorius.add_clip()
    add(speech)
    assert bpy.ops.risorius.bake_strips() == {"FINISHED"}
    said = capfd.readouterr()
    assert "Speech is not in strips: Bake Motion shows it with the clips" in said.out + said.err
