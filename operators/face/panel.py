"""The panel's top: which face, and its parts."""

from __future__ import annotations

from typing import Any

import bpy

from ...scene import refusals
from ...scene.points_kept import has_points
from ..points.click import RISORIUS_OT_click_points
from ..points.ops import RISORIUS_OT_find_points
from ..requirements import MISSING, REMEDY, has_scipy
from ..sidebar import Sidebar
from .ops import RISORIUS_OT_add_head, RISORIUS_OT_import_points


class RISORIUS_PT_main(Sidebar, bpy.types.Panel):
    """The tab: which face the panels below are about."""

    bl_label = "Risorius"

    def draw(self, context: Any) -> None:
        """The active object, and what is missing."""
        layout = self.layout
        if not has_scipy():
            box = layout.box().column(align=True)
            box.alert = True
            box.label(text=MISSING, icon="ERROR")
            for line in REMEDY:
                box.label(text=line)
        obj = context.object
        if obj is None or obj.type != "MESH":
            column = layout.column(align=True)
            column.label(text="Select the mesh of a face,", icon="INFO")
            column.label(text="or start with the default head:", icon="BLANK1")
        elif has_points(obj):
            layout.label(text=obj.name, icon="CHECKMARK")
        else:
            column = layout.column(align=True)
            column.label(text=obj.name, icon="MESH_DATA")
            column.label(text="Needs its feature points:", icon="INFO")
            find = column.column(align=True)
            find.scale_y = 1.3
            find.operator(RISORIUS_OT_find_points.bl_idname, icon="VIEWZOOM")
            column.operator(RISORIUS_OT_click_points.bl_idname, icon="RESTRICT_SELECT_OFF")
            column.operator(RISORIUS_OT_import_points.bl_idname, icon="IMPORT")
        layout.operator(RISORIUS_OT_add_head.bl_idname, icon="USER")


class RISORIUS_PT_face(Sidebar, bpy.types.Panel):
    """Parts of the active face that are objects of their own."""

    bl_label = "Face"
    bl_parent_id = "RISORIUS_PT_main"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Only for meshes."""
        return context.object is not None and context.object.type == "MESH"

    def draw(self, context: Any) -> None:
        """Which objects they are."""
        layout = self.layout
        layout.use_property_split, layout.use_property_decorate = True, False
        obj, face = context.object, context.object.risorius.face
        column = layout.column(align=True)
        column.label(text="Parts in other objects")
        for name in ("eyeball_l", "eyeball_r", "teeth_upper", "teeth_lower", "tongue"):
            column.prop(face, name)
        if obj.data.users > 1 or refusals.reason(obj) is not None:
            layout.prop(face, "make_single_user")


CLASSES = (RISORIUS_PT_main, RISORIUS_PT_face)
