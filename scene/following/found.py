"""The objects of a character that follow its face: found by their names, their places and their shapes."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from dataclasses import dataclass

import bpy

from ...errors import RisoriusError
from ..blender_types import Object, Scene
from ..points.kept import has_points
from ..refusals import reason
from .habits import told_by_name, told_by_names
from .kinds import Follows
from .places import Surroundings

#: Objects that show, but have no mesh that could follow.
SHAPES = ("CURVES", "CURVE", "SURFACE", "META", "FONT", "GPENCIL", "GREASEPENCIL", "POINTCLOUD")
#: More vertex groups than these are a whole body's, and tell nothing of one part.
FEW_GROUPS = 8


@dataclass(frozen=True)
class Follower:
    """An object beside a head, how it follows the face, and why it cannot where it does not."""

    obj: Object
    follows: Follows
    why_not: str = ""


def find_followers(head: Object, scene: Scene | None = None, *, beside: Collection[Object] = ()) -> list[Follower]:
    """The objects of `scene` that belong to the face of a head with feature points, but for some, sorted by name.

    Raises
    ------
    SceneError, ModelError : the head's points cannot be read, or are no face's.
    """
    scene = scene if scene is not None else bpy.context.scene
    around = Surroundings.of(head, scene)
    others = (other for other in _others(head, scene) if other not in beside)
    found = [follower for other in others if (follower := _follower(around, other)) is not None]
    return sorted(found, key=lambda follower: follower.obj.name)


def way_of(head: Object, other: Object, scene: Scene | None = None) -> Follows:
    """How one object follows that somebody says to belong to a head: as it seems to, else as its name says."""
    named = _named(other)
    if has_points(head):
        follower = _follower(Surroundings.of(head, scene), other)
        if follower is not None and follower.follows is not Follows.NONE:
            return follower.follows
    return Follows.SKULL if named in (None, Follows.NONE) else named


def _others(head: Object, scene: Scene) -> Iterator[Object]:
    """Objects that may belong to a head: those that show, are no face themselves, and hang on no other rig."""
    rigs = _rigs_of(head)
    for other in scene.objects:
        if other == head or other.type not in ("MESH", *SHAPES) or (other.hide_render and other.hide_viewport):
            continue
        if other.type == "MESH" and (has_points(other) or len(other.data.polygons) == 0 or other.data == head.data):
            continue
        if not rigs or not (theirs := _rigs_of(other)) or theirs & rigs:
            yield other


def _rigs_of(obj: Object) -> set[Object]:
    """The armatures that an object hangs on."""
    rigs = {modifier.object for modifier in obj.modifiers if modifier.type == "ARMATURE"}
    parent = obj.parent
    while parent is not None:
        rigs |= {parent} if parent.type == "ARMATURE" else set()
        parent = parent.parent
    return {rig for rig in rigs if rig is not None}


def _follower(around: Surroundings, other: Object) -> Follower | None:
    """How one object follows; None where it does not belong to the face, or nothing can be told of it."""
    try:
        if not around.meets(other):
            return None
        named = _named(other)
        if other.type != "MESH":
            return None if named in (None, Follows.NONE) else Follower(other, Follows.NONE, "is not a mesh")
        if named is Follows.NONE:
            return None
        follows = around.told(other, named)
        refused = None if follows is None else reason(other, make_single_user=True)
    except RisoriusError:  # scaled to nothing
        return None
    if follows is None:
        return None
    return Follower(other, follows) if refused is None else Follower(other, Follows.NONE, refused)


def _named(obj: Object) -> Follows | None:
    """What the names of an object say: its own, its mesh's, its collections', its materials', its vertex groups'."""
    for name in (obj.name, obj.data.name):
        if (told := told_by_name(name)) is not None:
            return told
    if obj.type != "MESH":
        return None
    groups = [group.name for group in obj.vertex_groups]
    for names in (_materials(obj), _collections(obj), groups if len(groups) <= FEW_GROUPS else []):
        if (told := told_by_names(names)) is not None:
            return told
    return None


def _materials(obj: Object) -> Iterable[str]:
    """Names of the materials of a mesh."""
    return [material.name for material in obj.data.materials if material is not None]


def _collections(obj: Object) -> Iterable[str]:
    """Names of the collections that an object is in."""
    return [collection.name for collection in obj.users_collection]
