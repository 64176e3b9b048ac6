"""Speech sounds: letters of the International Phonetic Alphabet, the viseme that shows each, and other alphabets.

Tables: presets/speech/phonemes.csv and alphabets.csv. A sound for which no viseme is known is shown as the nearest one
by its features; whoever reads symbols learns it from `Phoneme.stands_in`.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from enum import StrEnum
from functools import cache

from ..resources import PRESETS
from ..tables import CsvRow, read_csv

FOLDER = PRESETS / "speech"

#: Places of articulation from the lips inwards, heights of the tongue from close to open, its place from the front.
PLACES = (
    "bilabial", "labiodental", "dental", "alveolar", "retroflex", "postalveolar", "alveolopalatal", "palatal", "velar",
    "uvular", "pharyngeal", "glottal",
)  # fmt: skip
HEIGHTS = ("close", "near-close", "close-mid", "mid", "open-mid", "near-open", "open")
BACKNESS = ("front", "central", "back")
#: What another manner, a glide for what is none, and other lips count beside a step of place or height.
OTHER_MANNER, GLIDE, OTHER_LIPS = 0.5, 2.0, 3.0

#: Written as one letter, or with a letter of ASCII; and the mark of an r-coloured vowel.
SAME_LETTER = {
    "g": "ɡ", "ʦ": "ts", "ʣ": "dz", "ʧ": "tʃ", "ʤ": "dʒ", "ʨ": "tɕ", "ʥ": "dʑ", "ʜ": "ħ", "ʢ": "ʕ", "ʡ": "ʔ",
}  # fmt: skip
R_COLOURED = {"ə˞": "ɚ", "ɜ˞": "ɝ"}
#: Consonants whose lips are rounded: what follows them is a short w.
LABIALISED, ROUNDING = "ʷ", "w"
#: Unicode's kinds of characters that are no letters: marks above and below, small letters behind, stress, hyphens.
MARKS = ("Mn", "Lm", "Sk", "Po", "Sm", "Pd")
#: What Praat, the Montreal Forced Aligner, MAUS, TIMIT and Kaldi write where nothing is said.
PAUSES = frozenset({
    "", "sil", "sp", "pau", "h#", "epi", "#", "##", "_", "-", "<eps>", "<sil>", "<p:>", "<p>", "<pause>", "(.)",
    "(...)", "...", "silence", "pause", "|", "‖", ".",
})  # fmt: skip
#: Sounds that are no speech, or that an aligner could not name.
NOISES = frozenset({"spn", "nsn", "noise", "<unk>", "<oov>", "unk", "<nib>", "<usb>", "breath", "laugh", "<laugh>"})


class Alphabet(StrEnum):
    """How speech sounds are written."""

    IPA = "ipa"
    ARPABET = "arpabet"
    XSAMPA = "xsampa"


@dataclass(frozen=True)
class Phoneme:
    """A speech sound as the mouth shows it.

    Attributes
    ----------
    symbol : its letters of the International Phonetic Alphabet.
    viseme : of FAP 1, 1..14; 0 for a sound that has no mouth of its own.
    jaw, lips : shares of the viseme's opening and of its lip shape.
    own : whether the mouth is its own, and not its neighbours'.
    vowel : whether it is one.
    stands_in : the sound whose viseme is shown, where this one has none.
    """

    symbol: str
    viseme: int
    jaw: float = 1.0
    lips: float = 1.0
    own: bool = True
    vowel: bool = False
    stands_in: str | None = None


@cache
def phonemes() -> Mapping[str, Phoneme]:
    """Every sound of the table by its letters."""
    rows = read_csv(
        FOLDER / "phonemes.csv", "ipa", "kind", "place", "manner", "rounding", "viseme", "jaw", "lips", "own"
    )
    shown = [row for row in rows if "viseme" in row]
    return {row.text("ipa"): _phoneme(row, shown) for row in rows}


def _phoneme(row: CsvRow, shown: list[CsvRow]) -> Phoneme:
    """A row as a sound."""
    by = row if "viseme" in row else min(shown, key=lambda other: _distance(row, other))
    return Phoneme(
        row.text("ipa"),
        by.integer("viseme", least=0, most=14),
        row.number("jaw", above=0.0),
        row.number("lips", above=0.0),
        by.integer("own", least=0, most=1) == 1,
        row.text("kind") == "vowel",
        None if by is row else by.text("ipa"),
    )


def _distance(one: CsvRow, other: CsvRow) -> float:
    """How unlike two sounds are to look at."""
    if one.text("kind") != other.text("kind"):
        return float("inf")
    lips = OTHER_LIPS * (one.text("rounding") != other.text("rounding"))
    if one.text("kind") == "vowel":
        height = abs(HEIGHTS.index(one.choice("place", HEIGHTS)) - HEIGHTS.index(other.choice("place", HEIGHTS)))
        back = abs(BACKNESS.index(one.choice("manner", BACKNESS)) - BACKNESS.index(other.choice("manner", BACKNESS)))
        return height + OTHER_MANNER * back + lips
    place = abs(PLACES.index(one.choice("place", PLACES)) - PLACES.index(other.choice("place", PLACES)))
    manners = {one.text("manner"), other.text("manner")}
    manner = 0.0 if len(manners) == 1 else GLIDE if "approximant" in manners else OTHER_MANNER
    return place + manner + lips


@cache
def _spellings(alphabet: Alphabet) -> Mapping[str, tuple[str, ...]]:
    """Symbol -> letters of the International Phonetic Alphabet."""
    own = {letters: (letters,) for letters in phonemes()}
    if alphabet is Alphabet.IPA:
        return own
    rows = read_csv(FOLDER / "alphabets.csv", "alphabet", "symbol", "ipa")
    table = {row.text("symbol"): row.texts("ipa") for row in rows if row.text("alphabet") == alphabet}
    return table if alphabet is Alphabet.ARPABET else {**own, **table}


def is_pause(symbol: str) -> bool:
    """Whether a symbol says that nothing is said."""
    return symbol.strip().lower() in PAUSES


def is_noise(symbol: str) -> bool:
    """Whether a symbol says that something is heard that is no known speech."""
    return symbol.strip().lower() in NOISES


def is_mark(symbol: str) -> bool:
    """Whether a symbol of IPA is a mark alone, which belongs to the sound before it."""
    return bool(symbol.strip()) and not _without_marks(symbol.strip())


def read_symbol(symbol: str, alphabet: Alphabet) -> tuple[Phoneme, ...]:
    """The sounds of one symbol, one after another: a diphthong has two. Empty where the symbol is unknown.

    Stress, length, tone and other marks that leave the mouth as it is are passed over.
    """
    if is_noise(symbol):
        return ()
    readers = {Alphabet.IPA: _letters, Alphabet.ARPABET: _arpabet, Alphabet.XSAMPA: _xsampa}
    return tuple(phonemes()[letters] for letters in readers[alphabet](symbol.strip()))


def alphabet_of(symbols: Iterable[str]) -> Alphabet:
    """The alphabet in which most of the symbols are known; ARPAbet and then IPA where several do as well."""
    told = {symbol for symbol in symbols if not is_pause(symbol) and not is_noise(symbol)}
    order = (Alphabet.ARPABET, Alphabet.IPA, Alphabet.XSAMPA)
    return max(order, key=lambda alphabet: sum(bool(read_symbol(symbol, alphabet)) for symbol in told))


def _arpabet(symbol: str) -> tuple[str, ...]:
    """Upper or lower case, with or without a digit of stress; in upper case several may be written as one."""
    table, name = _spellings(Alphabet.ARPABET), symbol.upper()
    whole = table.get(name) or table.get(name.rstrip("0123456789"))
    return whole or (_parsed(symbol.rstrip("0123456789"), table) if symbol == name else ())


def _letters(symbol: str) -> tuple[str, ...]:
    """Letters of the International Phonetic Alphabet without marks, the longest first."""
    plain = _without_marks(symbol)
    return _parsed(plain, _spellings(Alphabet.IPA))


def _without_marks(symbol: str) -> str:
    """A symbol's letters; marks above, below and behind them fall away."""
    text = unicodedata.normalize("NFC", symbol)
    for written, letter in {**R_COLOURED, LABIALISED: ROUNDING, **SAME_LETTER}.items():
        text = text.replace(written, letter)
    kept = []
    for character in text:
        letters = character if character in phonemes() else unicodedata.normalize("NFD", character)
        kept += [letter for letter in letters if unicodedata.category(letter) not in MARKS]
    return "".join(kept)


#: Marks of X-SAMPA that leave the mouth as it is: stress, length, syllables, and what stands behind an underscore.
XSAMPA_MARKS = ('"', "%", ":\\", ":", "-", "'", "~", "=", "!", "^", "|", "*")


def _xsampa(symbol: str) -> tuple[str, ...]:
    """X-SAMPA, of which SAMPA is a part."""
    rest, found = symbol, ""
    table = _spellings(Alphabet.XSAMPA)
    sounds: list[str] = []
    while rest:
        found = _longest(rest, table)
        mark = next((mark for mark in XSAMPA_MARKS if rest.startswith(mark)), "")
        if found:
            sounds += table[found]
            rest = rest[len(found) :]
        elif rest.startswith("_w"):
            sounds, rest = [*sounds, ROUNDING], rest[2:]
        elif rest.startswith("_") and len(rest) > 1:
            rest = rest[2:]
        elif mark:
            rest = rest[len(mark) :]
        else:
            return ()
    return tuple(sound for sound in sounds if sound in phonemes())


def _parsed(text: str, table: Mapping[str, tuple[str, ...]]) -> tuple[str, ...]:
    """A text cut into symbols of a table; empty where any of it is unknown."""
    sounds: list[str] = []
    while text:
        found = _longest(text, table)
        if not found:
            return ()
        sounds += table[found]
        text = text[len(found) :]
    return tuple(sounds)


def _longest(text: str, table: Mapping[str, tuple[str, ...]]) -> str:
    """The longest symbol at a text's beginning; empty where there is none."""
    for length in range(min(len(text), max(map(len, table))), 0, -1):
        if text[:length] in table:
            return text[:length]
    return ""
