"""The colour of an emotion, as the wheel has it: its archetypes' colours, mixed by their shares."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import ExitStack
from functools import lru_cache

import bpy.utils.previews

from ...mpeg4 import ARCHETYPES, Archetype, expression
from ..blender_types import Preview, Previews
from ..emotion.profile import profile_of
from ..emotion.props import RISORIUS_PG_emotion
from ..wheel.picture import COLOURS

#: Of a face that shows nothing.
GREY = (0.55, 0.55, 0.55)
#: Pixels of an icon, and clear ones at its rim.
ICON, RIM = 16, 2

_icons: Previews | None = None


def colour_of(emotion: RISORIUS_PG_emotion) -> tuple[float, float, float]:
    """The colour of a chosen emotion."""
    if emotion.by == "WORD":
        return _colour_of_word(emotion.word)
    return _mixed(profile_of(emotion).weights)


@lru_cache(maxsize=256)
def _colour_of_word(word: str) -> tuple[float, float, float]:
    """The colour of a word."""
    return _mixed(expression(word).weights)


def _mixed(weights: Mapping[Archetype, float]) -> tuple[float, float, float]:
    """Colours by their shares."""
    if not weights:
        return GREY
    r, g, b = (sum(share * COLOURS[name][k] for name, share in weights.items()) for k in range(3))
    return r, g, b


def icon_of(emotion: RISORIUS_PG_emotion) -> int:
    """Number of an icon in the colour of the archetype that comes first in a chosen emotion."""
    global _icons
    if _icons is None:
        _icons = bpy.utils.previews.new()
    weights = profile_of(emotion).weights
    first = max(ARCHETYPES, key=lambda archetype: weights.get(archetype, 0.0)) if weights else None
    name = str(first)
    if name not in _icons:
        _draw_icon(_icons.new(name), GREY if first is None else COLOURS[first])
    return int(_icons[name].icon_id)


def _draw_icon(icon: Preview, colour: tuple[float, float, float]) -> None:
    """A square of one colour."""
    inside = range(RIM, ICON - RIM)
    icon.icon_size = (ICON, ICON)
    icon.icon_pixels_float = [
        value
        for y in range(ICON)
        for x in range(ICON)
        for value in ((*colour, 1.0) if x in inside and y in inside else (0.0, 0.0, 0.0, 0.0))
    ]


def attach(undo: ExitStack) -> None:
    """Icons are drawn when they are first wanted, and kept until undone."""
    undo.callback(_forget_icons)


def _forget_icons() -> None:
    """Take the icons away."""
    global _icons
    if _icons is not None:
        bpy.utils.previews.remove(_icons)
        _icons = None
