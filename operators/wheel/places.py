"""Where on the wheel the words are, what lies under a pixel, and which labels have room. Knows nothing of Blender."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import dataclass
from functools import cache

from ...mpeg4.emotions.archetypes import BASE_WORDS
from ...mpeg4.emotions.emotion_presets import WORDS
from ...mpeg4.emotions.expressions import neighbours
from ...mpeg4.emotions.profile import ARCHETYPES
from .geometry import Box, Pixel, Wheel

#: The word at the wheel's centre: no activation, no direction.
CENTRE = "neutral"


@dataclass(frozen=True)
class Place:
    """A word's place on the wheel.

    Attributes
    ----------
    word : its name. angle : degrees. activation : 1..7, or 0 at the centre. is_archetype : one of the six.
    """

    word: str
    angle: float
    activation: float
    is_archetype: bool


@cache
def places() -> Mapping[str, Place]:
    """Every word that has a place of its own, the six archetypes first, then the stronger words before the weaker.

    A word without a direction has that of its category. Of words at one place (joy, joyful) the archetype is
    shown, else the first; a neutral word is at the centre.
    """
    found: dict[str, Place] = {}
    taken: set[tuple[float, float]] = set()
    archetypes = {str(name) for name in ARCHETYPES}
    order = sorted(WORDS.values(), key=lambda word: (word.name not in archetypes, -(word.activation or 0.0)))
    for entry in order:
        if entry.neutral:
            at = (0.0, 0.0)
        else:
            base = BASE_WORDS[entry.category].angle if entry.category is not None else None
            at = (float(entry.angle if entry.angle is not None else base or 0.0), float(entry.activation or 0.0))
        if at in taken or (entry.neutral and entry.name != CENTRE):
            continue
        taken.add(at)
        found[entry.name] = Place(entry.name, *at, entry.name in archetypes)
    return found


def spots(wheel: Wheel) -> dict[str, Pixel]:
    """Word -> pixel of its place."""
    return {name: wheel.pixel(place.angle, place.activation) for name, place in places().items()}


def nearest_word(wheel: Wheel, pixel: Pixel, reach: float) -> str | None:
    """The word nearest to a pixel, none farther than `reach` pixels; the centre's reaches up to the first ring."""
    away = {name: math.dist(pixel, spot) for name, spot in spots(wheel).items()}
    name = min(away, key=away.__getitem__)
    if away[name] <= reach:
        return name
    return CENTRE if CENTRE in away and away[CENTRE] < 0.8 * wheel.ring(1.0) else None


def between(angle: float) -> str:
    """The archetypes on both sides of an angle, in words; its own within the table's tenth of a degree."""
    below, above = neighbours(round(angle, 1))
    return str(below) if below is above else f"between {below} and {above}"


def labels(
    wheel: Wheel,
    *,
    size: Callable[[str], tuple[float, float]],
    gap: float,
    rim: float = 0.0,
    always: Collection[str] = (),
    avoid: Iterable[Box] = (),
) -> dict[str, Box]:
    """Word -> where its label is written: the archetypes first, then as many as have room.

    Labels do not cover one another, cover no word's place and stay inside the wheel.

    Parameters
    ----------
    wheel : on the screen. size : of a label, width and height in pixels. gap : pixels between a place and its label.
    rim : pixels beyond the outermost ring that labels may use. avoid : what else labels do not cover.
    always : words that may cover places and leave the wheel rather than not be written.
    """
    where = spots(wheel)
    dots = {name: Box(x - gap / 2, y - gap / 2, x + gap / 2, y + gap / 2) for name, (x, y) in where.items()}
    others, written = list(avoid), dict[str, Box]()
    for name in sorted(where, key=lambda word: (word not in always, not places()[word].is_archetype)):
        taken = [*others, *(dot for word, dot in dots.items() if word != name)]
        apart = [box for box in _beside(where[name], *size(name), gap) if not _covers(box, written.values())]
        free = [box for box in apart if _is_inside(wheel, box, rim) and not _covers(box, taken)]
        if free or (apart and name in always):
            written[name] = (free or apart)[0]
    return written


def _beside(spot: Pixel, width: float, height: float, gap: float) -> list[Box]:
    """Boxes for a label around its place, the best first: above and below, then to the sides."""
    x, y = spot
    corners = [(x - width / 2, y + gap), (x - width / 2, y - gap - height)]
    corners += [(x + gap, y - height / 2), (x - gap - width, y - height / 2)]
    corners += [(x + gap / 2, y + gap / 2), (x - width - gap / 2, y + gap / 2)]
    corners += [(x + gap / 2, y - height - gap / 2), (x - width - gap / 2, y - height - gap / 2)]
    return [Box(left, low, left + width, low + height) for left, low in corners]


def _covers(box: Box, others: Iterable[Box]) -> bool:
    """Whether it covers any of the others."""
    return any(box.overlaps(other) for other in others)


def _is_inside(wheel: Wheel, box: Box, rim: float) -> bool:
    """Whether the whole box is in the disc and its rim."""
    corners = ((x, y) for x in (box.left, box.right) for y in (box.low, box.high))
    return all(wheel.contains(corner, rim) for corner in corners)
