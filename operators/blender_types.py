"""What operators use of Blender's types beyond what `scene.blender_types` names: the user's choices, and windows."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol, TypeVar

from ..scene import blender_types as scene_types

if TYPE_CHECKING:
    from .props import RISORIUS_PG_object

T_co = TypeVar("T_co", covariant=True)


class Entries(scene_types.Items[T_co], Protocol[T_co]):
    """A collection of property groups, as a `CollectionProperty` holds it."""

    def add(self) -> T_co: ...
    def remove(self, index: int) -> None: ...
    def move(self, index: int, to: int) -> None: ...
    def clear(self) -> None: ...


class Object(scene_types.Object, Protocol):
    """An object, with what is chosen for it."""

    risorius: RISORIUS_PG_object
