"""The panel of feature points: found, clicked, corrected, listed."""

from __future__ import annotations

from ...errors import RisoriusError
from ...face.fit.doubt import DOUBTFUL
from ...mpeg4 import FEATURE_POINTS
from ...scene.points.kept import KeptPoints, Origin, has_points, read_kept
from ..active import active_object
from ..blender_classes import Panel, UIList
from ..blender_types import Context, Object, UILayout
from ..face.ops import RISORIUS_OT_forget_points, RISORIUS_OT_import_points
from ..sidebar import MeshSidebar
from .click import RISORIUS_OT_click_points
from .drag import RISORIUS_OT_use_drag_tool
from .look import RISORIUS_OT_look_at_face
from .ops import (
    RISORIUS_OT_export_points,
    RISORIUS_OT_find_points,
    RISORIUS_OT_follow_mesh,
    RISORIUS_OT_jump_to_point,
    RISORIUS_OT_reset_points,
    edited,
)
from .props import RISORIUS_PG_point_name, RISORIUS_PG_points, list_names_soon

#: Rows of the list.
ROWS = 7
_ICON_OF_ORIGIN = {
    Origin.FOUND: "VIEWZOOM",
    Origin.CLICKED: "RESTRICT_SELECT_OFF",
    Origin.DRAGGED: "VIEW_PAN",
    Origin.FILE: "FILE",
    Origin.TOPOLOGY: "MESH_GRID",
}


def kept_of(obj: Object | None) -> KeptPoints | None:
    """The points of the active object, where they can be read."""
    try:
        return read_kept(obj) if obj is not None and has_points(obj) else None
    except RisoriusError:
        return None


def confidence_icon(confidence: float) -> str:
    """Blue, yellow, red: as on the face."""
    if confidence >= (1.0 + DOUBTFUL) / 2.0:
        return "STRIP_COLOR_05"
    return "STRIP_COLOR_03" if confidence >= DOUBTFUL else "STRIP_COLOR_01"


class RISORIUS_UL_points(UIList):
    """Feature points of the active face: how sure, number and place, where from, look at it, put it back."""

    def draw_item(
        self,
        context: Context,
        layout: UILayout,
        data: RISORIUS_PG_points,
        item: RISORIUS_PG_point_name,
        icon: int,
        active_data: object,
        active_property: str,
    ) -> None:
        """One point."""
        kept = kept_of(context.object)
        point = kept.points.get(item.name) if kept is not None else None
        if point is None:
            return
        row = layout.row(align=True)
        row.label(text=f"{item.name}  {FEATURE_POINTS[item.name].location}", icon=confidence_icon(point.confidence))
        row.label(text="", icon=_ICON_OF_ORIGIN[point.origin])
        row.operator(RISORIUS_OT_jump_to_point.bl_idname, text="", icon="ZOOM_SELECTED", emboss=False).point = item.name
        back = row.operator(RISORIUS_OT_reset_points.bl_idname, text="", icon="LOOP_BACK", emboss=False)
        back.which, back.point = "ONE", item.name

    def filter_items(self, context: Context, data: RISORIUS_PG_points, property: str) -> tuple[list[int], list[int]]:
        """Only points that the mesh has, and of these what is asked for."""
        kept = kept_of(context.object)
        state = context.window_manager.risorius.points
        wanted = self.filter_name.casefold()
        flags = []
        for item in data.names:
            point = kept.points.get(item.name) if kept is not None else None
            shown = point is not None and (not state.doubtful_only or point.confidence < DOUBTFUL)
            words = f"{item.name} {FEATURE_POINTS[item.name].location}".casefold()
            flags.append(self.bitflag_filter_item if shown and wanted in words else 0)
        return flags, []


class RISORIUS_PT_points(MeshSidebar, Panel):
    """Where the features of the active face are."""

    bl_label = "Feature Points"
    bl_parent_id = "RISORIUS_PT_main"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: Context) -> None:
        """Ways to get points; then what there is and how to correct it."""
        layout, obj = self.layout, active_object(context)
        column = layout.column(align=True)
        column.operator(RISORIUS_OT_find_points.bl_idname, icon="VIEWZOOM")
        column.operator(RISORIUS_OT_click_points.bl_idname, icon="RESTRICT_SELECT_OFF")
        row = layout.row(align=True)
        row.operator(RISORIUS_OT_import_points.bl_idname, text="Import", icon="IMPORT")
        row.operator(RISORIUS_OT_export_points.bl_idname, text="Export", icon="EXPORT")
        row.operator(RISORIUS_OT_forget_points.bl_idname, text="", icon="X")
        kept = kept_of(obj)
        if kept is None:
            return
        if edited(obj):
            box = layout.box().column(align=True)
            box.label(text="The mesh was edited", icon="ERROR")
            box.operator(RISORIUS_OT_follow_mesh.bl_idname, icon="FILE_REFRESH")
            return
        self._draw_points(layout, context, kept)

    def _draw_points(self, layout: UILayout, context: Context, kept: KeptPoints) -> None:
        """The list, and how the points are shown and corrected."""
        state = context.window_manager.risorius.points
        if not state.names:
            list_names_soon()
        doubtful = len(kept.doubtful())
        row = layout.row(align=True)
        row.prop(state, "show", icon="HIDE_OFF" if state.show else "HIDE_ON", toggle=True)
        row.prop(state, "labels", text="")
        row.operator(RISORIUS_OT_look_at_face.bl_idname, text="", icon="ZOOM_SELECTED")
        count = f"{len(kept.points)} points"
        layout.label(text=f"{count}, {doubtful} doubtful" if doubtful else count, icon="INFO")
        layout.template_list("RISORIUS_UL_points", "", state, "names", state, "active", rows=ROWS)
        row = layout.row(align=True)
        row.operator(RISORIUS_OT_use_drag_tool.bl_idname, icon="VIEW_PAN")
        row.prop(state, "mirror", text="", icon="MOD_MIRROR", toggle=True)
        row.prop(state, "doubtful_only", text="", icon="FILTER", toggle=True)
        row = layout.row(align=True)
        for which, text in (("LEFT", "Reset Left"), ("RIGHT", "Reset Right"), ("ALL", "Reset All")):
            row.operator(RISORIUS_OT_reset_points.bl_idname, text=text).which = which
