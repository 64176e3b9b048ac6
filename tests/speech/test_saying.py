"""Speech with feeling: what the mouth keeps of an emotion, and what is the emotion's."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import risorius.api as api
from risorius.errors import ParameterError
from risorius.speech.feeling import mixed
from risorius.speech.phonemes import phonemes

FPS = 50.0
BROW, CORNER, CHEEK, JAW = (
    api.fap(name).number - 1 for name in ("raise_l_i_eyebrow", "raise_l_cornerlip", "lift_l_cheek", "open_jaw")
)
UPPER, LOWER, PUSHED = 3, 4, 16


def uttered(letters: str, length: float = 0.15, silence: float = 1.0) -> api.Utterance:
    """Sounds of equal length between silences; a _ is a silence, too."""
    sounds, at = [], silence
    for symbol in letters.split():
        if symbol == "_":
            at += silence
        else:
            sounds.append(api.Sound(at, at + length, phonemes()[symbol], symbol))
            at += length
    return api.Utterance(tuple(sounds), at + silence)


def middle(saying: api.Saying, place: int) -> int:
    """The frame in the middle of a sound."""
    return round(saying.utterance.sounds[place].middle * FPS)


def test_without_feeling_brows_and_cheeks_are_silent() -> None:
    saying = api.say(uttered("p a"), fps=FPS)
    assert np.isnan(saying.stream.frames[:, [BROW, CHEEK]]).all()
    assert not saying.emotions.any()


def test_brows_and_cheeks_are_the_emotions_whatever_is_said() -> None:
    words = [api.say(uttered(letters), emotion=api.expression("sadness"), fps=FPS) for letters in ("u p a", "i s i")]
    first, second = (saying.stream.frames[middle(saying, 1)] for saying in words)
    assert first[BROW] > 50.0
    np.testing.assert_allclose(first[[BROW, CHEEK]], second[[BROW, CHEEK]])


def test_a_pause_has_all_of_the_emotion() -> None:
    joy = api.expression("joy")
    saying = api.say(uttered("p a _ p a"), emotion=joy, fps=FPS)
    pause = round((saying.utterance.sounds[1].end + 0.5) * FPS)
    alone = api.say(uttered("p a _ p a"), fps=FPS)
    shown = saying.stream.frames[pause] - np.nan_to_num(alone.stream.frames[pause])
    first = saying.stream.frames[0]
    np.testing.assert_allclose(shown[[CORNER, BROW, CHEEK]], first[[CORNER, BROW, CHEEK]], atol=3.0)
    assert first[CORNER] > 100.0


def test_lips_close_in_every_emotion() -> None:
    for word in ("joy", "surprise", "fear", "anger", "sadness", "disgust"):
        saying = api.say(uttered("a p u m a b i"), emotion=api.expression(word, activation=7), fps=FPS)
        for place in (1, 3, 5):
            frame = saying.stream.frames[middle(saying, place)]
            assert frame[UPPER] + frame[LOWER] >= 100.0, word
            assert frame[JAW] <= 120.0, word


def test_vowels_keep_a_smile_and_rounding_holds_it_back() -> None:
    joy = api.expression("joy")
    plain, smiling = (api.say(uttered("i u"), emotion=emotion, fps=FPS) for emotion in (None, joy))
    gained = smiling.stream.frames[: len(plain.stream.frames)] - np.nan_to_num(plain.stream.frames)
    spread, rounded = gained[middle(plain, 0)][CORNER], gained[middle(plain, 1)][CORNER]
    assert spread > 100.0
    assert 0.2 * spread < rounded < 0.75 * spread


@pytest.mark.parametrize("word", ["anger", "surprise"])
def test_an_open_mouth_of_a_feeling_does_not_stay_open_while_speaking(word: str) -> None:
    """Both drop the jaw; speech has it, so the lower lip that it carried comes up with it."""
    said = uttered("s s s s")
    plain, felt = (api.say(said, emotion=emotion, fps=FPS) for emotion in (None, api.expression(word, activation=7)))
    alone, shouted, spoken = felt.stream.frames[0], plain.stream.frames, felt.stream.frames
    middle_of_it = middle(plain, 2)
    dropped = alone[LOWER] + alone[JAW]  # the lip's own, beside what the jaw carries
    assert alone[JAW] > 250.0
    added_jaw = spoken[middle_of_it, JAW] - shouted[middle_of_it, JAW]
    added_lip = spoken[middle_of_it, LOWER] - shouted[middle_of_it, LOWER]
    assert 0.0 < added_jaw < 0.25 * alone[JAW]
    assert added_lip == pytest.approx(0.3 * dropped - added_jaw, abs=5.0)


def test_lean_says_how_far_the_mouth_leans() -> None:
    said, joy = uttered("i i i"), api.expression("joy")
    gained = [
        float(api.say(said, emotion=joy, fps=FPS, lean=lean).stream.frames[round(1.2 * FPS), CORNER])
        for lean in (0.0, 0.5, 1.0)
    ]
    assert gained[0] < gained[1] < gained[2]
    assert gained[0] == pytest.approx(float(api.say(said, fps=FPS).stream.frames[round(1.2 * FPS), CORNER]), abs=1e-9)


def test_the_emotion_goes_when_all_is_said() -> None:
    saying = api.say(uttered("p a"), emotion=api.expression("joy"), fps=FPS)
    assert len(saying.stream.frames) > saying.utterance.duration * FPS + 10
    joy = list(api.ARCHETYPES).index(api.Archetype("joy"))
    assert saying.emotions[0, joy] == pytest.approx(1.0)
    assert saying.emotions[-1].max() < 0.01
    assert abs(saying.stream.frames[-1][CORNER]) < 5.0


def test_the_same_seed_gives_the_same_speech_and_another_another() -> None:
    said = uttered("p a " * 20)
    frames = [
        api.say(said, fps=FPS, liveliness=api.Liveliness.usual(seed), seed=seed).stream.frames for seed in (1, 1, 2)
    ]
    np.testing.assert_array_equal(frames[0], frames[1])
    assert np.nanmax(np.abs(frames[0] - frames[2])) > 1.0


def test_a_stream_keeps_its_file(tmp_path: Path) -> None:
    saying = api.say(uttered("p a"), emotion=api.expression("joy"), fps=25.0)
    api.write_stream(tmp_path / "a.fap", saying.stream)
    np.testing.assert_allclose(api.read_fap(tmp_path / "a.fap").frames, saying.stream.frames, atol=0.5 + 1e-9)


def test_wrong_shapes_and_leans_are_refused() -> None:
    said = uttered("p a")
    frames = np.zeros((10, 68))
    with pytest.raises(ParameterError, match="lean must be from 0 to 2"):
        api.say(said, lean=3.0)
    with pytest.raises(ParameterError, match="felt must have the shape of spoken"):
        mixed(frames, frames[:5], said, 25.0)


@pytest.mark.parametrize("begin", [0.0, 0.5, -0.5])
def test_cues_come_and_go_in_their_own_time(begin: float) -> None:
    said = uttered("a i a i", silence=0.5)
    cue = api.Cue(api.expression("joy"), start=0.2, onset=0.4, apex=0.5, offset=0.4)
    saying = api.say(said, cues=[cue], begin=begin, fps=FPS)
    joy = list(api.ARCHETYPES).index(api.Archetype("joy"))
    times = np.arange(len(saying.emotions)) / FPS
    np.testing.assert_allclose(saying.emotions[:, joy], cue.strength(times + begin), atol=1e-9)
    full, gone = round((0.85 - begin) * FPS), round((0.1 - begin) * FPS)
    assert saying.stream.frames[full, CHEEK] > 20.0
    assert gone < 0 or not np.nan_to_num(saying.stream.frames[gone, CHEEK]) > 1.0


def test_an_emotion_and_cues_exclude_each_other() -> None:
    joy = api.expression("joy")
    cue = api.Cue(joy, onset=0.4, apex=0.5, offset=0.4)
    with pytest.raises(ParameterError, match="cues must be left out where an emotion is given"):
        api.say(uttered("a"), emotion=joy, cues=[cue])


def test_the_mouth_comes_to_rest_when_the_file_ends_with_its_last_sound() -> None:
    """The feeling fades for longer than the speech; the mouth does not wait for that where the sound left it."""
    vowel = api.Utterance((api.Sound(0.1, 0.5, phonemes()["a"]),), 0.5)
    saying = api.say(vowel, emotion=api.expression("joy"), fps=FPS)
    jaw, tongue = (saying.stream.frames[:, number - 1] for number in (3, 44))
    spoken = round(0.5 * FPS)
    assert jaw[:spoken].max() > 300.0
    assert len(jaw) > spoken + 5
    assert abs(jaw[-1]) < 1.0
    assert abs(tongue[-1]) < 1.0
