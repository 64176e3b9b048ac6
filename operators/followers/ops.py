"""Operators for the list of what follows a face: fill it again, add to it, take from it."""

from __future__ import annotations

from collections.abc import Sequence

import bpy

from ...errors import SceneError
from ...scene.following.kinds import Follows
from ...scene.following.rows import SLOTS
from ..active import active_object
from ..base import RisoriusOperator
from ..blender_classes import Operator
from ..blender_types import Context, Object
from ..changes import changed
from ..points.reasons import no_points_reason
from .rows import refresh, rows_of


class RISORIUS_OT_find_followers(RisoriusOperator, Operator):
    """Find eyes, teeth, tongue, lashes, hair and other objects of this character by their names and places. What you \
have changed in the list stays"""

    bl_idname = "risorius.find_followers"
    bl_label = "Refresh"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only where the face is known."""
        return no_points_reason(context.object)

    def run(self, context: Context) -> str:
        """Fill the list."""
        obj = active_object(context)
        new = refresh(obj, context.scene)
        changed(obj.risorius.face)
        count = sum(row.follows is not Follows.NONE for row in rows_of(obj))
        added = f"; new: {', '.join(new)}" if new else ""
        return f"{obj.name}: {count} object{'s' * (count != 1)} follow{'s' * (count == 1)} the face{added}"


class RISORIUS_OT_add_followers(RisoriusOperator, Operator):
    """Add the selected objects to the list"""

    bl_idname = "risorius.add_followers"
    bl_label = "Add Selected"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only with another mesh selected."""
        if context.object is None or context.object.type != "MESH":
            return "Make the mesh of a face the active object"
        return None if _selected(context) else "Select the other meshes too, with the face as the active object"

    def run(self, context: Context) -> str:
        """Add those that are not there; what is known of them decides how they follow."""
        obj = active_object(context)
        face, listed = obj.risorius.face, {row.obj for row in rows_of(obj)}
        new = [other for other in _selected(context) if other not in listed]
        if not new:
            raise SceneError(obj.name, "has all selected objects in its list")
        for other in new:
            row = face.followers.add()
            row.name, row.object = other.name, other
            row.follows = _way(obj, other, context).name
        face.follower = len(face.followers) - 1
        return f"{', '.join(other.name for other in new)} added: check how they follow"


def _selected(context: Context) -> list[Object]:
    """The selected meshes besides the face."""
    selected: Sequence[Object] = bpy.context.selected_objects
    return [other for other in selected if other.type == "MESH" and other != context.object]


def _way(obj: Object, other: Object, context: Context) -> Follows:
    """How an object that the user adds follows: as its name and its place tell, else with the skull."""
    from ...scene.following.found import way_of

    return way_of(obj, other, context.scene)


class RISORIUS_OT_remove_follower(RisoriusOperator, Operator):
    """Remove the object from the list. It then does not follow the face"""

    bl_idname = "risorius.remove_follower"
    bl_label = "Remove from List"
    bl_options = {"REGISTER", "UNDO"}
    needs_scipy = False

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only with a row to remove."""
        obj = context.object
        return None if obj is not None and obj.risorius.face.followers else "The list is empty"

    def run(self, context: Context) -> str:
        """Remove it."""
        obj = active_object(context)
        face = obj.risorius.face
        index = max(min(face.follower, len(face.followers) - 1), 0)
        gone = face.followers[index].object
        for slot in SLOTS:
            if gone is not None and getattr(face, slot) == gone:
                setattr(face, slot, None)
        remaining = [row.object for row in face.followers]
        if gone in remaining:
            face.followers.remove(remaining.index(gone))
        face.follower = max(min(index, len(face.followers) - 1), 0)
        changed(face)
        return f"{gone.name if gone is not None else 'An object that is gone'} removed from the list"
