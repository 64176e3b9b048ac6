"""Operator that keeps the feature points of a face that was joined into another object."""

from __future__ import annotations

from typing import Any

import bpy

from ...scene.points.joined import may_be_joined, take_over_points
from ..base import RisoriusOperator
from .reasons import points_reason
from .show import show_points


class RISORIUS_OT_take_over_points(RisoriusOperator, bpy.types.Operator):
    """Restore the feature points of a face that was joined into this object (Ctrl J). This is possible until the \
file is closed"""

    bl_idname = "risorius.take_over_points"
    bl_label = "Restore Points"
    bl_options = {"REGISTER", "UNDO"}
    needs_scipy = False

    @classmethod
    def refusal(cls, context: Any) -> str | None:
        """Only where such a mesh is left."""
        reason = points_reason(context.object)
        if reason is None and not may_be_joined(context.object):
            return "No face was joined into this object since the file was opened"
        return reason

    def run(self, context: Any) -> str:
        """Put them where the face's polygons are now."""
        name = take_over_points(context.object)
        show_points(context)
        return f"{context.object.name} has the feature points of {name}"
