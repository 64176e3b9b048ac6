"""Words of speech on the timeline, edited one by one."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest
import risorius.api as api
from risorius.errors import RisoriusError
from risorius.operators.emotion.performance import performance_of
from risorius.operators.speech.strips import read_line, speech_of, write_line

TIMINGS = "start,end,phoneme,word\n0.0,0.1,m,me\n0.1,0.2,i,me\n0.3,0.4,p,up\n0.4,0.6,a,up\n"


@pytest.fixture
def strip(head: Any, tmp_path: Path) -> Any:
    """Speech of two words from frame 11 on, at ten frames per second."""
    bpy.context.scene.render.fps = 10
    path = tmp_path / "line.csv"
    path.write_text(TIMINGS, encoding="utf-8")
    chosen = head.risorius.speech
    chosen.source, chosen.timings = "TIMINGS", str(path)
    bpy.context.scene.frame_set(11)
    assert bpy.ops.risorius.add_speech() == {"FINISHED"}
    return chosen.strips[0]


def words(strip: Any) -> list[tuple[str, float, float]]:
    """Letters and times."""
    return [(word.name, round(word.start, 4), round(word.end, 4)) for word in strip.words]


def sounds(strip: Any) -> list[tuple[str, float, float]]:
    """Symbols and times as they are said."""
    said = speech_of(strip.id_data, 11.0, 10.0)
    assert said is not None
    return [(s.symbol, round(s.start, 4), round(s.end, 4)) for s in said.utterance.sounds]


def test_what_is_read_of_a_strip_is_what_was_written(strip: Any) -> None:
    line = read_line(strip)
    write_line(strip, line)
    assert read_line(strip) == line


def test_a_words_time_stays_between_its_neighbours_and_its_sounds_follow(strip: Any) -> None:
    strip.words[0].end = 0.25
    assert sounds(strip)[:2] == [("m", 0.0, 0.125), ("i", 0.125, 0.25)]
    strip.words[0].end = 9.0
    assert words(strip)[0] == ("me", 0.0, 0.3)
    strip.words[1].start = -1.0
    assert words(strip)[1] == ("up", 0.3, 0.6)
    strip.words[1].end = 1.2
    assert strip.duration == pytest.approx(1.2)
    strip.words[1].start = 5.0
    assert words(strip)[1] == ("up", 1.18, 1.2)


def test_a_sounds_time_and_mouth_are_changed(strip: Any) -> None:
    sound = strip.words[1].sounds[0]
    sound.end = 0.35
    assert sounds(strip)[2] == ("p", 0.3, 0.35)
    sound.end = 0.9
    assert sounds(strip)[2] == ("p", 0.3, 0.4)
    sound.viseme = "2"
    said = speech_of(strip.id_data, 11.0, 10.0)
    assert said is not None
    assert (said.utterance.sounds[2].phoneme.viseme, said.utterance.sounds[2].symbol) == (2, "2")
    strip.words[1].strength = 0.5
    sound.strength = 0.5
    said = speech_of(strip.id_data, 11.0, 10.0)
    assert said is not None
    assert [s.strength for s in said.utterance.sounds] == [1.0, 1.0, 0.25, 0.5]


def test_words_are_split_at_the_frame_joined_and_removed(strip: Any) -> None:
    strip.active = 1
    bpy.context.scene.frame_set(15, subframe=0.5)
    assert bpy.ops.risorius.split_word() == {"FINISHED"}
    assert words(strip) == [("me", 0.0, 0.2), ("u", 0.3, 0.4), ("p", 0.4, 0.6)]
    assert bpy.ops.risorius.join_words() == {"FINISHED"}
    assert words(strip)[1] == ("u p", 0.3, 0.6)
    with pytest.raises(RuntimeError, match="must have another one after it"):
        bpy.ops.risorius.join_words()
    assert bpy.ops.risorius.remove_word() == {"FINISHED"}
    assert words(strip) == [("me", 0.0, 0.2)]
    assert bpy.ops.risorius.remove_word() == {"FINISHED"}
    assert not bpy.ops.risorius.remove_word.poll()
    assert speech_of(strip.id_data, 11.0, 10.0) is None


def test_a_word_is_inserted_where_the_playhead_pauses(strip: Any) -> None:
    strip.words[1].end = 1.0
    strip.words[1].start = 0.8
    bpy.context.scene.frame_set(14)
    assert bpy.ops.risorius.insert_word(text="hello") == {"FINISHED"}
    assert [word.name for word in strip.words] == ["me", "hello", "up"]
    assert strip.active == 1
    assert (strip.words[1].start, len(strip.words[1].sounds) > 2) == (pytest.approx(0.3, abs=0.1), True)
    assert strip.words[1].end <= strip.words[2].start + 1e-6
    with pytest.raises(RuntimeError, match="is empty: write one"):
        bpy.ops.risorius.insert_word(text=" ")


def test_a_word_is_pronounced_within_its_time(strip: Any) -> None:
    strip.active = 0
    strip.words[0].name = "pat"
    strip.words[0].strength = 0.7
    assert bpy.ops.risorius.pronounce_word() == {"FINISHED"}
    assert words(strip)[0] == ("pat", 0.0, 0.2)
    assert strip.words[0].sounds[0].viseme == "1"
    assert len(strip.words[0].sounds) == 3
    assert strip.words[0].strength == pytest.approx(0.7)


def test_without_a_voice_a_word_is_an_open_mouth_which_is_said(
    strip: Any, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    def missing() -> dict[str, str]:
        raise RisoriusError("Speaking text needs eSpeak NG")

    monkeypatch.setattr(api, "voices", missing)
    assert bpy.ops.risorius.pronounce_word() == {"FINISHED"}
    assert [s.viseme for s in strip.words[0].sounds] == ["10"]
    said = capfd.readouterr()
    assert "shown as an open mouth. Speaking text needs eSpeak NG" in said.out + said.err


def test_sounds_are_added_and_removed(strip: Any) -> None:
    assert bpy.ops.risorius.add_sound() == {"FINISHED"}
    assert sounds(strip)[:3] == [("m", 0.0, 0.05), ("m", 0.05, 0.1), ("i", 0.1, 0.2)]
    assert strip.words[0].active == 1
    assert bpy.ops.risorius.remove_sound() == {"FINISHED"}
    assert sounds(strip)[:2] == [("m", 0.0, 0.05), ("i", 0.1, 0.2)]


def test_the_word_at_the_playhead_is_selected(strip: Any) -> None:
    bpy.context.scene.frame_set(15)
    assert bpy.ops.risorius.select_word() == {"FINISHED"}
    assert strip.active == 1


def test_an_edit_changes_what_is_performed(strip: Any) -> None:
    head, scene = strip.id_data, bpy.context.scene
    before = performance_of(head, scene).speech
    strip.words[0].strength = 0.3
    after = performance_of(head, scene).speech
    assert before is not None
    assert after is not None
    assert before.digest != after.digest
    assert np.isclose(after.utterance.sounds[0].strength, 0.3)
