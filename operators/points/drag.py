"""Dragging a feature point along the surface, its counterpart with it; one step of undo for each drag."""

from __future__ import annotations

from contextlib import ExitStack

import bpy
import numpy as np

from ...arrays import Floats
from ...mpeg4 import FEATURE_POINTS
from ...scene import mesh as meshes
from ...scene.blender_types import Event
from ...scene.fingerprint import uid_of
from ...scene.points.bound import Surface, fits, followed, moved, places
from ...scene.points.kept import KeptPoints, Origin, read_kept, write_kept
from ...scene.points.mirrored import MirrorPlane, plane_of_points
from ...scene.points.seen import Visible
from ..active import active_object, object_of
from ..base import RisoriusOperator
from ..blender_classes import Operator, WorkSpaceTool
from ..blender_types import Context, Object, UILayout
from ..held import Held
from ..screen import redraw_viewports, show_status
from .ops import label_of
from .overlay import point_at
from .props import mark
from .reasons import no_points_reason
from .show import show_points
from .view import Viewport

TOOL = "risorius.drag_points"
#: Pixels that the mouse may tremble in a click that only marks a point.
STILL = 2.0


class RISORIUS_OT_drag_point(Operator):
    """Drag a feature point along the surface"""

    bl_idname = "risorius.drag_point"
    bl_label = "Drag Feature Point"
    bl_options = {"REGISTER", "UNDO", "INTERNAL"}

    @classmethod
    def poll(cls, context: Context) -> bool:
        """Where points are drawn."""
        return no_points_reason(context.object) is None and bool(context.window_manager.risorius.points.show)

    def invoke(self, context: Context, event: Event) -> set[str]:
        """Take hold of the point under the mouse. Beside them nothing happens: passed on, it would move the object."""
        viewport = Viewport.of(context)
        pixel = None if viewport is None else viewport.pixel(event)
        name = None if pixel is None else point_at(context, pixel)
        if name is None or pixel is None:
            return {"CANCELLED"}
        self._pressed, self._has_left = pixel, False
        obj = active_object(context)
        self._name, self._uid, self._held = name, uid_of(obj), Held()
        self._surface = Surface.of(obj.data)
        self._before = read_kept(obj)
        self._now = self._before if fits(self._before, obj.data) else followed(self._before, obj.data).kept
        self._plane = plane_of_points(places(self._now, meshes.rest_vertices(obj.data)))
        mark(context.window_manager.risorius.points, name)
        context.window_manager.modal_handler_add(self)
        self._held.gives_back(redraw_viewports)
        self._held.holds_status(context)
        show_status(context, f"{label_of(name)}   Release: Confirm   Esc, Right Mouse: Cancel")
        return {"RUNNING_MODAL"}

    def modal(self, context: Context, event: Event) -> set[str]:
        """Follow the mouse; release to put, Esc to leave all as it was."""
        obj = object_of(self._uid)
        if obj is None or self._held.is_outdated:
            return self._end({"CANCELLED"})
        if event.type == "MOUSEMOVE":
            self._follow(context, event, obj)
            return {"RUNNING_MODAL"}
        if event.type in {"ESC", "RIGHTMOUSE"} and event.value == "PRESS":
            write_kept(obj, self._before)
            return self._end({"CANCELLED"})
        if event.type == "LEFTMOUSE" and event.value == "RELEASE":
            self._follow(context, event, obj)
            if read_kept(obj) == self._before:
                return self._end({"CANCELLED"})
            self.report({"INFO"}, f"Moved {label_of(self._name)}")
            return self._end({"FINISHED"})
        return {"RUNNING_MODAL"}

    def _follow(self, context: Context, event: Event, obj: Object) -> None:
        """Put the point under the mouse, once that has left the place where it was pressed."""
        viewport = Viewport.of(context)
        pixel = None if viewport is None else viewport.pixel(event)
        if viewport is None or pixel is None:
            return
        away = max(abs(pixel[0] - self._pressed[0]), abs(pixel[1] - self._pressed[1]))
        self._has_left = self._has_left or away > STILL
        if not self._has_left:
            return
        visible = Visible.of(obj, context.evaluated_depsgraph_get())
        place = visible.hit(*viewport.ray(pixel), self._surface)
        if place is not None:
            write_kept(obj, self.dragged(place, mirror=context.window_manager.risorius.points.mirror))
            redraw_viewports()

    def dragged(self, place: Floats, *, mirror: bool) -> KeptPoints:
        """The points with this one at a place of the resting surface, and its counterpart on the other side."""
        return with_counterpart(self._now, self._name, place, self._surface, self._plane if mirror else None)

    def _end(self, result: set[str]) -> set[str]:
        """Let go."""
        self._held.close()
        return result

    def cancel(self, context: Context) -> None:
        """Blender ends the operator itself."""
        self._held.close()


def with_counterpart(
    kept: KeptPoints, name: str, place: Floats, surface: Surface, plane: MirrorPlane | None
) -> KeptPoints:
    """Points with one of them put to a place, and where there is a mirror plane its counterpart to the mirrored one."""
    changed = moved(kept, name, np.asarray(place), surface, Origin.DRAGGED)
    other = FEATURE_POINTS[name].mirror
    if plane is not None and other is not None and other in kept.points:
        put = np.array(changed.points[name].at)
        changed = moved(changed, other, plane.reflected(put), surface, Origin.DRAGGED)
    return changed


class RISORIUS_OT_use_drag_tool(RisoriusOperator, Operator):
    """Activate the tool that drags feature points along the surface with the left mouse button"""

    bl_idname = "risorius.use_drag_tool"
    bl_label = "Drag Points"
    bl_options = {"INTERNAL"}
    needs_scipy = False

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only where there are points."""
        return no_points_reason(context.object)

    def run(self, context: Context) -> str:
        """Show the points and take the tool in hand."""
        show_points(context)
        if not bpy.app.background:
            bpy.ops.wm.tool_set_by_id(name=TOOL)
        return "Drag points with the left mouse button; choose another tool to stop"


class DragTool(WorkSpaceTool):
    """The tool in the toolbar."""

    bl_space_type = "VIEW_3D"
    bl_context_mode = "OBJECT"
    bl_idname = TOOL
    bl_label = "Drag Feature Points"
    bl_description = "Drag the feature points of a face along its surface"
    bl_icon = "ops.transform.translate"
    bl_widget = None
    bl_keymap = ((RISORIUS_OT_drag_point.bl_idname, {"type": "LEFTMOUSE", "value": "PRESS"}, None),)

    def draw_settings(context: Context, layout: UILayout, tool: object) -> None:
        """What stands in the header."""
        layout.prop(context.window_manager.risorius.points, "mirror")


def attach(undo: ExitStack) -> None:
    """Put the tool into the toolbar, until undone."""
    bpy.utils.register_tool(DragTool, after={"builtin.transform"}, separator=True)
    undo.callback(bpy.utils.unregister_tool, DragTool)
