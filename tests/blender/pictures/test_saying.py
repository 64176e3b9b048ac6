"""Speech in Blender: what the .blend moves is what the API says, with its sound."""

from __future__ import annotations

import wave
from pathlib import Path

import bpy
import numpy as np
import pytest
import risorius.api as api
from risorius import cli
from risorius.errors import FormatError
from risorius.scene.jobs.saying import say_file
from risorius.scene.mesh import evaluated_vertices
from risorius.scene.sounds import first_heard, frames_heard
from risorius.speech.phonemes import phonemes


@pytest.fixture
def said() -> api.Utterance:
    """Three sounds in half a second."""
    times = [(0.0, 0.15, "m"), (0.15, 0.35, "ɑ"), (0.35, 0.5, "p")]
    return api.Utterance(tuple(api.Sound(start, end, phonemes()[symbol], symbol) for start, end, symbol in times), 0.5)


@pytest.fixture
def sound(tmp_path: Path) -> Path:
    """Half a second of a tone."""
    path = tmp_path / "tone.wav"
    tone = (8000 * np.sin(np.arange(8000) * 0.2)).astype("<i2")
    with wave.open(str(path), "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(16000)
        file.writeframes(tone.tobytes())
    return path


@pytest.mark.slow
def test_a_blend_says_what_the_api_says_with_its_sound(said: api.Utterance, sound: Path, tmp_path: Path) -> None:
    made = say_file(tmp_path / "a.blend", lambda fps: api.say_steps(said, fps=fps), sound=sound, fps=20.0)
    bpy.ops.wm.open_mainfile(filepath=str(made.blend))
    scene, obj = bpy.context.scene, bpy.data.objects["Risorius Head"]
    saying = api.say(said, fps=20.0)
    clip = api.default_face().simulate(saying.stream.frames, 20.0, planned=True, integrator="balance")
    for index in (1, 5, 8):
        scene.frame_set(scene.frame_start + index)
        assert np.abs(evaluated_vertices(obj) - clip.positions[index]).max() < 2.0e-4
    strips = (
        scene.sequence_editor.strips if hasattr(scene.sequence_editor, "strips") else scene.sequence_editor.sequences
    )
    (strip,) = strips
    assert (strip.type, first_heard(strip)) == ("SOUND", scene.frame_start)
    assert frames_heard(strip) in (10, 11)


@pytest.mark.slow
def test_the_verb_films_speech_with_its_sound(sound: Path, tmp_path: Path) -> None:
    (tmp_path / "a.txt").write_text("0.0 0.15 m\n0.15 0.3 a\n", encoding="utf-8")
    films = []
    for more in ([], ["--sound", str(sound)]):
        out = tmp_path / f"{len(more)}.mp4"
        timings = ["--timings", str(tmp_path / "a.txt"), "--fps", "10"]
        assert cli.main(["say", *timings, "--emotion", "joy", "--out", str(out), *more]) == 0
        films.append(out.read_bytes())
    assert b"mp4a" not in films[0]
    assert b"mp4a" in films[1]


def test_a_missing_sound_is_refused_before_anything_is_made(said: api.Utterance, tmp_path: Path) -> None:
    with pytest.raises(FormatError, match=r"no\.wav: does not exist"):
        say_file(tmp_path / "a.blend", lambda fps: api.say_steps(said, fps=fps), sound=tmp_path / "no.wav")
    assert not (tmp_path / "a.blend").exists()


@pytest.mark.slow
def test_what_is_no_sound_is_refused_and_nothing_written(said: api.Utterance, tmp_path: Path) -> None:
    (tmp_path / "a.wav").write_text("this is no sound", encoding="utf-8")
    with pytest.raises(FormatError, match=r"a\.wav: is no sound that this Blender can play"):
        say_file(tmp_path / "a.blend", lambda fps: api.say_steps(said, fps=fps), sound=tmp_path / "a.wav")
    assert not (tmp_path / "a.blend").exists()
