"""One number of a character that can be keyed: a shape key's value, a bone's location along an axis, a property."""

from __future__ import annotations

from dataclasses import dataclass

from ..blender_types import Datablock


@dataclass(frozen=True)
class Place:
    """Where a number is: `path` from the datablock that is keyed, and `index` in it, or -1 for a plain number."""

    owner: Datablock
    path: str
    index: int = -1


@dataclass(frozen=True)
class Channel:
    """A number that can be keyed.

    Attributes
    ----------
    name : as users know it: that of the shape key, or of the bone and what of it moves.
    place : where it is.
    low, high : its limits. resting : its value at rest, from low to high.
    twins : other places that always get the same value: the key of this name on another object of the face.
    """

    name: str
    place: Place
    low: float
    high: float
    resting: float = 0.0
    twins: tuple[Place, ...] = ()

    @property
    def places(self) -> tuple[Place, ...]:
        """All places that get its value."""
        return (self.place, *self.twins)
