"""Sounds of copies of a face, and of a face that is gone."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest
from risorius.operators.speech.sharing import stray_sounds
from risorius.scene.sounds import TAG, start_of, tagged
from risorius.speech.waves import wav_of

RATE = 16000


@pytest.fixture
def strip(head: Any, tmp_path: Path) -> Any:
    """Speech with its sound, on a face, at frame 1."""
    bpy.context.scene.render.fps = 10
    path = tmp_path / "line.csv"
    path.write_text("start,end,phoneme,word\n0.0,0.1,m,me\n0.1,0.2,i,me\n", encoding="utf-8")
    tone = 0.3 * np.sin(2.0 * np.pi * 200.0 * np.arange(RATE) / RATE)
    path.with_suffix(".wav").write_bytes(wav_of(tone[:, None], RATE))
    chosen = head.risorius.speech
    chosen.source, chosen.timings, chosen.sound = "TIMINGS", str(path), str(path.with_suffix(".wav"))
    bpy.context.scene.frame_set(1)
    assert bpy.ops.risorius.add_speech() == {"FINISHED"}
    return chosen.strips[0]


def copy_of(obj: Any) -> Any:
    """A copy of a face, as Shift+D makes it."""
    bpy.ops.object.select_all(action="DESELECT")
    obj.select_set(True)
    bpy.context.view_layer.objects.active = obj
    bpy.ops.object.duplicate()
    return bpy.context.object


def sounds(strip: Any) -> list[Any]:
    """The strips of the sequencer that are the sound of one strip of speech."""
    return [sound for _, sound in tagged(bpy.data.scenes, strip.tag)]


@pytest.mark.parametrize("moved", ["copy", "first"])
def test_a_copy_that_is_moved_has_a_sound_of_its_own(strip: Any, moved: str) -> None:
    other = copy_of(strip.id_data).risorius.speech.strips[0]
    assert len(sounds(strip)) == 1
    goes, stays = (other, strip) if moved == "copy" else (strip, other)
    goes.start = 21
    assert [start_of(sound) for sound in sounds(goes)] == [21]
    assert [start_of(sound) for sound in sounds(stays)] == [1]
    goes.start = 31  # and goes on being its own
    assert [start_of(sound) for sound in sounds(goes)] == [31]
    assert len(bpy.data.sounds) == 1


def test_a_copy_that_is_muted_does_not_silence_the_other(strip: Any) -> None:
    sounds(strip)[0].volume = 0.5
    other = copy_of(strip.id_data).risorius.speech.strips[0]
    other.mute = True
    assert [sound.mute for sound in sounds(strip)] == [False]
    assert [(sound.mute, sound.volume) for sound in sounds(other)] == [(True, 0.5)]


def test_removing_a_copys_speech_leaves_the_others_sound(strip: Any) -> None:
    copy_of(strip.id_data)
    assert bpy.ops.risorius.remove_speech() == {"FINISHED"}
    assert len(sounds(strip)) == 1
    bpy.context.view_layer.objects.active = strip.id_data
    tag = strip.tag
    assert bpy.ops.risorius.remove_speech() == {"FINISHED"}
    assert not list(tagged(bpy.data.scenes, tag))


def test_a_copied_scene_keeps_its_own_sound(strip: Any) -> None:
    first = bpy.context.scene
    bpy.ops.scene.new(type="FULL_COPY")
    copied = next(obj for obj in bpy.context.scene.objects if obj.risorius.speech.strips)
    copied.risorius.speech.strips[0].start = 21
    there = [start_of(sound) for _, sound in tagged([bpy.context.scene], copied.risorius.speech.strips[0].tag)]
    assert there == [21]
    assert [start_of(sound) for _, sound in tagged([first], strip.tag)] == [1]
    assert len(sounds(strip)) == 1


def test_the_sound_of_a_face_that_is_gone_stays_until_the_user_removes_it(strip: Any) -> None:
    scene, tag = bpy.context.scene, strip.tag
    with pytest.raises(RuntimeError, match="left over"):
        bpy.ops.risorius.remove_stray_sounds()
    strips = next(tagged([scene], tag))[0]
    own = strips.new_sound("mine", bpy.path.abspath(strip.sound.filepath), 7, 50)
    bpy.data.objects.remove(strip.id_data)
    assert [found for found, _ in stray_sounds(scene)] == [tag]
    assert bpy.ops.risorius.remove_stray_sounds() == {"FINISHED"}
    assert not stray_sounds(scene)
    assert (own.name, own.get(TAG)) == ("mine", None)  # what the user put there is no sound of speech
