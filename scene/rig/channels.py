"""One number of a character that can be keyed: a shape key's value, a bone's location along an axis, a property."""

from __future__ import annotations

import json
from dataclasses import dataclass

from ..blender_types import Datablock


@dataclass(frozen=True)
class Place:
    """Where a number is: `path` from the datablock that is keyed, and `index` in it, or -1 for a plain number."""

    owner: Datablock
    path: str
    index: int = -1

    def set(self, value: float) -> None:
        """Give it a value; a place that is gone is passed over."""
        whole, name = _parted(self.path)
        try:
            holder = self.owner.path_resolve(whole) if whole else self.owner
            if self.index >= 0:
                getattr(holder, name)[self.index] = value
            elif name.startswith("["):
                holder[json.loads(name[1:-1])] = value
            else:
                setattr(holder, name, value)
        except (ValueError, KeyError, AttributeError, IndexError):
            return
        self.owner.update_tag()


def _parted(path: str) -> tuple[str, str]:
    """A path as that of what holds the number, and the number's own name there: an attribute, or ["a property"]."""
    if path.endswith('"]'):
        start = path.rindex('["')
        return path[:start], path[start:]
    whole, _, name = path.rpartition(".")
    return whole, name


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
