"""Beliefs over time as a picture: a curve per emotion, and below them a band of the emotion that is most believed."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import bpy
import numpy as np

from ...arrays import Floats
from ...files import scratch_folder
from ..attributes import write_pixels
from ..blender_types import Image, Items, Object
from ..live.reading import RESTING
from .lettering import Text, write_text

if TYPE_CHECKING:
    from ...api import BeliefTrack

#: The object's custom property that holds its plot.
PLOT = "risorius_plot"
#: Pixels: the picture, the field of the curves within it (left, top, right, bottom), the band below.
WIDTH, HEIGHT = 1280, 640
LEFT, TOP, RIGHT, BOTTOM = 80, 84, 1090, 520
BAND_TOP, BAND_BOTTOM = 556, 578
TITLE, LETTER, LINE = 26.0, 18.0, 1.6
#: Grey levels: ground, field, lines of the grid, letters, the curve of the neutral face.
GROUND, FIELD, GRID, INK, REST = 0.11, 0.15, 0.27, 0.88, 0.6
#: Steps between lines of the grid: frames, and the highest belief.
FRAME_STEPS = (1, 2, 5, 10, 20, 25, 50, 100, 200, 250, 500, 1000, 2000, 5000, 10000)
HEIGHTS = (0.1, 0.2, 0.4, 0.6, 0.8, 1.0)

Colour = tuple[float, float, float]


def draw_plot(track: BeliefTrack, title: str, colours: Mapping[str, Colour]) -> Floats:
    """(640, 1280, 3) the plot, 0..1, first row at the top.

    Parameters
    ----------
    colours : emotion -> its colour, 0..1.
    """
    from ... import api

    top = next((height for height in HEIGHTS if height >= track.beliefs.max(initial=0.0)), 1.0)
    picture = np.full((HEIGHT, WIDTH, 3), GROUND)
    picture[TOP:BOTTOM, LEFT:RIGHT] = FIELD
    for share in range(5):
        row = round(BOTTOM + share * (TOP - BOTTOM) / 4)
        picture[row : row + 1, LEFT:RIGHT] = GRID
    for number in _frames(track):
        column = round(_column(track, number))
        picture[TOP:BOTTOM, column : column + 1] = GRID
    if track.neutral is not None:
        _draw_curve(picture, np.clip(np.nan_to_num(track.neutral) / top, 0.0, 1.0), (REST, REST, REST))
        _draw_key(picture, len(api.ARCHETYPES), (REST, REST, REST))
    for values, name in zip(track.beliefs.T, api.ARCHETYPES, strict=True):
        _draw_curve(picture, values / top, colours[name])
    _draw_band(picture, track, colours)
    for index, name in enumerate(api.ARCHETYPES):
        _draw_key(picture, index, colours[name])
    with scratch_folder() as folder:
        ink = 1.0 - write_text(_texts(track, title, top), WIDTH, HEIGHT, folder)
    drawn: Floats = np.clip(picture * (1.0 - ink) + INK * ink, 0.0, 1.0)
    return drawn


def _frames(track: BeliefTrack) -> list[int]:
    """Round frame numbers for at most ten lines of the grid."""
    first, last = int(track.numbers[0]), int(track.numbers[-1])
    step = next((step for step in FRAME_STEPS if (last - first) / step <= 10), FRAME_STEPS[-1])
    return list(range(-(-first // step) * step, last + 1, step))


def _column(track: BeliefTrack, number: float) -> float:
    """The pixel column of a frame."""
    span = max(1.0, float(track.numbers[-1] - track.numbers[0]))
    return LEFT + (number - float(track.numbers[0])) / span * (RIGHT - 1 - LEFT)


def _draw_curve(picture: Floats, values: Floats, colour: Colour) -> None:
    """A line of three pixels through values (T,), 0..1, over the field."""
    columns = np.arange(LEFT, RIGHT)
    stops = np.linspace(LEFT, RIGHT - 1, len(values)) if len(values) > 1 else np.array([LEFT])
    rows = BOTTOM - np.interp(columns, stops, values) * (BOTTOM - TOP)
    slope = np.abs(np.gradient(rows))
    across = 1.5 * np.hypot(1.0, slope)
    distance = np.abs(np.arange(TOP - 3, BOTTOM + 3)[:, None] - rows)
    cover = np.clip(across + 0.5 - distance, 0.0, 1.0)[:, :, None]
    field = picture[TOP - 3 : BOTTOM + 3, LEFT:RIGHT]
    field += cover * (np.array(colour) - field)


def _draw_key(picture: Floats, index: int, colour: Colour) -> None:
    """A piece of a curve beside its name."""
    row = round(TOP + 10 + 2 * LETTER * index)
    picture[row - 2 : row + 3, RIGHT + 22 : RIGHT + 50] = colour


def _draw_band(picture: Floats, track: BeliefTrack, colours: Mapping[str, Colour]) -> None:
    """For each frame the colour of the most believed emotion, the fuller the more it is shown; grey at rest."""
    nearest = np.linspace(0, len(track.frames) - 1, RIGHT - LEFT).round().astype(int)
    shades = np.full((len(track.frames), 3), FIELD)
    for index, name in enumerate(track.best):
        share = min(1.0, float(track.strengths[index]))
        if name is not None and name in colours and share >= RESTING:
            shades[index] += share * (np.array(colours[name]) - shades[index])
    picture[BAND_TOP:BAND_BOTTOM, LEFT:RIGHT] = shades[nearest]


def _texts(track: BeliefTrack, title: str, top: float) -> list[Text]:
    """Title, numbers at both axes, names of the emotions."""
    from ... import api

    texts = [Text((title,), LEFT, 48, TITLE)]
    for share in range(5):
        row = BOTTOM + share * (TOP - BOTTOM) / 4 + 0.35 * LETTER
        texts.append(Text((f"{share * top / 4:.3g}",), LEFT - 10, row, LETTER, right=True))
    for number in _frames(track):
        texts.append(Text((str(number),), _column(track, number) - 8, BOTTOM + 1.4 * LETTER, LETTER))
    names = [*api.ARCHETYPES, *([api.NEUTRAL] if track.neutral is not None else [])]
    for index, name in enumerate(names):
        texts.append(Text((name.capitalize(),), RIGHT + 60, TOP + 10 + 2 * LETTER * index + 0.35 * LETTER, LETTER))
    texts.append(Text(("most believed",), RIGHT + 22, BAND_BOTTOM - 5, LETTER))
    texts.append(
        Text(
            ("Frames. The band is grey where the face is at rest, and more saturated the stronger the expression.",),
            LEFT,
            BAND_BOTTOM + 1.9 * LETTER,
            LETTER,
        )
    )
    return texts


def keep_plot(obj: Object, pixels: Floats) -> Image:
    """Keep a plot (h, w, 3) in the file as the image of `obj`, in place of the one that it had."""
    height, width, _ = pixels.shape
    image: Image | None = plot_of(obj)
    if image is None or _is_shared(image):
        image = bpy.data.images.new(f"{obj.name} Beliefs", width, height, alpha=False)
        obj[PLOT] = image
    if tuple(image.size) != (width, height):
        image.scale(width, height)
    write_pixels(image, pixels)
    image.update()
    image.pack()
    image.use_fake_user = True
    return image


def plot_of(obj: Object) -> Image | None:
    """The image that `keep_plot` has kept for `obj`, whatever it is called now. Copies of an object share it."""
    image = obj.get(PLOT)
    if not isinstance(image, bpy.types.Image):
        return None
    plot: Image = image
    return plot


def remove_plot(obj: Object) -> None:
    """Remove the image of `obj`, unless another object has it, too."""
    image = plot_of(obj)
    if image is not None and not _is_shared(image):
        bpy.data.images.remove(image)
    if PLOT in obj:
        del obj[PLOT]


def _is_shared(image: Image) -> bool:
    """Whether more than one object has it."""
    objects: Items[Object] = bpy.data.objects
    return sum(obj.get(PLOT) == image for obj in objects) > 1
