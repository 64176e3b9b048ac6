"""Between lines and what preset files keep of speech."""

from __future__ import annotations

from ..mpeg4.preset_speech import KeptSound, KeptSpeech, KeptWord
from .line import Line, LineWord
from .phonemes import Phoneme
from .utterance import Sound

#: Digits of seconds that are kept.
DIGITS = 6


def kept_words(line: Line) -> tuple[KeptWord, ...]:
    """A line's words as a preset keeps them."""
    return tuple(
        KeptWord(word.text, word.start, word.end, tuple(_kept(sound) for sound in word.sounds), word.strength)
        for word in line.words
    )


def _kept(sound: Sound) -> KeptSound:
    """A sound."""
    by, times = sound.phoneme, (round(sound.start, DIGITS), round(sound.end, DIGITS))
    return KeptSound(sound.symbol, by.viseme, *times, sound.strength, sound.stress, by.jaw, by.lips, by.own, by.vowel)


def line_of_kept(kept: KeptSpeech) -> Line:
    """What a preset's speech says, not stretched."""
    words = tuple(
        LineWord(word.name, word.start, word.end, tuple(_sound(sound) for sound in word.sounds), word.strength)
        for word in kept.words
    )
    return Line(words, words[-1].end if words else 0.0)


def _sound(kept: KeptSound) -> Sound:
    """A sound."""
    phoneme = Phoneme(kept.symbol, kept.viseme, kept.jaw, kept.lips, kept.own, kept.vowel)
    return Sound(kept.start, kept.end, phoneme, kept.symbol, kept.stress, kept.strength)
