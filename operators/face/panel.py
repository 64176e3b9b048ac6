"""The panel's top: which face."""

from __future__ import annotations

from ...scene.points.joined import may_be_joined
from ...scene.points.kept import has_points
from ..blender_classes import Panel
from ..blender_types import Context, Object, UILayout
from ..points.click import RISORIUS_OT_click_points
from ..points.joined import RISORIUS_OT_take_over_points
from ..points.ops import RISORIUS_OT_find_points
from ..points.panel import kept_of
from ..points.question import draw_question
from ..requirements import MISSING, REMEDY, has_scipy
from ..saved_by import draw_later
from ..sidebar import Sidebar
from .lips import draw_sewn
from .ops import RISORIUS_OT_add_head, RISORIUS_OT_import_points
from .six import RISORIUS_OT_bake_six


class RISORIUS_PT_main(Sidebar, Panel):
    """The tab: which face the panels below are about."""

    bl_label = "Risorius"

    def draw(self, context: Context) -> None:
        """The active object, and what is missing."""
        layout = self.layout
        if not has_scipy():
            box = layout.box().column(align=True)
            box.alert = True
            box.label(text=MISSING, icon="ERROR")
            for line in REMEDY:
                box.label(text=line)
        draw_later(layout, context.scene)
        obj = context.object
        if obj is None or obj.type != "MESH":
            column = layout.column(align=True)
            column.label(text="Select the mesh of a face,", icon="INFO")
            column.label(text="or start with the default head:", icon="BLANK1")
        elif has_points(obj):
            self._draw_known(layout, obj)
        else:
            self._draw_unknown(layout, obj)
        layout.operator(RISORIUS_OT_add_head.bl_idname, icon="USER")

    def _draw_known(self, layout: UILayout, obj: Object) -> None:
        """A face with its points, or the question whether it is one."""
        kept = kept_of(obj)
        if kept is not None and kept.is_questioned:
            box = layout.box().column(align=True)
            box.label(text="Is this the face?", icon="ERROR")
            draw_question(box, kept)
            return
        layout.label(text=obj.name, icon="CHECKMARK")
        _large(layout).operator(RISORIUS_OT_bake_six.bl_idname, icon="PLAY")
        if kept is not None:
            draw_sewn(layout, obj, kept)

    def _draw_unknown(self, layout: UILayout, obj: Object) -> None:
        """A mesh whose points are not known: the first step, all in one, and what helps where that fails."""
        column = layout.column(align=True)
        column.label(text=obj.name, icon="MESH_DATA")
        if may_be_joined(obj):
            box = layout.box().column(align=True)
            box.label(text="Was a face joined into it?", icon="INFO")
            box.operator(RISORIUS_OT_take_over_points.bl_idname, icon="LINKED")
        column = _large(layout)
        column.operator(RISORIUS_OT_find_points.bl_idname, icon="VIEWZOOM")
        column.operator(RISORIUS_OT_bake_six.bl_idname, icon="PLAY")
        column = layout.column(align=True)
        column.label(text="If no face is found:")
        column.operator(RISORIUS_OT_click_points.bl_idname, icon="RESTRICT_SELECT_OFF")
        column.operator(RISORIUS_OT_import_points.bl_idname, icon="IMPORT")


def _large(layout: UILayout) -> UILayout:
    """Room for what comes first."""
    column = layout.column(align=True)
    column.scale_y = 1.3
    return column
