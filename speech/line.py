"""What is said as words that may be changed one by one: moved, split, joined, removed, said otherwise.

Nothing is changed in place: each change gives another line.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

from ..errors import ParameterError
from .utterance import STRONGEST, Sound, SpokenWord, Utterance

#: Seconds of the pause that parts sounds of which no words are known, and of the shortest word and sound.
PAUSE, LEAST = 0.12, 0.01


@dataclass(frozen=True)
class LineWord:
    """A word, or sounds between two pauses where no words are known.

    Attributes
    ----------
    text : its letters; empty where they are not known. start, end : seconds from the line's beginning.
    sounds : in order, between start and end. strength : how distinctly all of it is said, 0 to 2.
    """

    text: str
    start: float
    end: float
    sounds: tuple[Sound, ...]
    strength: float = 1.0

    @property
    def title(self) -> str:
        """Its letters, or else the symbols of its sounds."""
        return self.text or " ".join(sound.symbol or sound.phoneme.symbol for sound in self.sounds) or "-"

    def over(self, start: float, end: float) -> LineWord:
        """The word at another time, its sounds in proportion."""
        scale = (end - start) / (self.end - self.start)
        sounds = tuple(
            replace(s, start=start + (s.start - self.start) * scale, end=start + (s.end - self.start) * scale)
            for s in self.sounds
        )
        return replace(self, start=start, end=end, sounds=sounds)


@dataclass(frozen=True)
class Line:
    """Words in order, none before the one before it has ended; `duration` in seconds, at least to the last word's end.

    Raises
    ------
    ParameterError : words overlap, or a strength outside its range.
    """

    words: tuple[LineWord, ...]
    duration: float

    def __post_init__(self) -> None:
        """Check the order of words."""
        last = 0.0
        for word in self.words:
            if not last - 1e-6 <= word.start < word.end:
                rule = f"must end after they start, and start after the word before them has ended ({last:g} s)"
                raise ParameterError("words", rule, (word.title, word.start, word.end))
            if not 0.0 <= word.strength <= STRONGEST:
                raise ParameterError("strength", f"must be from 0 to {STRONGEST:g}", word.strength)
            last = word.end
        if not self.duration >= last - 1e-6:
            raise ParameterError("duration", f"must be at least {last:g} seconds", self.duration)

    def room(self, number: int) -> tuple[float, float]:
        """From when to when a word may last: to its neighbours, the last one as long as it likes."""
        before = self.words[number - 1].end if number else 0.0
        after = self.words[number + 1].start if number + 1 < len(self.words) else float("inf")
        return before, after

    def with_word(self, number: int, word: LineWord) -> Line:
        """Another word in the place of one."""
        words = (*self.words[:number], word, *self.words[number + 1 :])
        return Line(words, max(self.duration, words[-1].end))

    def without(self, number: int) -> Line:
        """A pause in the place of a word."""
        return replace(self, words=(*self.words[:number], *self.words[number + 1 :]))

    def split(self, number: int, at: float) -> Line:
        """Two words for one, at a time inside it; a sound that lasts across goes to the side that has more of it.

        Raises
        ------
        ParameterError : the time leaves one side without a sound.
        """
        word = self.words[number]
        first = [sound for sound in word.sounds if sound.middle < at]
        second = [sound for sound in word.sounds if sound.middle >= at]
        if not (first and second):
            raise ParameterError("time", f"must be between two sounds of {word.title!r}", round(at, 3))
        letters, other = _letters(word.text, len(first) / len(word.sounds))
        parts = (
            replace(word, text=letters, end=first[-1].end, sounds=tuple(first)),
            replace(word, text=other, start=second[0].start, sounds=tuple(second)),
        )
        return replace(self, words=(*self.words[:number], *parts, *self.words[number + 1 :]))

    def joined(self, number: int) -> Line:
        """One word of a word and the one after it.

        Raises
        ------
        ParameterError : it is the last.
        """
        if number + 1 >= len(self.words):
            raise ParameterError("word", "must have another one after it", self.words[number].title)
        one, other = self.words[number : number + 2]
        text = f"{one.text} {other.text}".strip()
        both = LineWord(text, one.start, other.end, (*_at(one), *_at(other)))
        return replace(self, words=(*self.words[:number], both, *self.words[number + 2 :]))

    def inserted(self, number: int, word: LineWord) -> Line:
        """A word more, that becomes the one of this number; where there is too little room, in what room there is.

        Raises
        ------
        ParameterError : there is no room between its neighbours.
        """
        before = self.words[number - 1].end if number else 0.0
        after = self.words[number].start if number < len(self.words) else float("inf")
        start = max(before, min(word.start, after - (word.end - word.start)))
        end = min(start + word.end - word.start, after)
        if end - start < LEAST:
            neighbours = " and ".join(w.title for w in self.words[max(number - 1, 0) : number + 1])
            raise ParameterError("room", f"must be left between {neighbours}: move one", round(end - start, 3))
        words = (*self.words[:number], word.over(start, end), *self.words[number:])
        return Line(words, max(self.duration, end))


def line_of(utterance: Utterance) -> Line:
    """What is said, word by word; sounds outside all words are parted by pauses."""
    words: list[LineWord] = []
    for text, sounds in _grouped(utterance):
        words.append(LineWord(text, sounds[0].start, sounds[-1].end, tuple(sounds)))
    return Line(tuple(words), utterance.duration)


def word_of(utterance: Utterance, text: str) -> LineWord:
    """All that is said as one word, from 0 s on."""
    first, last = utterance.sounds[0].start, utterance.sounds[-1].end
    return LineWord(text, first, last, utterance.sounds).over(0.0, last - first)


def utterance_of_line(line: Line, assumed: tuple[str, ...] = ()) -> Utterance:
    """A line as it is said."""
    return together([(0.0, 1.0, line)], assumed)


def together(parts: Iterable[tuple[float, float, Line]], assumed: tuple[str, ...] = ()) -> Utterance:
    """Several lines of one mouth as one: one that begins later cuts the one before it off.

    Parameters
    ----------
    parts : when each begins, seconds; how many times longer it lasts; what is said.
    """
    spoken = sorted((part for part in parts if part[2].words), key=lambda part: _first(*part))
    sounds, words, end = list[Sound](), list[SpokenWord](), 0.0
    for number, (start, scale, line) in enumerate(spoken):
        until = _first(*spoken[number + 1]) if number + 1 < len(spoken) else float("inf")
        end = max(end, min(start + scale * line.duration, until))
        for word in line.words:
            times = [(s, start + scale * s.start, min(start + scale * s.end, until)) for s in _at(word)]
            timed = [_timed(sound, first, last) for sound, first, last in times if last - first > 1e-6]
            if timed and word.text:
                words.append(SpokenWord(timed[0].start, timed[-1].end, word.text))
            sounds += timed
    kept = _in_order(sounds)
    return Utterance(tuple(kept), max(end, kept[-1].end if kept else 0.0), tuple(words), assumed)


def interrupted(parts: Sequence[tuple[float, float, Line]]) -> list[int]:
    """Numbers of the lines that are cut off by one that begins later."""
    cut = []
    for number, (start, scale, line) in enumerate(parts):
        if line.words:
            first, last = _first(start, scale, line), start + scale * line.words[-1].end
            begins = [_first(*other) for k, other in enumerate(parts) if k != number and other[2].words]
            if any(first < begin < last - 1e-6 for begin in begins):
                cut.append(number)
    return cut


def _first(start: float, scale: float, line: Line) -> float:
    """When a line's first word begins, seconds."""
    return start + scale * line.words[0].start


def _at(word: LineWord) -> tuple[Sound, ...]:
    """A word's sounds, as distinct as the word is said."""
    if word.strength == 1.0:
        return word.sounds
    return tuple(replace(s, strength=min(s.strength * word.strength, STRONGEST)) for s in word.sounds)


def _timed(sound: Sound, start: float, end: float) -> Sound:
    """A sound at another time; itself where it is there already: an hour has tens of thousands."""
    return sound if (sound.start, sound.end) == (start, end) else replace(sound, start=start, end=end)


def _in_order(sounds: Iterable[Sound]) -> list[Sound]:
    """Sounds none of which begins before the last has ended, be it for rounding."""
    kept: list[Sound] = []
    for sound in sounds:
        start = max(sound.start, kept[-1].end) if kept else max(sound.start, 0.0)
        if sound.end - start > 1e-6:
            kept.append(_timed(sound, start, sound.end))
    return kept


def _grouped(utterance: Utterance) -> Iterable[tuple[str, list[Sound]]]:
    """Each word's letters and sounds."""
    words, place = utterance.words, 0
    group, owner = list[Sound](), -1
    for sound in utterance.sounds:
        while place < len(words) and words[place].end <= sound.middle:
            place += 1
        own = place if place < len(words) and words[place].start <= sound.middle else -1
        if group and (own != owner or (own < 0 and sound.start - group[-1].end >= PAUSE)):
            yield (words[owner].text if owner >= 0 else ""), group
            group = []
        group, owner = [*group, sound], own
    if group:
        yield (words[owner].text if owner >= 0 else ""), group


def _letters(text: str, share: float) -> tuple[str, str]:
    """A text in two: at a blank where there is one near, else by its letters."""
    if " " in text.strip():
        blanks = [k for k, letter in enumerate(text) if letter == " " and text[:k].strip() and text[k:].strip()]
        at = min(blanks, key=lambda k: abs(k - share * len(text)))
        return text[:at].strip(), text[at:].strip()
    at = min(max(round(share * len(text)), 1), max(len(text) - 1, 1))
    return text[:at], text[at:]
