"""Marks in time as files hold them, and the sounds that they stand for."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from ...errors import FormatError, ParameterError
from ...tables import read_csv
from ..phonemes import FOLDER, Alphabet, Phoneme, alphabet_of, is_pause, read_symbol
from ..utterance import Sound, SpokenWord, Utterance

#: Seconds by which two sounds may overlap for rounding alone, and the least that a sound lasts.
ROUNDING, LEAST = 0.002, 1e-6
#: Seconds of a day: no speech is later.
LATEST = 86400.0
#: Share of a diphthong that its first vowel lasts. Own choice: the nucleus is the longer part of a falling diphthong.
NUCLEUS = 0.6
#: Marks of main and of secondary stress before a symbol of IPA and X-SAMPA, and the digits of ARPAbet after it.
MAIN_STRESS, SECONDARY_STRESS = ("ˈ", '"'), ("ˌ", "%")
#: How many unknown symbols a message shows.
SHOWN = 8


@dataclass(frozen=True)
class Label:
    """A mark in time: seconds, its text, and where in the file it stands ("line 3", "interval 7 of tier phones")."""

    start: float
    end: float
    text: str
    where: str = ""


@dataclass(frozen=True)
class Timings:
    """What a file says.

    Attributes
    ----------
    path : the file. sounds, words : marks in the file's order.
    duration : seconds of the whole, where the file says so.
    read : from the text of a mark to its sounds; None where an alphabet is to be found.
    assumed : in words for people.
    """

    path: Path
    sounds: Sequence[Label]
    words: Sequence[Label] = ()
    duration: float | None = None
    read: Callable[[str], tuple[Phoneme, ...] | None] | None = None
    assumed: tuple[str, ...] = ()


def utterance_of(timings: Timings, alphabet: Alphabet | None = None) -> Utterance:
    """The sounds that the marks stand for.

    Raises
    ------
    FormatError : nothing is said, marks overlap or run backwards, or no symbol is known.
    """
    labels = [label for label in _in_order(timings.path, timings.sounds) if not is_pause(label.text)]
    if not labels:
        raise FormatError(timings.path, "says nothing: it needs at least one sound with its time")
    assumed = [*timings.assumed]
    read, unknown = timings.read, "is no sound of it"
    if read is None:
        chosen = alphabet or alphabet_of(label.text for label in labels)
        if alphabet is None:
            assumed.append(f"the sounds are read as {_named(chosen)}")
        read, unknown = (lambda text: read_symbol(text, chosen)), f"is no symbol of {_named(chosen)}"
    sounds = [sound for label in labels for sound in _sounds(label, read)]
    unread = _distinct(label.text for label in labels if not read(label.text))
    if len(unread) == len({label.text for label in labels}):
        if timings.read is None and alphabet is None:
            known = ", ".join(_named(each) for each in Alphabet)
            unknown = f"is no symbol of any of {known}: convert the symbols to one of them, or choose another tier"
            raise FormatError(timings.path, f"has no sound that is known: {unread[0]!r} {unknown}")
        problem = f"has no sound that is known: {unread[0]!r} {unknown}; choose another alphabet or tier"
        raise FormatError(timings.path, problem)
    if unread:
        more = f" and {len(unread) - SHOWN} more" if len(unread) > SHOWN else ""
        assumed.append(f"not known, the mouth passes over them: {', '.join(unread[:SHOWN])}{more}")
    assumed += _stand_ins(sounds)
    end = max(timings.duration or 0.0, sounds[-1].end)
    if not end <= LATEST:
        raise FormatError(timings.path, f"lasts {end:g} s: it must end within {LATEST:g} s")
    words = tuple(SpokenWord(word.start, word.end, word.text) for word in _words(timings))
    return Utterance(tuple(sounds), end, words, tuple(assumed))


def _named(alphabet: Alphabet) -> str:
    """An alphabet as people call it."""
    return {Alphabet.IPA: "IPA", Alphabet.ARPABET: "ARPAbet", Alphabet.XSAMPA: "X-SAMPA"}[alphabet]


def _sounds(label: Label, read: Callable[[str], tuple[Phoneme, ...] | None]) -> list[Sound]:
    """A mark's sounds in their time, the first one longer; what is not known leaves the mouth to its neighbours."""
    found = read(label.text) or (Phoneme(label.text, 0, own=False),)
    stress = _stress(label.text)
    if len(found) == 1:
        return [Sound(label.start, label.end, found[0], label.text, stress)]
    length, rest = label.end - label.start, (1.0 - NUCLEUS) / (len(found) - 1)
    shares = [0.0, NUCLEUS, *(NUCLEUS + rest * (n + 1) for n in range(len(found) - 2)), 1.0]
    times = [label.start + length * share for share in shares]
    return [
        Sound(start, end, sound, label.text, stress)
        for start, end, sound in zip(times[:-1], times[1:], found, strict=True)
    ]


def _stress(text: str) -> float:
    """The stress that a symbol carries."""
    if text.startswith(MAIN_STRESS) or text[-1:] == "1":
        return 1.0
    return 0.5 if text.startswith(SECONDARY_STRESS) or text[-1:] == "2" else 0.0


def _stand_ins(sounds: Iterable[Sound]) -> list[str]:
    """What is said of sounds that others stand in for."""
    told = {s.phoneme.symbol: s.phoneme.stands_in for s in sounds if s.phoneme.stands_in is not None}
    if not told:
        return []
    return ["shown as the nearest sound: " + ", ".join(f"{symbol} as {by}" for symbol, by in sorted(told.items()))]


def _words(timings: Timings) -> list[Label]:
    """The words that are said."""
    return [word for word in _in_order(timings.path, timings.words) if not is_pause(word.text)]


def _in_order(path: Path, labels: Sequence[Label]) -> list[Label]:
    """Marks in the order of their times, none inside another.

    Raises
    ------
    FormatError : a mark without length in the wrong direction, or two that overlap by more than rounding.
    """
    kept: list[Label] = []
    for label in sorted(labels, key=lambda mark: mark.start):
        if not (0.0 <= label.start <= LATEST and abs(label.end) <= LATEST):
            rule = "0 s or later" if label.start < 0.0 else f"within {LATEST:g} s"
            raise FormatError(path, f"{label.where}: times must be {rule}, but it is {label.start:g} to {label.end:g}")
        if label.end < label.start:
            raise FormatError(
                path, f"{label.where}: {label.text!r} ends at {label.end:g} s, before it starts at {label.start:g} s"
            )
        if kept and kept[-1].end - label.start > ROUNDING:
            other = f"{kept[-1].text!r} lasts to {kept[-1].end:g} s: correct the times, or choose one speaker's tier"
            raise FormatError(path, f"{label.where}: {label.text!r} starts at {label.start:g} s, but {other}")
        start = max(label.start, kept[-1].end) if kept else label.start
        if label.end - start > LEAST:
            kept.append(Label(start, label.end, label.text, label.where))
    return kept


def _distinct(texts: Iterable[str]) -> list[str]:
    """Each text once, in order."""
    return list(dict.fromkeys(texts))


@cache
def _mouth_shapes() -> dict[str, Phoneme]:
    """Mouth shapes of Rhubarb Lip Sync as sounds."""
    rows = read_csv(FOLDER / "mouth_shapes.csv", "shape", "viseme", "jaw", "lips")
    return {
        row.text("shape"): Phoneme(
            row.text("shape"), row.integer("viseme", least=0, most=14), row.number("jaw"), row.number("lips")
        )
        for row in rows
    }


def mouth_shape(text: str) -> tuple[Phoneme, ...] | None:
    """A mouth shape A to H or X; None where there is no such shape."""
    shape = _mouth_shapes().get(text.strip().upper())
    return None if shape is None else (shape,)


def viseme_number(text: str) -> tuple[Phoneme, ...] | None:
    """A viseme of FAP 1 by its number 0 to 14; None where there is none."""
    try:
        number = int(text)
        return (Phoneme(text, number),) if 0 <= number <= 14 else None
    except (ValueError, ParameterError):
        return None
