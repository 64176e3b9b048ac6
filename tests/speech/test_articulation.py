"""Sounds in time become motion of the mouth."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from risorius.arrays import Floats
from risorius.errors import ParameterError
from risorius.mpeg4 import VISEME_SHAPES
from risorius.speech.articulation import SPOKEN, articulate
from risorius.speech.phonemes import phonemes
from risorius.speech.timings import read_marks
from risorius.speech.utterance import Sound, Utterance

FPS = 100.0
JAW, UPPER, LOWER, CORNER, PUSHED = (number - 1 for number in (3, 4, 5, 6, 17))


def uttered(letters: str, length: float = 0.12, *, stress: str = "") -> Utterance:
    """Sounds of equal length after 0.3 s of silence; those in `stress` are stressed."""
    sounds = [
        Sound(0.3 + n * length, 0.3 + (n + 1) * length, phonemes()[symbol], symbol, float(symbol in stress))
        for n, symbol in enumerate(letters.split())
    ]
    return Utterance(tuple(sounds), sounds[-1].end + 0.3)


def at(frames: Floats, utterance: Utterance, place: int) -> Floats:
    """The frame in the middle of a sound."""
    return np.asarray(frames[round(utterance.sounds[place].middle * FPS)])


def test_what_speech_leaves_alone_is_silent() -> None:
    frames = articulate(uttered("p a"), FPS)
    assert frames.shape == (85, 68)
    silent = np.isnan(frames).all(axis=0)
    assert {int(n) + 1 for n in np.flatnonzero(~silent)} == set(SPOKEN)
    assert not np.isnan(frames[:, ~silent]).any()


def test_the_mouth_rests_before_and_after() -> None:
    frames = articulate(uttered("p a"), FPS)
    spoken = frames[:, [number - 1 for number in SPOKEN]]
    assert np.abs(spoken[0]).max() < 3.0
    assert np.abs(spoken[-1]).max() < 3.0


@pytest.mark.parametrize("symbol", ["ɑ", "u", "i", "s", "ʃ", "f", "m"])
def test_a_sound_that_lasts_has_the_shape_of_its_viseme(symbol: str) -> None:
    said = uttered(f"{symbol}", 1.0)
    frame = at(articulate(said, FPS), said, 0)
    sound = phonemes()[symbol]
    shape = VISEME_SHAPES[sound.viseme]
    assert frame[JAW] == pytest.approx(min(sound.jaw * np.nan_to_num(shape[JAW]), 1000.0), abs=8.0)
    assert frame[PUSHED] == pytest.approx(sound.lips * np.nan_to_num(shape[PUSHED]), abs=5.0)


@pytest.mark.parametrize("length", [0.3, 0.12, 0.06, 0.03])
@pytest.mark.parametrize("fps", [24.0, 25.0, 60.0])
@pytest.mark.parametrize("word", ["ɑ p ɑ", "u m i", "ɑ b s ʃ m ɑ"])
def test_lips_close_at_any_tempo(word: str, length: float, fps: float) -> None:
    said = uttered(word, length)
    frames = articulate(said, fps)
    for sound in said.sounds:
        if sound.phoneme.viseme == 1:
            times = np.arange(len(frames)) / fps
            near = np.abs(times - sound.middle) <= 0.5 / fps + 1e-9
            assert (frames[near][:, UPPER] + frames[near][:, LOWER]).max() >= 100.0
            assert frames[near][:, JAW].min() <= 120.0


@pytest.mark.parametrize("length", [0.2, 0.05])
def test_the_lower_lip_is_at_the_teeth_in_f(length: float) -> None:
    said = uttered("ɑ f ɑ", length)
    frame = at(articulate(said, FPS), said, 1)
    assert frame[16 - 1] == pytest.approx(VISEME_SHAPES[2][16 - 1], abs=1e-6)  # drawn in
    assert frame[LOWER] >= 100.0
    assert frame[UPPER] <= -100.0  # the teeth show
    assert frame[JAW] <= 140.0


def test_rounding_is_awaited_through_consonants() -> None:
    rounded, spread = uttered("i s t u", 0.1), uttered("i s t i", 0.1)
    with_u, with_i = (at(articulate(said, FPS), said, 2) for said in (rounded, spread))
    assert with_u[PUSHED] > with_i[PUSHED] + 50.0
    assert with_u[CORNER] < with_i[CORNER] - 20.0


def test_faster_speech_reaches_less() -> None:
    opened = []
    for length in (0.3, 0.12, 0.06):
        said = uttered("t ɑ t ɑ t", length)
        opened.append(float(at(articulate(said, FPS), said, 1)[JAW]))
    assert opened[0] > opened[1] > opened[2] > 150.0


def test_sliders_scale_lips_and_jaw_apart_and_leave_closures() -> None:
    said = uttered("u p ɑ", 0.2)
    plain = articulate(said, FPS)
    distinct, wide = articulate(said, FPS, articulation=1.5), articulate(said, FPS, jaw=1.5)
    assert at(distinct, said, 0)[PUSHED] == pytest.approx(1.5 * at(plain, said, 0)[PUSHED], rel=0.02)
    assert at(distinct, said, 2)[JAW] == pytest.approx(at(plain, said, 2)[JAW])
    assert at(wide, said, 2)[JAW] == pytest.approx(1.5 * at(plain, said, 2)[JAW], rel=0.02)
    for frames in (distinct, wide, articulate(said, FPS, articulation=0.0, jaw=0.0)):
        np.testing.assert_allclose(at(frames, said, 1)[[UPPER, LOWER]], at(plain, said, 1)[[UPPER, LOWER]])


def test_a_stressed_vowel_opens_more() -> None:
    said = uttered("t ɑ t æ t", 0.2, stress="ɑ")
    plain = uttered("t ɑ t æ t", 0.2)
    marked, unmarked = articulate(said, FPS), articulate(plain, FPS)
    assert at(marked, said, 1)[JAW] > 1.1 * at(unmarked, plain, 1)[JAW]
    assert at(marked, said, 3)[JAW] < 0.95 * at(unmarked, plain, 3)[JAW]


def test_h_has_the_mouth_of_the_vowel_after_it() -> None:
    rounded, spread = uttered("h u", 0.15), uttered("h i", 0.15)
    pushed = [float(at(articulate(said, FPS), said, 0)[PUSHED]) for said in (rounded, spread)]
    assert pushed[0] > 150.0 > 60.0 > pushed[1]


def test_the_jaw_is_no_faster_than_talkers_jaws(shared: Path) -> None:
    """On a face whose mouth is 17 mm below its nose (MNS0), as the default head's: up to about 200 mm/s in speech."""
    said = read_marks(shared / "samples" / "speech" / "textgrid" / "mary.TextGrid")
    jaw = articulate(said, 200.0)[:, JAW] * 17.0 / 1024.0
    assert 40.0 < np.abs(np.diff(jaw)).max() * 200.0 < 250.0


@pytest.mark.parametrize(
    "wrong", [{"fps": 0.0}, {"fps": float("nan")}, {"articulation": -0.1}, {"jaw": 2.1}, {"articulation": float("nan")}]
)
def test_values_out_of_range_are_refused(wrong: dict[str, float]) -> None:
    with pytest.raises(ParameterError):
        articulate(uttered("p a"), **wrong)


def test_sounds_that_overlap_are_refused() -> None:
    sound = phonemes()["a"]
    with pytest.raises(ParameterError, match="must end after they start, and start after"):
        Utterance((Sound(0.0, 0.5, sound), Sound(0.4, 0.6, sound)), 1.0)
    with pytest.raises(ParameterError, match="duration"):
        Utterance((Sound(0.0, 0.5, sound),), 0.3)
