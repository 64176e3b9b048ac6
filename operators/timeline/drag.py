"""Clips dragged about in a timeline editor: as a whole, or the end of their onset, apex or offset."""

from __future__ import annotations

from contextlib import ExitStack
from typing import Any

import bpy

from ...scene.bake.timing import scene_fps
from .bars import TOUCH, Bar, Grip, dragged
from .drawing import bars_of, redraw


def grabbed(context: Any, event: Any) -> tuple[Bar, Grip] | None:
    """The bar under the pointer and what of it, or None."""
    region, touch = context.region, TOUCH * context.preferences.system.ui_scale
    if region is None or region.type != "WINDOW":
        return None
    for bar in reversed(bars_of(context, region)):
        grip = bar.grip(event.mouse_region_x, event.mouse_region_y, touch)
        if grip is not None:
            return bar, grip
    return None


class RISORIUS_OT_drag_clip(bpy.types.Operator):
    """Select a clip and drag it in time. Drag a corner to change its onset, apex or offset. Esc cancels"""

    bl_idname = "risorius.drag_clip"
    bl_label = "Drag Clip"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Only where clips are drawn."""
        return context.object is not None and context.area is not None and context.area.type == "DOPESHEET_EDITOR"

    def invoke(self, context: Any, event: Any) -> set[str]:
        """Begin on a bar; elsewhere the click is Blender's."""
        hit = grabbed(context, event)
        if hit is None:
            return {"PASS_THROUGH"}
        bar, self._grip = hit
        timeline = context.object.risorius.timeline
        self._was_active, self._number = timeline.active, bar.number
        timeline.active = bar.number
        self._before = getattr(timeline.clips[bar.number], self._grip.value)
        self._from = self._frame(context, event)
        context.window_manager.modal_handler_add(self)
        redraw()
        return {"RUNNING_MODAL"}

    def modal(self, context: Any, event: Any) -> set[str]:
        """Follow the pointer until the button is let go."""
        if event.type in {"ESC", "RIGHTMOUSE"} and event.value == "PRESS":
            self._set(context, self._before)
            context.object.risorius.timeline.active = self._was_active
            context.area.header_text_set(None)
            return {"CANCELLED"}
        if event.type == "MOUSEMOVE":
            fps = scene_fps(context.scene)
            value = dragged(self._grip, self._before, self._frame(context, event) - self._from, fps)
            self._set(context, value)
            unit = f"frame {value:g}" if self._grip is Grip.START else f"{value:.2f} s"
            context.area.header_text_set(f"{self._grip.value.capitalize()}: {unit}   Esc: Cancel")
        if event.type == "LEFTMOUSE" and event.value == "RELEASE":
            context.area.header_text_set(None)
            return {"FINISHED"}
        return {"RUNNING_MODAL"}

    def _set(self, context: Any, value: float) -> None:
        """Set what is dragged."""
        clip = context.object.risorius.timeline.clips[self._number]
        setattr(clip, self._grip.value, int(value) if self._grip is Grip.START else value)

    @staticmethod
    def _frame(context: Any, event: Any) -> float:
        """The frame under the pointer."""
        return float(context.region.view2d.region_to_view(event.mouse_region_x, 0)[0])


def attach(undo: ExitStack) -> None:
    """Until undone, a press of the left button in timeline editors looks for a clip first."""
    manager = bpy.context.window_manager
    configs = manager.keyconfigs.addon if manager is not None else None
    if configs is not None:
        keymap = configs.keymaps.new("Dopesheet", space_type="DOPESHEET_EDITOR")
        item = keymap.keymap_items.new(RISORIUS_OT_drag_clip.bl_idname, "LEFTMOUSE", "PRESS", head=True)
        undo.callback(keymap.keymap_items.remove, item)
