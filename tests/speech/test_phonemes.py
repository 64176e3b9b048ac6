"""Speech sounds and the alphabets that write them."""

from __future__ import annotations

import pytest
from risorius.mpeg4 import VISEMES
from risorius.speech.phonemes import Alphabet, alphabet_of, is_pause, phonemes, read_symbol

#: The phonemes of the standard's table, in the letters that it is printed in, and the same in X-SAMPA.
STANDARD = {number: viseme.phonemes for number, viseme in VISEMES.items() if number}


def letters(symbol: str, alphabet: Alphabet) -> list[str]:
    """The sounds of a symbol."""
    return [sound.symbol for sound in read_symbol(symbol, alphabet)]


@pytest.mark.parametrize("number", STANDARD)
def test_every_phoneme_of_the_standard_has_the_standards_viseme(number: int) -> None:
    for symbol in STANDARD[number]:
        written = {"r": "r\\"}.get(symbol, symbol)
        (sound,) = read_symbol(written, Alphabet.XSAMPA)
        assert (sound.viseme, sound.stands_in) == (number, None), symbol


def test_a_sound_without_a_viseme_is_shown_as_its_nearest() -> None:
    known = phonemes()
    for symbol, nearest in {
        "q": "k",
        "ɳ": "n",
        "β": "b",
        "ɕ": "ʃ",
        "ɯ": "ɪ",
        "ɵ": "o",
        "ɬ": "s",
        "ʂ": "ʃ",
        "c": "k",
        "ɻ": "ɹ",
    }.items():
        assert known[symbol].stands_in is not None
        assert known[symbol].viseme == known[nearest].viseme, (symbol, known[symbol].stands_in)


def test_every_sound_has_a_viseme_of_the_standard() -> None:
    assert {sound.viseme for sound in phonemes().values()} == set(range(15))
    assert [s for s, sound in phonemes().items() if sound.viseme == 0] == ["h", "ɦ", "ʔ", "ħ", "ʕ"]
    assert not any(sound.own for sound in phonemes().values() if sound.viseme == 0)


@pytest.mark.parametrize(
    ("symbol", "alphabet", "said"),
    [
        ("AA1", Alphabet.ARPABET, ["ɑ"]),
        ("aa", Alphabet.ARPABET, ["ɑ"]),
        ("AH0", Alphabet.ARPABET, ["ə"]),
        ("AH1", Alphabet.ARPABET, ["ʌ"]),
        ("AY2", Alphabet.ARPABET, ["a", "ɪ"]),
        ("PT", Alphabet.ARPABET, ["p", "t"]),
        ("tʃ", Alphabet.IPA, ["tʃ"]),
        ("t͡ʃ", Alphabet.IPA, ["tʃ"]),
        ("ˈiː", Alphabet.IPA, ["i"]),
        ("pʰ", Alphabet.IPA, ["p"]),
        ("tʷ", Alphabet.IPA, ["t", "w"]),
        ("ɛ̃", Alphabet.IPA, ["ɛ"]),
        ("ẽ", Alphabet.IPA, ["e"]),
        ("ç", Alphabet.IPA, ["ç"]),
        ("g", Alphabet.IPA, ["ɡ"]),
        ("aɪ", Alphabet.IPA, ["a", "ɪ"]),
        ("ə˞", Alphabet.IPA, ["ɚ"]),
        ("tS", Alphabet.XSAMPA, ["tʃ"]),
        ("eI", Alphabet.XSAMPA, ["e", "ɪ"]),
        ('"i:', Alphabet.XSAMPA, ["i"]),
        ("t_h", Alphabet.XSAMPA, ["t"]),
        ("@`", Alphabet.XSAMPA, ["ɚ"]),
        ("r\\", Alphabet.XSAMPA, ["ɹ"]),
        ("9~", Alphabet.XSAMPA, ["œ"]),
        ("w1", Alphabet.IPA, []),
        ("кот", Alphabet.IPA, []),
        ("", Alphabet.XSAMPA, []),
    ],
)
def test_symbols_are_read(symbol: str, alphabet: Alphabet, said: list[str]) -> None:
    assert letters(symbol, alphabet) == said


@pytest.mark.parametrize(
    ("symbols", "alphabet"),
    [
        (["B", "AA1", "B", "IY0"], Alphabet.ARPABET),
        (["h#", "sh", "iy", "hh", "ae", "dcl", "d"], Alphabet.ARPABET),
        (["d", "eI", "m", "@", "n"], Alphabet.XSAMPA),
        (["m", "ə", "r", "i"], Alphabet.IPA),
        (["sil", "m", "a", "t"], Alphabet.IPA),
        (["tʲ", "ʃ", "aː"], Alphabet.IPA),
    ],
)
def test_the_alphabet_is_found(symbols: list[str], alphabet: Alphabet) -> None:
    assert alphabet_of(symbols) is alphabet


def test_pauses_are_told_from_sounds() -> None:
    assert all(map(is_pause, ["", " ", "sil", "SIL", "sp", "<eps>", "h#", "<p:>"]))
    assert not any(map(is_pause, ["s", "p", "spn", "h"]))
