"""A line of words: changed one by one, never out of order, and said as it stands."""

from __future__ import annotations

import numpy as np
import pytest
import risorius.api as api
from risorius.errors import ParameterError
from risorius.speech.articulation import articulate
from risorius.speech.line import Line, LineWord, interrupted, line_of, together, utterance_of_line
from risorius.speech.utterance import Sound, SpokenWord, Utterance


def sound(symbol: str, viseme: int, start: float, end: float, **fields: float) -> Sound:
    """A sound."""
    return Sound(start, end, api.Phoneme(symbol, viseme), symbol, **fields)


SAID = Utterance(
    (sound("m", 1, 0.0, 0.1), sound("i", 12, 0.1, 0.2), sound("p", 1, 0.3, 0.4), sound("a", 10, 0.4, 0.6)),
    0.8,
    (SpokenWord(0.0, 0.2, "me"), SpokenWord(0.3, 0.6, "up")),
)


def test_a_line_says_what_the_utterance_says() -> None:
    line = line_of(SAID)
    assert [word.title for word in line.words] == ["me", "up"]
    assert utterance_of_line(line) == SAID


def test_sounds_outside_all_words_are_parted_by_pauses() -> None:
    line = line_of(Utterance((*SAID.sounds[:2], sound("p", 1, 0.4, 0.5)), 0.5))
    assert [(word.text, word.title) for word in line.words] == [("", "m i"), ("", "p")]


def test_a_word_at_another_time_takes_its_sounds_along() -> None:
    line = line_of(SAID)
    moved = line.with_word(1, line.words[1].over(0.4, 1.0))
    assert [(s.start, s.end) for s in moved.words[1].sounds] == [
        (0.4, pytest.approx(0.6)),
        (pytest.approx(0.6), pytest.approx(1.0)),
    ]
    assert moved.duration == pytest.approx(1.0)
    with pytest.raises(ParameterError, match="start after the word before them has ended"):
        line.with_word(1, line.words[1].over(0.1, 0.3))
    assert line.room(0) == (0.0, 0.3)
    assert line.room(1) == (0.2, float("inf"))


def test_a_word_is_split_between_its_sounds_and_joined_again() -> None:
    line = line_of(SAID)
    split = line.split(0, 0.12)
    assert [(word.text, word.start, word.end) for word in split.words[:2]] == [("m", 0.0, 0.1), ("e", 0.1, 0.2)]
    assert split.joined(0).words[0].sounds == line.words[0].sounds
    with pytest.raises(ParameterError, match="must be between two sounds"):
        line.split(0, 0.01)
    with pytest.raises(ParameterError, match="must have another one after it"):
        line.joined(1)


def test_a_word_is_inserted_in_the_room_there_is() -> None:
    line = line_of(SAID).without(0)
    word = LineWord("you", 0.2, 0.5, (sound("u", 14, 0.2, 0.5),))
    more = line.inserted(0, word)
    assert [(w.text, w.start, w.end) for w in more.words[:1]] == [("you", 0.0, pytest.approx(0.3))]
    with pytest.raises(ParameterError, match="must be left between you and up"):
        more.inserted(1, word)


def test_the_later_of_two_lines_cuts_the_other_off() -> None:
    parts = [(0.0, 1.0, line_of(SAID)), (0.45, 2.0, line_of(SAID))]
    said = together(parts)
    assert [(s.symbol, round(s.start, 6), round(s.end, 6)) for s in said.sounds[2:5]] == [
        ("p", 0.3, 0.4), ("a", 0.4, 0.45), ("m", 0.45, 0.65),
    ]  # fmt: skip
    assert interrupted(parts) == [0]
    assert interrupted([(0.0, 1.0, line_of(SAID)), (0.6, 1.0, line_of(SAID))]) == []


@pytest.mark.parametrize("strength", [0.0, 0.5, 1.0])
def test_strength_is_how_far_the_mouth_goes(strength: float) -> None:
    jaw = api.fap("open_jaw").number - 1
    full = articulate(Utterance((sound("a", 10, 0.2, 0.5),), 0.7), 50.0)[:, jaw]
    said = articulate(Utterance((sound("a", 10, 0.2, 0.5, strength=strength),), 0.7), 50.0)[:, jaw]
    assert np.allclose(said, strength * full)


def test_a_closure_that_is_said_weakly_closes_less() -> None:
    lips = [number - 1 for number in (4, 5)]

    def apart(strength: float) -> float:
        sounds = (sound("a", 10, 0.0, 0.2), sound("m", 1, 0.2, 0.3, strength=strength), sound("a", 10, 0.3, 0.5))
        return float(articulate(Utterance(sounds, 0.5), 100.0)[25, lips].sum())

    assert apart(0.0) < apart(0.5) < apart(1.0)


def test_a_strength_out_of_range_and_words_out_of_order_are_refused() -> None:
    with pytest.raises(ParameterError, match="must be from 0 to 2"):
        Utterance((sound("a", 10, 0.0, 0.1, strength=3.0),), 0.1)
    word = LineWord("a", 0.0, 0.2, (sound("a", 10, 0.0, 0.2),))
    with pytest.raises(ParameterError, match="must end after they start"):
        Line((word, word), 1.0)
