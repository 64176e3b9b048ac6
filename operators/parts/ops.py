"""Operators for the parts of a face's mesh: tell them apart, correct one by a vertex group, forget them."""

from __future__ import annotations

import numpy as np

from ...arrays import Ints
from ...face.mesh.parts import Part
from ...scene.mesh import read_parts
from ...scene.parts_found import find_parts, forget_parts, set_part
from ..active import active_object
from ..base import RisoriusOperator
from ..blender_classes import Operator
from ..blender_types import Context
from ..points.reasons import no_points_reason, points_reason
from .props import PARTS


class RISORIUS_OT_find_parts(RisoriusOperator, Operator):
    """Find skin, eyeballs, teeth and tongue in this mesh, show them as colours, and save them with the mesh"""

    bl_idname = "risorius.find_parts"
    bl_label = "Find Parts"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only where there are feature points."""
        return no_points_reason(context.object)

    def run(self, context: Context) -> str:
        """Tell, keep and show them."""
        parts = find_parts(active_object(context))
        context.window_manager.risorius.parts.show = True
        return f"{active_object(context).name}: {', '.join(named for part in PARTS if (named := counted(parts, part)))}"


def counted(parts: Ints, part: Part) -> str:
    """Name and number of vertices of a part; empty where there are none."""
    count = int(np.sum(parts == int(part)))
    return f"{PARTS[part][1].lower()} {count}" if count else ""


class RISORIUS_OT_set_part(RisoriusOperator, Operator):
    """Assign the vertices of the vertex group to the part"""

    bl_idname = "risorius.set_part"
    bl_label = "Assign Part"
    bl_options = {"REGISTER", "UNDO"}
    needs_scipy = False

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only with a group of the mesh."""
        reason = points_reason(context.object)
        if reason is None and context.window_manager.risorius.parts.group not in active_object(context).vertex_groups:
            return "Choose a vertex group of this mesh first"
        return reason

    def run(self, context: Context) -> str:
        """Set and show it."""
        chosen = context.window_manager.risorius.parts
        part = Part[chosen.part]
        count = set_part(active_object(context), chosen.group, part)
        chosen.show = True
        return f"{active_object(context).name}: {count} vertices of {chosen.group} are {PARTS[part][1].lower()}"


class RISORIUS_OT_forget_parts(RisoriusOperator, Operator):
    """Remove the saved parts. Each bake then finds them again from the shape of the mesh"""

    bl_idname = "risorius.forget_parts"
    bl_label = "Clear Parts"
    bl_options = {"REGISTER", "UNDO"}
    needs_scipy = False

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only where there are some."""
        reason = points_reason(context.object)
        if reason is None and read_parts(active_object(context).data) is None:
            return "This mesh has no saved parts"
        return reason

    def run(self, context: Context) -> str:
        """Forget them."""
        forget_parts(active_object(context))
        return f"{active_object(context).name}: its parts are found from its shape again"
