"""What is written below the wheel: what is chosen, or what lies under the pointer."""

from __future__ import annotations

from ..emotion.props import RISORIUS_PG_emotion
from .choice import Choice
from .geometry import Pixel, Wheel
from .places import CENTRE, between, nearest_word, places


def caption(choice: Choice) -> tuple[str, str]:
    """Two lines on what is chosen."""
    if choice.is_centre():
        return _rest()
    title = choice.word if choice.by == "WORD" else between(choice.degrees())
    return _sentence(title), _figures(choice.degrees(), choice.activation)


def caption_at(wheel: Wheel, pixel: Pixel, reach: float, label: str | None) -> tuple[str, str]:
    """Two lines on what would be chosen by a click at a pixel.

    Parameters
    ----------
    wheel : on the screen. pixel : under the pointer. reach : pixels within which a word is meant.
    label : the word whose label is there.
    """
    word = label if label is not None else nearest_word(wheel, pixel, reach)
    if word == CENTRE:
        return _rest()
    if word is not None:
        return _sentence(word), _figures(places()[word].angle, places()[word].activation)
    angle, activation = wheel.point(pixel)
    return _sentence(between(angle)), _figures(angle, activation)


def title_of(emotion: RISORIUS_PG_emotion) -> str:
    """What is chosen, in one line."""
    return "   ".join(caption(Choice.of(emotion)))


def _rest() -> tuple[str, str]:
    """At the centre."""
    return "Neutral", "The neutral face"


def _figures(angle: float, activation: float) -> str:
    """Both figures of a point."""
    return f"Activation {activation:.1f} of 7, direction {angle:.0f}°"


def _sentence(words: str) -> str:
    """With a capital letter."""
    return words[:1].upper() + words[1:]
