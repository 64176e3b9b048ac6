"""Text becomes sound and timed phonemes."""

from __future__ import annotations

import ctypes.util
import sys
import wave
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
import risorius.api as api
from risorius.errors import ParameterError, RisoriusError

SENTENCE = "Pat my map."


def said(voiced: api.Voiced) -> str:
    """The sounds in a line."""
    return " ".join(sound.phoneme.symbol for sound in voiced.utterance.sounds)


def test_a_text_is_spoken_with_its_times() -> None:
    voiced = api.speak(SENTENCE)
    assert said(voiced) == "p a t m a ɪ m a p"
    assert [word.text for word in voiced.utterance.words] == ["Pat", "my", "map"]
    assert voiced.utterance.duration == pytest.approx(len(voiced.sound) / voiced.rate)
    first, last = voiced.utterance.sounds[0], voiced.utterance.sounds[-1]
    loud = np.flatnonzero(np.abs(voiced.sound.astype(float)) > 500.0) / voiced.rate
    assert first.start == pytest.approx(loud[0], abs=0.1)
    assert last.end == pytest.approx(loud[-1], abs=0.2)


@pytest.mark.parametrize(
    ("voice", "text", "expected"),
    [
        ("de", "Mutter", "m ʊ t"),
        ("fr", "beau", "b o"),
        ("es", "mapa", "m a p a"),
        ("ru", "мама", "m ɑ m a"),
        ("pl", "pięć", "p"),
        ("hi", "मामा", "m a m a"),
    ],
)
def test_other_languages_are_spoken(voice: str, text: str, expected: str) -> None:
    voiced = api.speak(text, voice=voice)
    assert said(voiced).startswith(expected)
    assert not [line for line in voiced.utterance.assumed if line.startswith("not known")]


@pytest.mark.parametrize("voice", ["en", "de", "fr", "es", "it", "pt", "ru", "pl", "sv", "tr", "ar", "hi", "cmn", "nl"])
def test_every_sound_of_a_language_is_known(voice: str) -> None:
    text = {"ru": "щука юла эхо жёлтый объезд", "ar": "مرحبا كيف حالك", "hi": "नमस्ते दुनिया ठंडा", "cmn": "你好世界"}
    utterance = api.speak(
        text.get(voice, "La jeune Mutter Übung szczęście año João chaqueta schip"), voice=voice
    ).utterance
    assert not [line for line in utterance.assumed if line.startswith("not known")]


def test_speed_and_pitch_change_the_voice() -> None:
    slow, fast = (api.speak(SENTENCE, speed=speed) for speed in (100, 300))
    assert slow.utterance.duration > 1.5 * fast.utterance.duration
    low, high = (api.speak(SENTENCE, pitch=pitch).sound for pitch in (10, 90))
    assert len(low) != len(high) or np.abs(low.astype(int) - high).max() > 1000


def test_the_same_text_gives_the_same_speech() -> None:
    first, _, again = (api.speak(text) for text in (SENTENCE, "Something else.", SENTENCE))
    assert first.utterance == again.utterance
    np.testing.assert_array_equal(first.sound, again.sound)


def test_the_sound_is_written_as_wav(tmp_path: Path) -> None:
    voiced = api.speak(SENTENCE)
    voiced.write(tmp_path / "a.wav")
    with wave.open(str(tmp_path / "a.wav")) as file:
        assert (file.getframerate(), file.getnchannels(), file.getsampwidth()) == (voiced.rate, 1, 2)
        np.testing.assert_array_equal(np.frombuffer(file.readframes(file.getnframes()), "<i2"), voiced.sound)


@pytest.mark.parametrize(
    ("text", "options", "problem"),
    [
        ("", {}, "text must say something"),
        ("  \n", {}, "text must say something"),
        ("…", {}, "must have words that the voice en can say"),
        ("yes", {"voice": "martian"}, "voice must be a language of eSpeak NG, as .*'martian'"),
        ("yes", {"speed": 20}, "speed must be from 80 to 450"),
        ("yes", {"pitch": 100}, "pitch must be from 0 to 99"),
    ],
)
def test_what_cannot_be_said_is_refused(text: str, options: dict[str, str], problem: str) -> None:
    with pytest.raises(ParameterError, match=problem):
        api.speak(text, **options)  # type: ignore[arg-type]


def test_a_missing_library_is_explained(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "espeakng_loader", None)
    monkeypatch.setattr(ctypes.util, "find_library", lambda _name: None)
    with pytest.raises(RisoriusError, match="needs eSpeak NG: install it"):
        api.speak(SENTENCE)


def test_an_installed_library_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    import espeakng_loader

    path = espeakng_loader.get_library_path()
    monkeypatch.setenv("ESPEAK_DATA_PATH", espeakng_loader.get_data_path())
    monkeypatch.setitem(sys.modules, "espeakng_loader", None)
    monkeypatch.setattr(ctypes.util, "find_library", lambda _name: path)
    assert said(api.speak(SENTENCE)) == "p a t m a ɪ m a p"


def test_words_that_are_said_in_one_keep_their_letters() -> None:
    assert [word.text for word in api.speak("I did not see; it's (well) known.").utterance.words][:2] == [
        "I",
        "did not",
    ]
    said = " ".join(word.text for word in api.speak("I did not see; it's (well) known.").utterance.words)
    assert said == "I did not see it's well known"


@pytest.mark.parametrize(("text", "symbols"), [("Well, well.", ["w", "ɛ", "l", "w", "ɛ", "l"]), ("All", ["ɔː", "l"])])
def test_sounds_that_a_voice_says_within_another_are_shown(text: str, symbols: list[str]) -> None:
    sounds = api.speak(text).utterance.sounds
    assert [sound.symbol.strip("ˈˌ") for sound in sounds] == symbols
    assert all(sound.end - sound.start > 0.01 for sound in sounds)
    assert all(before.end <= after.start + 1e-9 for before, after in pairwise(sounds))
