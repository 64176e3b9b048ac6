"""What is chosen on the wheel: reading it off the emotion of a face, writing it there, and putting it back."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..emotion.props import DEFAULT_VARIANT, RISORIUS_PG_emotion, own_activation
from .geometry import Pixel, Wheel
from .places import CENTRE, nearest_word

#: Pixels at a scale of 1 within which a word draws the point to itself.
REACH = 6.0
#: Share of the pointer's way that the point goes while Shift is held.
FINE = 0.1


@dataclass(frozen=True)
class Choice:
    """The emotion of a face as the wheel may change it; the names are those of its properties."""

    by: str
    word: str
    variant: str
    angle: float
    activation: float

    @classmethod
    def of(cls, emotion: RISORIUS_PG_emotion) -> Choice:
        """What is chosen now."""
        return cls(emotion.by, emotion.word, emotion.variant, emotion.angle, emotion.activation)

    def write(self, emotion: RISORIUS_PG_emotion) -> None:
        """Choose it; nothing is told to anyone where it is chosen already."""
        for name in ("word", "variant", "angle", "activation", "by"):  # a new word sets all that follows
            if getattr(emotion, name) != getattr(self, name):
                setattr(emotion, name, getattr(self, name))

    def degrees(self) -> float:
        """Direction on the wheel, degrees."""
        return math.degrees(self.angle) % 360.0

    def is_centre(self) -> bool:
        """Whether it is the face at rest."""
        return self.by == "WORD" and self.word == CENTRE

    def pixel(self, wheel: Wheel) -> Pixel:
        """Where its point is drawn."""
        return wheel.centre if self.is_centre() else wheel.pixel(self.degrees(), self.activation)


@dataclass(frozen=True)
class Hand:
    """The point that is being dragged, and the pointer that drags it: pixels."""

    at: Pixel
    pointer: Pixel

    def moved(self, pointer: Pixel, *, fine: bool) -> Hand:
        """After the pointer went elsewhere."""
        share = FINE if fine else 1.0
        x, y = (self.at[k] + share * (pointer[k] - self.pointer[k]) for k in (0, 1))
        return Hand((x, y), pointer)


def choose_word(emotion: RISORIUS_PG_emotion, word: str) -> None:
    """Choose a word with its own activation; what is chosen already stays as it is, variant and all."""
    now = Choice.of(emotion)
    if (now.by, now.word) != ("WORD", word) or abs(now.activation - own_activation(word)) > 1e-4:
        emotion.word = word


def choose_point(emotion: RISORIUS_PG_emotion, angle: float, activation: float) -> None:
    """Choose a point of the wheel; angle in degrees."""
    now = Choice.of(emotion)
    Choice("WHEEL", now.word, DEFAULT_VARIANT, math.radians(angle), activation).write(emotion)


def choose_pixel(emotion: RISORIUS_PG_emotion, wheel: Wheel, pixel: Pixel, *, reach: float) -> None:
    """Choose what is under a pixel: the word within `reach` pixels, else the point of the wheel."""
    word = nearest_word(wheel, pixel, reach) if reach > 0.0 else None
    if word is not None:
        choose_word(emotion, word)
    else:
        choose_point(emotion, *wheel.point(pixel))


def turn(emotion: RISORIUS_PG_emotion, degrees: float) -> None:
    """Turn the point around the centre."""
    now = Choice.of(emotion)
    choose_point(emotion, (now.degrees() + degrees) % 360.0, now.activation)


def strengthen(emotion: RISORIUS_PG_emotion, by: float) -> None:
    """Move the point outwards; a word stays the word."""
    emotion.activation = min(max(emotion.activation + by, 1.0), 7.0)
