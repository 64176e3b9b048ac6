"""What is said and when: sounds and words in time."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from ..arrays import Floats
from ..errors import ParameterError
from .phonemes import Phoneme

#: How distinctly a sound may be said at most: twice.
STRONGEST = 2.0


@dataclass(frozen=True)
class Sound:
    """A speech sound in time.

    Attributes
    ----------
    start, end : seconds from the beginning.
    phoneme : what is said. symbol : how the source writes it.
    stress : 1 for the main stress of a word, 0.5 for a secondary one, else 0.
    strength : how far the mouth goes for it, 0 (it stays at rest) to 2.
    """

    start: float
    end: float
    phoneme: Phoneme
    symbol: str = ""
    stress: float = 0.0
    strength: float = 1.0

    @property
    def middle(self) -> float:
        """Seconds from the beginning."""
        return (self.start + self.end) / 2.0

    @property
    def duration(self) -> float:
        """Seconds."""
        return self.end - self.start


@dataclass(frozen=True)
class SpokenWord:
    """A word in time: seconds from the beginning, and its letters."""

    start: float
    end: float
    text: str


@dataclass(frozen=True, eq=False)
class Mouth:
    """A mouth's motion as it was recorded: (T, 68) FAPs at a rate, those of mouth, jaw and tongue, none silent."""

    frames: Floats
    fps: float

    def at(self, times: Floats) -> Floats:
        """(n, 68) the same at some times, seconds; the first and last one stay."""
        own = np.arange(len(self.frames)) / self.fps
        return np.array([np.interp(times, own, column) for column in self.frames.T]).T


@dataclass(frozen=True)
class Utterance:
    """What is said and when; between sounds the mouth rests.

    Attributes
    ----------
    sounds : in order, none before the one before it has ended.
    duration : seconds, at least to the end of the last sound.
    words : in order, where the source names them.
    assumed : what the source did not say and was assumed to read it, or is shown otherwise than it was written, in
        words for people.
    mouth : the mouth's own motion, where it was recorded; sounds then tell when lips part and close.

    Raises
    ------
    ParameterError
        When sounds overlap or run backwards, a time is no number, or a strength is outside its range.
    """

    sounds: tuple[Sound, ...]
    duration: float
    words: tuple[SpokenWord, ...] = ()
    assumed: tuple[str, ...] = field(default=(), compare=False)
    mouth: Mouth | None = field(default=None, repr=False)

    def __post_init__(self) -> None:
        """Check the order of times."""
        last = 0.0
        for sound in self.sounds:
            if not (math.isfinite(sound.start) and math.isfinite(sound.end) and last <= sound.start < sound.end):
                rule = f"must end after they start, and start after the sound before them has ended ({last:g} s)"
                raise ParameterError("sounds", rule, (sound.symbol, sound.start, sound.end))
            if not 0.0 <= sound.strength <= STRONGEST:
                raise ParameterError("strength", f"must be from 0 to {STRONGEST:g}", (sound.symbol, sound.strength))
            last = sound.end
        if not (math.isfinite(self.duration) and self.duration >= last):
            raise ParameterError("duration", f"must be a number of seconds, at least {last:g}", self.duration)
