"""Clips dragged about in a timeline editor: as a whole, or the end of their onset, apex or offset."""

from __future__ import annotations

from contextlib import ExitStack

import bpy

from ...scene.bake.timing import scene_fps
from ...scene.blender_types import Event
from ..active import active_object
from ..blender_classes import Operator
from ..blender_types import Context, WindowManager
from ..screen import redraw_timelines
from .bars import TOUCH, Bar, Grip, dragged
from .drawing import bars_of


def grabbed(context: Context, event: Event) -> tuple[Bar, Grip] | None:
    """The bar under the pointer and what of it, or None."""
    region, touch = context.region, TOUCH * context.preferences.system.ui_scale
    if region is None or region.type != "WINDOW":
        return None
    for bar in reversed(bars_of(context, region)):
        grip = bar.grip(event.mouse_region_x, event.mouse_region_y, touch)
        if grip is not None:
            return bar, grip
    return None


class RISORIUS_OT_drag_clip(Operator):
    """Select a clip and drag it in time. Drag a corner to change its onset, apex or offset. Esc cancels"""

    bl_idname = "risorius.drag_clip"
    bl_label = "Drag Clip"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: Context) -> bool:
        """Only where clips are drawn."""
        return context.object is not None and context.area is not None and context.area.type == "DOPESHEET_EDITOR"

    def invoke(self, context: Context, event: Event) -> set[str]:
        """Begin on a bar; elsewhere the click is Blender's."""
        hit, area, region = grabbed(context, event), context.area, context.region
        if hit is None or area is None or region is None:
            return {"PASS_THROUGH"}
        (bar, self._grip), self._area, self._region = hit, area, region
        timeline = active_object(context).risorius.timeline
        self._was_active, self._number = timeline.active, bar.number
        timeline.active = bar.number
        self._before = getattr(timeline.clips[bar.number], self._grip.value)
        self._from = self._frame(event)
        context.window_manager.modal_handler_add(self)
        redraw_timelines()
        return {"RUNNING_MODAL"}

    def modal(self, context: Context, event: Event) -> set[str]:
        """Follow the pointer until the button is let go."""
        if event.type in {"ESC", "RIGHTMOUSE"} and event.value == "PRESS":
            self._set(context, self._before)
            active_object(context).risorius.timeline.active = self._was_active
            self._area.header_text_set(None)
            return {"CANCELLED"}
        if event.type == "MOUSEMOVE":
            fps = scene_fps(context.scene)
            value = dragged(self._grip, self._before, self._frame(event) - self._from, fps)
            self._set(context, value)
            unit = f"frame {value:g}" if self._grip is Grip.START else f"{value:.2f} s"
            self._area.header_text_set(f"{self._grip.value.capitalize()}: {unit}   Esc: Cancel")
        if event.type == "LEFTMOUSE" and event.value == "RELEASE":
            self._area.header_text_set(None)
            return {"FINISHED"}
        return {"RUNNING_MODAL"}

    def _set(self, context: Context, value: float) -> None:
        """Set what is dragged."""
        clip = active_object(context).risorius.timeline.clips[self._number]
        setattr(clip, self._grip.value, int(value) if self._grip is Grip.START else value)

    def _frame(self, event: Event) -> float:
        """The frame under the pointer."""
        return float(self._region.view2d.region_to_view(event.mouse_region_x, 0)[0])


def attach(undo: ExitStack) -> None:
    """Until undone, a press of the left button in timeline editors looks for a clip first."""
    manager: WindowManager | None = bpy.context.window_manager
    configs = manager.keyconfigs.addon if manager is not None else None
    if configs is not None:
        keymap = configs.keymaps.new("Dopesheet", space_type="DOPESHEET_EDITOR")
        item = keymap.keymap_items.new(RISORIUS_OT_drag_clip.bl_idname, "LEFTMOUSE", "PRESS", head=True)
        undo.callback(keymap.keymap_items.remove, item)
