"""The panel of the parts of a face's mesh."""

from __future__ import annotations

from ...scene.mesh import read_parts
from ..active import active_object
from ..blender_classes import Panel
from ..blender_types import Context
from ..face.lips import RISORIUS_OT_cut_lips, RISORIUS_OT_line_mouth
from ..sidebar import MeshSidebar
from .ops import RISORIUS_OT_find_parts, RISORIUS_OT_forget_parts, RISORIUS_OT_set_part


class RISORIUS_PT_parts(MeshSidebar, Panel):
    """Which vertices are skin, eyes, teeth, tongue."""

    bl_label = "Mesh Parts"
    bl_parent_id = "RISORIUS_PT_main"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: Context) -> None:
        """Tell them, show them, correct them, cut lips that have no opening, line mouths without an inside."""
        layout, obj = self.layout, active_object(context)
        chosen = context.window_manager.risorius.parts
        row = layout.row(align=True)
        row.operator(RISORIUS_OT_find_parts.bl_idname, icon="VIEWZOOM")
        row.operator(RISORIUS_OT_forget_parts.bl_idname, text="", icon="X")
        if read_parts(obj.data) is not None:
            layout.prop(chosen, "show", icon="HIDE_OFF" if chosen.show else "HIDE_ON", toggle=True)
        column = layout.column(align=True)
        column.label(text="Correct with a vertex group")
        column.prop_search(chosen, "group", obj, "vertex_groups", text="")
        column.prop(chosen, "part", text="")
        column.operator(RISORIUS_OT_set_part.bl_idname, icon="CHECKMARK")
        layout.operator(RISORIUS_OT_cut_lips.bl_idname, icon="MOD_EDGESPLIT")
        layout.operator(RISORIUS_OT_line_mouth.bl_idname, icon="MESH_CAPSULE")
