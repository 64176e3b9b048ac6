"""Speech on a timeline as a preset file keeps it: words with their sounds, each with its time."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from ..errors import ParameterError
from ..tables import TomlTable, toml_number, toml_text
from .high_level import VISEMES

#: How distinctly a word or a sound may be said at most.
STRONGEST = 2.0


@dataclass(frozen=True)
class KeptSound:
    """A sound: its symbol, viseme 0 to 14, and from when to when, seconds from the beginning of the speech.

    `strength`, `jaw` and `lips` are shares of the viseme, `stress` is 0 to 1; `own` says whether the mouth is its own.
    """

    symbol: str
    viseme: int
    start: float
    end: float
    strength: float = 1.0
    stress: float = 0.0
    jaw: float = 1.0
    lips: float = 1.0
    own: bool = True
    vowel: bool = False

    def __post_init__(self) -> None:
        """Check viseme, times and strength."""
        if self.viseme not in VISEMES:
            raise ParameterError("viseme", "must be a number from 0 to 14", self.viseme)
        if not 0.0 <= self.start < self.end < math.inf:
            raise ParameterError(
                "times", "must be two numbers of seconds, the later one second", (self.start, self.end)
            )
        if not 0.0 <= self.strength <= STRONGEST:
            raise ParameterError("strength", f"must be from 0 to {STRONGEST:g}", self.strength)


@dataclass(frozen=True)
class KeptWord:
    """A word: its letters, from when to when, how distinctly it is said, and its sounds."""

    name: str
    start: float
    end: float
    sounds: tuple[KeptSound, ...]
    strength: float = 1.0


@dataclass(frozen=True)
class KeptSpeech:
    """Something said in time.

    Attributes
    ----------
    start : seconds from the timeline's beginning. words : in order.
    stretch : how many times longer it lasts. sound : path of its sound, which may be beside the preset; or empty.
    voice : by which words are pronounced.
    """

    start: float
    words: tuple[KeptWord, ...]
    name: str = ""
    stretch: float = 1.0
    mute: bool = False
    sound: str = ""
    voice: str = "en"

    def __post_init__(self) -> None:
        """Check its times."""
        if not 0.0 <= self.start < math.inf:
            raise ParameterError("start", "must be a number of seconds, 0 or more", self.start)
        if not 0.0 < self.stretch < math.inf:
            raise ParameterError("stretch", "must be above 0", self.stretch)
        last = 0.0
        for word in self.words:
            if not last - 1e-6 <= word.start < word.end:
                raise ParameterError("words", f"must be in order: {word.name!r} starts or ends too early", word.start)
            for sound in word.sounds:
                if not (last - 1e-6 <= sound.start and sound.end <= word.end + 1e-6):
                    raise ParameterError(
                        "times", f"must be in order and inside {word.name!r}", (sound.start, sound.end)
                    )
                last = sound.end
            last = word.end


#: Keys of a speech and of a word; those of a word that have a value for each sound, and what is usual.
KEYS = ("name", "start", "stretch", "mute", "sound", "voice", "words")
WORD_KEYS = ("name", "start", "end", "strength", "sounds", "visemes", "times")
SHARES = {"strengths": ("strength", 1.0), "stresses": ("stress", 0.0), "jaws": ("jaw", 1.0), "lips": ("lips", 1.0)}
FLAGS = {"shared": ("own", True), "vowels": ("vowel", False)}


def speech_lines(speech: KeptSpeech) -> list[str]:
    """A speech as TOML."""
    lines = ["", "[[speech]]", *([f"name = {toml_text(speech.name)}"] if speech.name else [])]
    lines += [f"{key} = {toml_number(getattr(speech, key))}" for key in ("start", "stretch")]
    lines += [f"{key} = {toml_text(getattr(speech, key))}" for key in ("sound", "voice") if getattr(speech, key)]
    lines += ["mute = true"] if speech.mute else []
    for word in speech.words:
        lines += ["", "[[speech.words]]", f"name = {toml_text(word.name)}"]
        lines += [f"{key} = {toml_number(getattr(word, key))}" for key in ("start", "end", "strength")]
        lines += _sound_lines(word.sounds)
    return lines


def _sound_lines(sounds: Sequence[KeptSound]) -> list[str]:
    """Sounds as lists of a value each; what is usual for all is left out."""
    times = ", ".join(f"{toml_number(sound.start)}, {toml_number(sound.end)}" for sound in sounds)
    lines = [
        f"sounds = [{', '.join(toml_text(sound.symbol) for sound in sounds)}]",
        f"visemes = [{', '.join(str(sound.viseme) for sound in sounds)}]",
        f"times = [{times}]",
    ]
    for key, (field, usual) in SHARES.items():
        if any(getattr(sound, field) != usual for sound in sounds):
            lines.append(f"{key} = [{', '.join(toml_number(getattr(sound, field)) for sound in sounds)}]")
    for key, (field, flag) in FLAGS.items():
        marked = [str(n) for n, sound in enumerate(sounds) if getattr(sound, field) is not flag]
        lines += [f"{key} = [{', '.join(marked)}]"] if marked else []
    return lines


def read_speech(table: TomlTable) -> KeptSpeech:
    """A speech of a preset."""
    table.only(*KEYS)
    words = tuple(_word(entry) for entry in table.listed("words"))
    start, stretch, mute = table.number("start"), table.number("stretch", 1.0), table.flag("mute", False)
    name, sound, voice = table.text("name", ""), table.text("sound", ""), table.text("voice", "en")
    return table.made(lambda: KeptSpeech(start, words, name, stretch, mute, sound, voice))


def _word(table: TomlTable) -> KeptWord:
    """One word."""
    table.only(*WORD_KEYS, *SHARES, *FLAGS)
    symbols = [str(symbol) for symbol in table.entries("sounds").cells.values()]
    count = len(symbols)
    visemes, times = table.numbers("visemes", count), table.numbers("times", 2 * count)
    shares = {field: table.numbers(key, count) for key, (field, _) in SHARES.items() if key in table}
    flags = {
        field: {int(number) for number in table.entries(key).cells.values()}
        for key, (field, _) in FLAGS.items()
        if key in table
    }
    usual = dict(FLAGS.values())

    def sound(n: int) -> KeptSound:
        marks: dict[str, Any] = {
            field: not usual[field] if n in marked else usual[field] for field, marked in flags.items()
        }
        marks |= {field: float(values[n]) for field, values in shares.items()}
        return KeptSound(symbols[n], int(visemes[n]), float(times[2 * n]), float(times[2 * n + 1]), **marks)

    sounds = table.made(lambda: tuple(sound(n) for n in range(count)))
    strength = table.number("strength", 1.0)
    return KeptWord(table.text("name", ""), table.number("start"), table.number("end"), sounds, strength)
