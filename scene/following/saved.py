"""The list *Follows the Face* as a file keeps it, read where the extension that keeps it is not there."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Protocol, cast, runtime_checkable

import bpy

from ..blender_types import Object
from .kinds import Follows
from .rows import SLOTS, Row, of_slots

#: The property of an object that has all of Risorius in it, and the one of the face in it.
OWN, FACE = "risorius", "face"
UNKNOWN = "follows in a way that this version of Risorius does not know"


@dataclass(frozen=True)
class Saved:
    """What a file says of the objects about a face.

    Attributes
    ----------
    rows : its list, each object once; objects that are gone are left out.
    is_whole : whether the scene has been looked through for it: what is not in the list is not to follow.
    make_single_user : whether meshes that other objects share may be made single user.
    """

    rows: tuple[Row, ...] = ()
    is_whole: bool = False
    make_single_user: bool = False


@runtime_checkable
class _Group(Protocol):
    """Stored properties by name; those that were never set are not there."""

    def get(self, name: str, default: object = None) -> object: ...
    def keys(self) -> Iterable[str]: ...


def saved_with(obj: Object) -> Saved:
    """What the open file keeps with a face; nothing where its list was never filled."""
    stored = _group(_group(_group(_stored(obj)).get(OWN)).get(FACE))
    found: dict[Object, Row] = {}
    for row in _rows(stored.get("followers")):
        if row.obj != obj:
            found.setdefault(row.obj, row)
    slots = {slot: _object(stored.get(slot)) for slot in SLOTS}
    for other, follows in of_slots(slots).items():
        found.setdefault(other, Row(other, follows, by_hand=True))
    return Saved(tuple(found.values()), bool(stored.get("followers_listed")), bool(stored.get("make_single_user")))


def _stored(obj: Object) -> object:
    """Where Blender keeps what extensions define: from 5.0 on apart from the user's custom properties."""
    apart = getattr(obj, "bl_system_properties_get", None)
    return obj if apart is None else apart()


def _rows(entries: object) -> Iterator[Row]:
    """The rows of a stored list whose objects are still there."""
    for entry in map(_group, entries if isinstance(entries, list) else ()):
        other = _object(entry.get("object"))
        if other is None:
            continue
        number, ways = cast(int, entry.get("follows", 0)), tuple(Follows)
        if number < len(ways):
            yield Row(other, ways[number], str(entry.get("why_not", "")), bool(entry.get("by_hand")))
        else:
            yield Row(other, Follows.NONE, UNKNOWN, by_hand=True)


def _group(value: object) -> _Group:
    """A stored group; an empty one where nothing, or something else, is stored."""
    empty: dict[str, object] = {}
    return value if isinstance(value, _Group) else cast(_Group, empty)


def _object(value: object) -> Object | None:
    """A stored object; None where it is gone."""
    return value if isinstance(value, bpy.types.Object) else None
