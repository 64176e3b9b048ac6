"""The emotion wheel in pixels: activation as radius, the wheel's angle as direction. Knows nothing of Blender.

Pixels count from a region's lower left corner, x to the right and y up; angles run counter-clockwise from the right, in
degrees, as on the wheel of the paper.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from enum import StrEnum
from typing import TypeAlias

from ...mpeg4.emotions.wheel import ACTIVATION_MAX, ACTIVATION_MIN, check_angle

Pixel: TypeAlias = tuple[float, float]

#: Share of a viewport's shorter side that a wheel may take, and the radius in pixels below which it cannot be read.
LARGEST_SHARE, SMALLEST_RADIUS = 0.6, 40.0


class Corner(StrEnum):
    """Where in the viewport the wheel is."""

    BOTTOM_RIGHT = "BOTTOM_RIGHT"
    BOTTOM_LEFT = "BOTTOM_LEFT"
    TOP_RIGHT = "TOP_RIGHT"
    TOP_LEFT = "TOP_LEFT"


@dataclass(frozen=True)
class Box:
    """A rectangle of pixels."""

    left: float
    low: float
    right: float
    high: float

    @property
    def width(self) -> float:
        """Pixels from left to right; negative where nothing is left of it."""
        return self.right - self.left

    @property
    def height(self) -> float:
        """Pixels from low to high; negative where nothing is left of it."""
        return self.high - self.low

    def overlaps(self, other: Box) -> bool:
        """Whether the two share any pixel."""
        return self.left < other.right and other.left < self.right and self.low < other.high and other.low < self.high

    def contains(self, pixel: Pixel) -> bool:
        """Whether a pixel is in it."""
        return self.left <= pixel[0] <= self.right and self.low <= pixel[1] <= self.high

    def without(self, other: Box) -> Box:
        """What is left beside a region that covers one of its sides over the whole length, as a sidebar does."""
        if not self.overlaps(other):
            return self
        rests = (
            Box(other.right, self.low, self.right, self.high),
            Box(self.left, self.low, other.left, self.high),
            Box(self.left, other.high, self.right, self.high),
            Box(self.left, self.low, self.right, other.low),
        )
        return max(rests, key=lambda rest: max(rest.width, 0.0) * max(rest.height, 0.0))


@dataclass(frozen=True)
class Wheel:
    """A wheel on the screen.

    Attributes
    ----------
    centre : pixel of its centre. radius : pixels from there to the highest activation.
    """

    centre: Pixel
    radius: float

    def ring(self, activation: float) -> float:
        """Pixels from the centre to an activation."""
        return self.radius * activation / ACTIVATION_MAX

    def pixel(self, angle: float, activation: float) -> Pixel:
        """Where a point of the wheel is; angle in degrees."""
        direction, away = math.radians(angle), self.ring(activation)
        return self.centre[0] + away * math.cos(direction), self.centre[1] + away * math.sin(direction)

    def point(self, pixel: Pixel) -> tuple[float, float]:
        """Angle in degrees and activation nearest to a pixel, inside of the wheel or not."""
        x, y = pixel[0] - self.centre[0], pixel[1] - self.centre[1]
        activation = math.hypot(x, y) / self.radius * ACTIVATION_MAX
        return check_angle(math.degrees(math.atan2(y, x))), min(max(activation, ACTIVATION_MIN), ACTIVATION_MAX)

    def contains(self, pixel: Pixel, margin: float = 0.0) -> bool:
        """Whether a pixel is in the disc, or off it by no more than a margin."""
        return math.dist(pixel, self.centre) <= self.radius + margin


def free_box(width: float, height: float, covers: Iterable[Box]) -> Box:
    """What is to be seen of a region that others lie over: sidebar, toolbar, headers."""
    free = Box(0.0, 0.0, width, height)
    for cover in covers:
        free = free.without(cover)
    return free


def placed(free: Box, corner: Corner, *, radius: float, margin: float, foot: float) -> Wheel | None:
    """The wheel in a corner; smaller where there is little room, None where it could not be read.

    Parameters
    ----------
    free : where there is room. radius : pixels wished for. margin : pixels around it.
    foot : pixels below it, for a caption.
    """
    fits = min((free.width - 2.0 * margin) / 2.0, (free.height - 2.0 * margin - foot) / 2.0)
    shown = min(radius, fits, LARGEST_SHARE * min(free.width, free.height) / 2.0)
    if shown < min(radius, SMALLEST_RADIUS):
        return None
    at_left = corner in {Corner.BOTTOM_LEFT, Corner.TOP_LEFT}
    at_foot = corner in {Corner.BOTTOM_LEFT, Corner.BOTTOM_RIGHT}
    x = free.left + margin + shown if at_left else free.right - margin - shown
    y = free.low + margin + foot + shown if at_foot else free.high - margin - shown
    return Wheel((x, y), shown)


def under(free: Box, pixel: Pixel, angle: float, away: float, *, radius: float, margin: float) -> Wheel:
    """The wheel that has a point of it under a pixel; moved where it would leave what is to be seen.

    Parameters
    ----------
    free : where there is room. angle, away : the point, degrees and activation; 0 is the centre.
    radius : pixels. margin : pixels around it.
    """
    x, y = Wheel((0.0, 0.0), radius).pixel(angle, away)
    keep = radius + margin
    spans = ((pixel[0] - x, free.left, free.right), (pixel[1] - y, free.low, free.high))
    centre = [min(max(wish, low + keep), max(high - keep, low + keep)) for wish, low, high in spans]
    return Wheel((centre[0], centre[1]), radius)
