"""Draws the wheel: what stays in a canvas that is kept, what changes anew each time."""

from __future__ import annotations

from functools import lru_cache
from itertools import pairwise
from typing import NamedTuple

from ...mpeg4.emotions.archetypes import BASE_WORDS
from ...mpeg4.emotions.profile import ARCHETYPES, Archetype
from ...mpeg4.emotions.wheel import position, turn
from ..blender_types import Theme
from ..points.canvas import Canvas, Colour, text_width
from .choice import Choice
from .geometry import Wheel
from .places import places, spots
from .view import LARGE_LETTERS, LETTERS, NUMBERS, RIM, labels_of, letters, numbers_of

#: Colours of the archetypes, after Plutchik's wheel.
COLOURS: dict[Archetype, tuple[float, float, float]] = {
    Archetype.JOY: (0.98, 0.78, 0.16),
    Archetype.SADNESS: (0.25, 0.47, 0.90),
    Archetype.ANGER: (0.89, 0.22, 0.20),
    Archetype.FEAR: (0.18, 0.66, 0.36),
    Archetype.DISGUST: (0.62, 0.35, 0.78),
    Archetype.SURPRISE: (0.20, 0.74, 0.86),
}
#: How strong the colours are at the rim, and degrees of one wedge of them.
STRENGTH, WEDGE = 0.5, 3
#: Corners of large circles; pixels at a scale of 1 of dots, of the point in hand and of lines.
CORNERS, DOT, LARGE_DOT, POINT, LINE = 96, 2.2, 4.5, 6.5, 1.0


class Palette(NamedTuple):
    """Colours of the user's theme for menus: their ground, lines on it, their text."""

    back: Colour
    line: Colour
    text: Colour


def palette_of(theme: Theme) -> Palette:
    """The colours of a Blender theme."""
    red, green, blue, opacity = theme.user_interface.wcol_menu_back.inner
    text_red, text_green, text_blue = theme.user_interface.wcol_menu_item.text[:3]
    text = (text_red, text_green, text_blue)
    return Palette((red, green, blue, max(opacity, 0.85)), (*text, 0.22), (*text, 1.0))


def colour_at(angle: float) -> tuple[float, float, float]:
    """The colour of a direction: an archetype's own, between two of them a mixture."""
    below = min(ARCHETYPES, key=lambda name: turn(BASE_WORDS[name].angle, angle))
    above = min(ARCHETYPES, key=lambda name: turn(angle, BASE_WORDS[name].angle))
    share = 0.0 if below is above else position(angle, BASE_WORDS[below].angle, BASE_WORDS[above].angle)
    r, g, b = ((1.0 - share) * x + share * y for x, y in zip(COLOURS[below], COLOURS[above], strict=True))
    return r, g, b


def draw_wheel(wheel: Wheel, choice: Choice, words: tuple[str, str], scale: float, theme: Theme) -> None:
    """Draw it over a viewport, with the point that is chosen and a caption of two lines."""
    colours = palette_of(theme)
    _still(wheel, colours, scale).draw()
    canvas = Canvas()
    _draw_point(canvas, wheel, choice, scale)
    _draw_caption(canvas, wheel, words, colours, scale)
    canvas.draw()


@lru_cache(maxsize=8)
def _still(wheel: Wheel, theme: Palette, scale: float) -> Canvas:
    """Ground, colours, rings, numbers and words."""
    canvas, rim = Canvas(), wheel.radius + RIM * scale
    canvas.ring(wheel.centre, 0.0, rim, theme.back, corners=CORNERS)
    _draw_colours(canvas, wheel)
    half = LINE * scale / 2.0
    for activation in range(1, 8):
        away = wheel.ring(activation)
        canvas.ring(wheel.centre, away - half, away + half, theme.line, corners=CORNERS)
    for activation, box in numbers_of(wheel, scale).items():
        canvas.text((box.left, box.low), str(activation), NUMBERS * scale, (*theme.text[:3], 0.6), shadow=theme.back)
    _draw_words(canvas, wheel, theme, scale)
    return canvas


def _draw_colours(canvas: Canvas, wheel: Wheel) -> None:
    """Wedges of colour, clear at the centre."""
    for first, second in pairwise(range(0, 361, WEDGE)):
        a, b = colour_at(first % 360), colour_at(second % 360)
        middle = (*a, 0.0)
        canvas.blend(
            (
                (wheel.centre, middle),
                (wheel.pixel(first, 7.0), (*a, STRENGTH)),
                (wheel.pixel(second, 7.0), (*b, STRENGTH)),
            )
        )


def _draw_words(canvas: Canvas, wheel: Wheel, theme: Palette, scale: float) -> None:
    """A dot for each word, and the labels that have room."""
    for word, spot in spots(wheel).items():
        if places()[word].is_archetype:
            canvas.ring(spot, 0.0, (LARGE_DOT + 1.0) * scale, theme.back)
            canvas.ring(spot, 0.0, LARGE_DOT * scale, (*COLOURS[Archetype(word)], 1.0))
        else:
            canvas.ring(spot, 0.0, DOT * scale, (*theme.text[:3], 0.85))
    for word, box in labels_of(wheel, scale).items():
        at = (box.left, box.low + 0.2 * box.height)
        canvas.text(at, word.capitalize(), letters(wheel, word, scale), theme.text, shadow=theme.back)


def _draw_point(canvas: Canvas, wheel: Wheel, choice: Choice, scale: float) -> None:
    """The point that is chosen: a disc in the colour of its direction, rimmed so that it shows on any ground."""
    spot, rgb = choice.pixel(wheel), colour_at(choice.degrees())
    colour: Colour = (0.6, 0.6, 0.6, 1.0) if choice.is_centre() else (*rgb, 1.0)
    for radius, shade in ((POINT + 2.0, (0.0, 0.0, 0.0, 0.9)), (POINT, (1.0, 1.0, 1.0, 1.0)), (POINT - 2.0, colour)):
        canvas.ring(spot, 0.0, radius * scale, shade, corners=32)


def _draw_caption(canvas: Canvas, wheel: Wheel, words: tuple[str, str], theme: Palette, scale: float) -> None:
    """Two lines in the middle below the wheel, on a ground of their own."""
    sizes = (LARGE_LETTERS * scale, LETTERS * scale)
    widths = [text_width(line, size) for line, size in zip(words, sizes, strict=True)]
    top, pad = wheel.centre[1] - wheel.radius - (RIM + 4.0) * scale, 6.0 * scale
    half = max(widths) / 2.0 + pad
    canvas.box((wheel.centre[0] - half, top - 36.0 * scale), (wheel.centre[0] + half, top), theme.back)
    for line, size, width, down in zip(words, sizes, widths, (14.0, 29.0), strict=True):
        canvas.text((wheel.centre[0] - width / 2.0, top - down * scale), line, size, theme.text, shadow=theme.back)


def forget_pictures() -> None:
    """Let go of the pictures that are kept."""
    _still.cache_clear()
