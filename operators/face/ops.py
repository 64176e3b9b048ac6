"""Operators for the face: add the default head, import and forget feature points."""

from __future__ import annotations

from typing import cast

import bpy
import numpy as np
from bpy.props import StringProperty

from ...face.mesh.point_files import read_point_file
from ...scene import refusals
from ...scene.points.kept import forget_points, has_points
from ...scene.points.stored import store_points
from ..active import active_object
from ..annotated import Annotated
from ..base import RisoriusOperator
from ..blender_classes import ImportHelper, Operator
from ..blender_types import Context, Object
from ..followers.rows import following, list_again
from ..preview import live
from ..requirements import has_scipy


class RISORIUS_OT_add_head(RisoriusOperator, Operator):
    """Add a human head that is ready for expressions: skin, eyes, teeth, tongue and brows in one mesh"""

    bl_idname = "risorius.add_head"
    bl_label = "Add Default Head"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only in Object Mode."""
        return None if context.mode == "OBJECT" else "Go to Object Mode (Tab) first"

    def run(self, context: Context) -> str:
        """Add it."""
        from ...scene.head import add_default_head, free_place

        place = free_place(context, np.array(context.scene.cursor.location))
        obj = cast(Object, add_default_head(context, location=place))  # every object has what the user chooses
        obj.risorius.bake.creases = True
        if context.area is not None and context.area.type == "VIEW_3D":
            region = next(region for region in context.area.regions if region.type == "WINDOW")
            with context.temp_override(region=region):
                bpy.ops.view3d.view_axis(type="FRONT")
                bpy.ops.view3d.view_selected()
        live.ask(obj)
        return f"Added {obj.name}: choose an emotion, and press Space to play it"


class RISORIUS_OT_import_points(RisoriusOperator, Operator, ImportHelper):
    """Import the feature points of this mesh from a JSON file such as {"8.4": 6207, ...}: MPEG-4 name and vertex \
index"""

    bl_idname = "risorius.import_points"
    bl_label = "Import Feature Points"
    bl_options = {"REGISTER", "UNDO"}
    needs_scipy = False

    filename_ext = ".json"
    filter_glob: Annotated[str, StringProperty(default="*.json", options={"HIDDEN"})]

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only for meshes that can be read."""
        return refusals.reason(context.object, writing=False)

    def run(self, context: Context) -> str:
        """Read, check against the standard and the mesh, store."""
        points = read_point_file(self.filepath)
        obj = active_object(context)
        store_points(obj, points)
        if has_scipy():
            list_again(obj, context.scene)
        return f"{obj.name} has {len(points)} feature points{following(obj)}"


class RISORIUS_OT_forget_points(RisoriusOperator, Operator):
    """Remove the feature points of this mesh. Baked animation stays"""

    bl_idname = "risorius.forget_points"
    bl_label = "Clear Feature Points"
    bl_options = {"REGISTER", "UNDO"}
    needs_scipy = False

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only where there are points."""
        obj = context.object
        return None if obj is not None and has_points(obj) else "This mesh has no feature points"

    def run(self, context: Context) -> str:
        """Forget them."""
        forget_points(active_object(context))
        return f"{active_object(context).name} has no feature points now"
