"""Operator that keeps the feature points of a face that was joined into another object."""

from __future__ import annotations

from ...scene.points.joined import may_be_joined, take_over_points
from ..active import active_object
from ..base import RisoriusOperator
from ..blender_classes import Operator
from ..blender_types import Context
from .reasons import points_reason
from .show import show_points


class RISORIUS_OT_take_over_points(RisoriusOperator, Operator):
    """Restore the feature points of a face that was joined into this object (Ctrl J). This is possible until the \
file is closed"""

    bl_idname = "risorius.take_over_points"
    bl_label = "Restore Points"
    bl_options = {"REGISTER", "UNDO"}
    needs_scipy = False

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only where such a mesh is left."""
        reason = points_reason(context.object)
        if reason is None and not may_be_joined(active_object(context)):
            return "No face was joined into this object since the file was opened"
        return reason

    def run(self, context: Context) -> str:
        """Put them where the face's polygons are now."""
        name = take_over_points(active_object(context))
        show_points(context)
        return f"{active_object(context).name} has the feature points of {name}"
