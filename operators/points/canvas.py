"""Flat shapes and text over a viewport, drawn in one go."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise
from math import cos, hypot, pi, sin
from typing import TypeAlias

import blf
import gpu
from gpu_extras.batch import batch_for_shader

from ..blender_types import Batch, Shader

Pixel: TypeAlias = tuple[float, float]
Colour: TypeAlias = tuple[float, float, float, float]

#: Corners of a disc, and pixels over which a soft edge fades.
ROUND, FADE = 18, 1.0
#: Of text, unless told otherwise.
SHADOW: Colour = (0.0, 0.0, 0.0, 0.8)


class Canvas:
    """Gathers triangles in pixels of a region; `draw` shows them, text on top, as often as wanted."""

    def __init__(self) -> None:
        self._corners: list[tuple[float, float, float]] = []
        self._colours: list[Colour] = []
        self._texts: list[tuple[Pixel, str, float, Colour, Colour]] = []
        self._batch: Batch | None = None

    def _triangle(self, corners: Iterable[Pixel], colour: Colour) -> None:
        """One triangle."""
        for x, y in corners:
            self._corners.append((x, y, 0.0))
            self._colours.append(colour)

    def disc(self, centre: Pixel, radius: float, colour: Colour) -> None:
        """A filled disc."""
        rim = [
            (centre[0] + radius * cos(2 * pi * k / ROUND), centre[1] + radius * sin(2 * pi * k / ROUND))
            for k in range(ROUND + 1)
        ]
        for first, second in pairwise(rim):
            self._triangle((centre, first, second), colour)

    def blend(self, corners: Iterable[tuple[Pixel, Colour]]) -> None:
        """One triangle whose colours run into one another."""
        for (x, y), colour in corners:
            self._corners.append((x, y, 0.0))
            self._colours.append(colour)

    def ring(self, centre: Pixel, inner: float, outer: float, colour: Colour, *, corners: int = ROUND) -> None:
        """A ring with soft edges; a disc with one where the inner radius is 0."""
        clear = (*colour[:3], 0.0)
        steps = [(max(inner - FADE, 0.0), clear), (inner, colour), (outer, colour), (outer + FADE, clear)]
        turns = [(cos(2 * pi * k / corners), sin(2 * pi * k / corners)) for k in range(corners + 1)]
        for (near, first), (far, second) in pairwise(steps if inner > 0.0 else steps[1:]):
            for (ax, ay), (bx, by) in pairwise(turns):
                a, b = (centre[0] + near * ax, centre[1] + near * ay), (centre[0] + near * bx, centre[1] + near * by)
                c, d = (centre[0] + far * bx, centre[1] + far * by), (centre[0] + far * ax, centre[1] + far * ay)
                self.blend(((a, first), (c, second), (d, second)))
                if near > 0.0:
                    self.blend(((a, first), (b, first), (c, second)))

    def box(self, low: Pixel, high: Pixel, colour: Colour) -> None:
        """A filled rectangle."""
        corners = [low, (high[0], low[1]), high, (low[0], high[1])]
        self._triangle(corners[:3], colour)
        self._triangle((corners[0], corners[2], corners[3]), colour)

    def line(self, path: Sequence[Pixel], width: float, colour: Colour) -> None:
        """A line through pixels."""
        for (ax, ay), (bx, by) in pairwise(path):
            length = hypot(bx - ax, by - ay)
            if length > 0.0:
                x, y = -(by - ay) / length * width / 2.0, (bx - ax) / length * width / 2.0
                corners = [(ax + x, ay + y), (bx + x, by + y), (bx - x, by - y), (ax - x, ay - y)]
                self._triangle(corners[:3], colour)
                self._triangle((corners[0], corners[2], corners[3]), colour)

    def text(self, at: Pixel, words: str, size: float, colour: Colour, *, shadow: Colour = SHADOW) -> None:
        """One line of text; `at` is its lower left corner. The shadow lets it be read over whatever lies below."""
        self._texts.append((at, words, size, colour, shadow))

    def draw(self) -> None:
        """Show everything gathered."""
        if self._corners:
            shader: Shader = gpu.shader.from_builtin("SMOOTH_COLOR")
            if self._batch is None:
                self._batch = batch_for_shader(shader, "TRIS", {"pos": self._corners, "color": self._colours})
            gpu.state.blend_set("ALPHA")
            self._batch.draw(shader)
            gpu.state.blend_set("NONE")
        for (x, y), words, size, colour, shadow in self._texts:
            blf.size(0, size)
            blf.color(0, *colour)
            blf.enable(0, blf.SHADOW)
            blf.shadow(0, 3, *shadow)
            blf.position(0, x, y, 0.0)
            blf.draw(0, words)
            blf.disable(0, blf.SHADOW)


def text_width(words: str, size: float) -> float:
    """Pixels that a line of text takes."""
    blf.size(0, size)
    return float(blf.dimensions(0, words)[0])
