"""Praat's TextGrids, long, short and as JSON, as the Montreal Forced Aligner, MAUS and ELAN write them.

praatio reads the format; which tier holds the sounds is found here.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ...errors import FormatError
from ...tables import parsed_number
from ..phonemes import alphabet_of, is_noise, is_pause, read_symbol
from .labels import Label, Timings

#: What tiers of sounds and of words are called, in lower case, the last word of "Anna - phones" alone.
SOUND_TIERS = (
    "phone", "phones", "phoneme", "phonemes", "phon", "phons", "segment", "segments", "seg", "segs", "mau",
    "phonetic", "phn", "phonetics", "sounds", "ipa", "sampa", "laute", "son", "fonemas", "phonèmes", "fonemi",
)  # fmt: skip
WORD_TIERS = ("word", "words", "ort", "ort-mau", "orthography", "wort", "wörter", "mots", "palabras", "parole")
#: Of a tier with another name, the least share of marks that are known sounds, and the most seconds that they last.
KNOWN, LONGEST = 0.9, 0.25


@dataclass(frozen=True)
class Tier:
    """A tier of intervals: its name, and its marks."""

    name: str
    labels: Sequence[Label]

    @property
    def kind(self) -> str:
        """The name without the speaker's."""
        return self.name.lower().split(" - ")[-1].strip()

    @property
    def speaker(self) -> str:
        """What stands before the kind; empty where nothing does."""
        return self.name.rpartition(" - ")[0].strip()


def textgrid_timings(path: Path, text: str, tier: str | None = None) -> Timings:
    """The sounds and words of a TextGrid.

    Parameters
    ----------
    tier : name of the tier with the sounds; found by its name or by what stands in it if not given.

    Raises
    ------
    FormatError : it cannot be read, has no tier of sounds or several, or lacks the named one.
    """
    grid = _parsed(path, text)
    tiers = [
        _tier(path, number, found) for number, found in enumerate(grid["tiers"], 1) if found["class"] == "IntervalTier"
    ]
    if not tiers:
        raise FormatError(path, "has no tier of intervals: align sounds with times first")
    return tier_timings(path, tiers, tier, _end(path, grid))


def tier_timings(path: Path, tiers: Sequence[Tier], wanted: str | None, duration: float | None) -> Timings:
    """The sounds of one tier, and the same speaker's words; errors as `textgrid_timings`."""
    sounds, assumed = _sound_tier(path, tiers, wanted)
    words = [found for found in tiers if found.kind in WORD_TIERS and found.speaker == sounds.speaker]
    said = () if assumed is None else (assumed,)
    return Timings(path, sounds.labels, words[0].labels if words else (), duration, assumed=said)


def _parsed(path: Path, text: str) -> Mapping[str, Any]:
    """What praatio reads."""
    try:
        from praatio.utilities.textgrid_io import parseTextgridStr
    except ImportError as error:
        raise FormatError(path, "needs the package praatio to be read: install it with pip") from error
    try:
        grid: Mapping[str, Any] = parseTextgridStr(text, includeEmptyIntervals=True)
        if not isinstance(grid["tiers"], list):
            raise TypeError
    except Exception as error:  # praatio raises whatever its string handling meets
        raise FormatError(path, "is no whole TextGrid: is the file cut off?") from error
    return grid


def _end(path: Path, grid: Mapping[str, Any]) -> float:
    """Where the TextGrid ends, in seconds."""
    try:
        return float(grid["xmax"])
    except (TypeError, ValueError, KeyError) as error:
        raise FormatError(path, "does not say where it ends (xmax): is the file cut off?") from error


def _tier(path: Path, number: int, tier: Mapping[str, Any]) -> Tier:
    """One tier of intervals."""
    name = str(tier["name"]) or f"number {number}"
    labels = []
    for place, (start, end, text) in enumerate(tier["entries"], 1):
        where = f"interval {place} of tier {name}"
        begun, ended = parsed_number(str(start)), parsed_number(str(end))
        if begun is None or ended is None:
            raise FormatError(path, f"{where}: times must be numbers of seconds, but are {start!r} and {end!r}")
        labels.append(Label(float(begun), float(ended), str(text).strip(), where))
    return Tier(name, labels)


def _sound_tier(path: Path, tiers: Sequence[Tier], wanted: str | None) -> tuple[Tier, str | None]:
    """The tier with the sounds, and what is assumed."""
    names = ", ".join(tier.name for tier in tiers)
    if wanted is not None:
        named = [tier for tier in tiers if tier.name == wanted] or [
            t for t in tiers if t.name.lower() == wanted.lower()
        ]
        if not named:
            raise FormatError(path, f"has no tier {wanted!r}: choose one of {names}")
        return named[0], None
    called = [tier for tier in tiers if tier.kind in SOUND_TIERS and _says_something(tier)]
    if len(called) == 1:
        return called[0], None
    if called:
        raise FormatError(path, f"has {len(called)} tiers of sounds: choose one of {', '.join(t.name for t in called)}")
    alike = [tier for tier in tiers if _looks_like_sounds(tier)]
    if len(alike) == 1:
        return alike[0], f"tier {alike[0].name!r} is read as the sounds"
    if alike:
        raise FormatError(
            path, f"has {len(alike)} tiers that may be sounds: choose one of {', '.join(t.name for t in alike)}"
        )
    if any(tier.kind in WORD_TIERS and _says_something(tier) for tier in tiers):
        raise FormatError(path, f"has words but no sounds ({names}): align them with a forced aligner first")
    if not any(_says_something(tier) for tier in tiers):
        raise FormatError(path, f"has only empty tiers ({names}): it needs one that says when sounds are")
    raise FormatError(path, f"has no tier of sounds ({names}): choose the tier that holds them")


def _says_something(tier: Tier) -> bool:
    """Whether anything but pauses stands in a tier."""
    return any(not is_pause(label.text) for label in tier.labels)


def _looks_like_sounds(tier: Tier) -> bool:
    """Whether a tier of any name holds sounds: known ones, none long."""
    spoken = [label for label in tier.labels if not is_pause(label.text) and not is_noise(label.text)]
    if not spoken:
        return False
    alphabet = alphabet_of(label.text for label in spoken)
    known = sum(bool(read_symbol(label.text, alphabet)) for label in spoken) / len(spoken)
    return known >= KNOWN and sum(label.end - label.start for label in spoken) / len(spoken) <= LONGEST
