"""One number of a character that can be keyed: a shape key's value, a bone's location along an axis, a property."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from enum import Enum

import bpy

from ...errors import SceneError
from ..blender_types import Datablock, Object, WithProperties


@contextmanager
def refusing_what_is_gone(face: Object, control: str) -> Iterator[None]:
    """Refuse a control of a face that others have renamed or removed since it was found.

    Raises
    ------
    SceneError : names both.
    """
    try:
        yield
    except (ValueError, KeyError, IndexError, AttributeError) as gone:
        problem = f"its control {control} was renamed or removed meanwhile: do it again; nothing has been written"
        raise SceneError(face.name, problem) from gone


class Form(Enum):
    """How a channel's value is kept: as it is, or as a part of a turn, in radians about one of a bone's three axes."""

    PLAIN = "plain"
    QUATERNION = "rotation_quaternion"
    AXIS_ANGLE = "rotation_axis_angle"


@dataclass(frozen=True)
class Place:
    """Where a number is: `path` from the datablock that is keyed, and `index` in it, or -1 for a plain number."""

    owner: Datablock
    path: str
    index: int = -1

    @property
    def is_property(self) -> bool:
        """Whether it is a custom property."""
        return self.path.endswith('"]')

    def holder(self, owner: Datablock) -> tuple[WithProperties, str]:
        """What has the number, of its owner or of a copy of it, and the number's name there."""
        if self.is_property:
            start = self.path.rindex('["')
            whole, name = self.path[:start], bpy.utils.unescape_identifier(self.path[start + 2 : -2])
        else:
            whole, _, name = self.path.rpartition(".")
        return owner.path_resolve(whole) if whole else owner, name

    def read(self, owner: Datablock) -> float:
        """The number, of its owner or of a copy of it."""
        holder, name = self.holder(owner)
        if self.is_property:
            return float(holder[name])  # type: ignore[arg-type]
        return float(getattr(holder, name) if self.index < 0 else getattr(holder, name)[self.index])

    def write(self, value: float, owner: Datablock) -> None:
        """Give the number of its owner, or of a copy of it, a value."""
        holder, name = self.holder(owner)
        if self.index >= 0:
            getattr(holder, name)[self.index] = value
        elif self.is_property:
            holder[name] = value
        else:
            setattr(holder, name, value)

    def set(self, value: float) -> None:
        """Give it a value; a place that is gone is passed over."""
        try:
            self.write(value, self.owner)
        except (ValueError, KeyError, AttributeError, IndexError):
            return
        self.owner.update_tag()


@dataclass(frozen=True)
class Channel:
    """A number that can be keyed.

    Attributes
    ----------
    name : as users know it: that of the shape key, or of the bone and what of it moves.
    place : where it is. Of a part of a turn, `path` is the whole turn's and `index` the axis.
    low, high : its limits. resting : its value at rest, from low to high; of a part of a turn 0.
    twins : other places that always get the same value: the key of this name on another object of the face.
    neutral : what the NLA's Combine adds nothing to, or multiplies by: 1 for scales, else Blender's default.
    form : how it is kept. turn : of a part of a turn, the whole as it is at rest: a quaternion (w, x, y, z).
    """

    name: str
    place: Place
    low: float
    high: float
    resting: float = 0.0
    twins: tuple[Place, ...] = ()
    neutral: float = 0.0
    form: Form = Form.PLAIN
    turn: tuple[float, float, float, float] = (1.0, 0.0, 0.0, 0.0)

    @property
    def places(self) -> tuple[Place, ...]:
        """All places that get its value."""
        return (self.place, *self.twins)
