"""The few feature points that are clicked, and what has been clicked of them so far."""

from __future__ import annotations

import json

from ...arrays import Floats
from ...errors import SceneError
from ...mpeg4 import FEATURE_POINTS
from ...scene.points.bound import Surface
from ...scene.points.mirrored import MirrorPlane
from ...tables import parsed_json

#: What is asked for, in this order, and where it lies. Left and right are the face's own.
ASKED = {
    "3.7": "outer corner of its left eye",
    "3.12": "outer corner of its right eye",
    "8.3": "left corner of its mouth",
    "8.4": "right corner of its mouth",
    "9.3": "tip of the nose",
    "2.1": "underside of the chin, in the middle",
}


class Clicks:
    """Points that have been clicked so far: name -> (3,) in the mesh's own coordinates, and how to go back.

    `hover` is the pixel of the mouse, None outside of the viewport.
    """

    def __init__(self, surface: Surface, plane: MirrorPlane | None) -> None:
        self.surface, self._plane = surface, plane
        self.hover: tuple[float, float] | None = None
        self._steps: list[dict[str, Floats]] = []

    @property
    def has_mirror(self) -> bool:
        """Whether the mesh is the same on both sides."""
        return self._plane is not None

    @property
    def places(self) -> dict[str, Floats]:
        """All that are there."""
        return {name: place for step in self._steps for name, place in step.items()}

    @property
    def wanted(self) -> str | None:
        """The point to be clicked next; None when all are there."""
        return next((name for name in ASKED if name not in self.places), None)

    def add(self, place: Floats, *, mirror: bool) -> None:
        """Take a click for the wanted point; with `mirror` its counterpart is set too where the mesh allows."""
        name = self.wanted
        if name is None:
            return
        step = {name: place}
        other = FEATURE_POINTS[name].mirror
        if mirror and self._plane is not None and other in ASKED and other not in self.places:
            near = self.surface.nearest(self._plane.reflected(place))
            if near is not None:
                step[other] = near[0]
        self._steps.append(step)

    def to_json(self) -> str:
        """All that are there as a script gives them; `clicks_of` reads that."""
        return json.dumps({name: place.tolist() for name, place in self.places.items()})

    def back(self) -> bool:
        """Take the last click back, its counterpart with it."""
        return bool(self._steps) and self._steps.pop() is not None


def clicks_of(text: str) -> dict[str, Floats]:
    """Clicks of a script.

    Raises
    ------
    SceneError : none, or no such table.
    ParameterError : a place that is not three finite numbers.
    """
    from ...face.fit.clicks import click_place

    remedy = 'give them as JSON, {"3.7": [x, y, z], ...}, or use a window to click them'
    if not text.strip():
        raise SceneError("Clicks", f"are missing: {remedy}")
    try:
        table = parsed_json(text)
    except ValueError as problem:
        raise SceneError("Clicks", f"are not JSON ({problem}): {remedy}") from problem
    if not isinstance(table, dict) or not table:
        raise SceneError("Clicks", f"contain no points: {remedy}")
    return {name: click_place(name, place) for name, place in table.items()}
