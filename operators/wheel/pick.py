"""The wheel at the pointer, for those who have it hidden: from Blender's search, or a key of one's own."""

from __future__ import annotations

from contextlib import ExitStack
from typing import ClassVar, NamedTuple

import bpy

from ...scene.blender_types import Event
from ..active import active_object, object_of
from ..blender_classes import Menu, Operator
from ..blender_types import Context
from .caption import caption
from .choice import Choice, Hand
from .dragging import Dragging
from .geometry import Corner, Wheel, under
from .picture import draw_wheel
from .view import FOOT, MARGIN, free_of, no_face_reason, scale_of


class _Shown(NamedTuple):
    """A wheel that is shown: in which region, the number of which object; and Blender's handle of its drawing."""

    wheel: Wheel
    region: int
    uid: int
    handle: object


_shown: _Shown | None = None


class RISORIUS_OT_pick_emotion(Dragging, Operator):
    """Show the emotion wheel at the pointer. Move to change the face, click to choose"""

    bl_idname = "risorius.pick_emotion"
    bl_label = "Pick Emotion on Wheel"
    bl_options = {"UNDO", "BLOCKING"}

    chooses_on: ClassVar[str] = "PRESS"
    chooses_by: ClassVar[str] = "Click"

    @classmethod
    def poll(cls, context: Context) -> bool:
        """Where there is a face."""
        reason = no_face_reason(context)
        if reason is not None:
            cls.poll_message_set(reason)
        return reason is None

    def invoke(self, context: Context, event: Event) -> set[str]:
        """Show the wheel so that what is chosen lies under the pointer."""
        area, region, space = context.area, context.region, context.space_data
        if area is None or space is None or region is None or region.type != "WINDOW":
            self.report({"ERROR"}, "The pointer is not over a 3D viewport: move it there and search again")
            return {"CANCELLED"}
        now, scale = Choice.of(active_object(context).risorius.emotion), scale_of(context)
        pointer = (float(event.mouse_region_x), float(event.mouse_region_y))
        free, size = free_of(area, region, space, Corner.BOTTOM_LEFT, scale), context.window_manager.risorius.wheel.size
        away = 0.0 if now.is_centre() else now.activation
        margin = (MARGIN + FOOT) * scale
        wheel = under(free, pointer, now.degrees(), away, radius=size / 2.0 * scale, margin=margin)
        self._take_hold(context, wheel, Hand(now.pixel(wheel), pointer), scale)
        _show(wheel, region.as_pointer(), self._uid)
        self._held.gives_back(_hide)
        context.window_manager.modal_handler_add(self)
        self._show(context)
        return {"RUNNING_MODAL"}


def _show(wheel: Wheel, region: int, uid: int) -> None:
    """Begin to draw it."""
    global _shown
    _hide()
    _shown = _Shown(wheel, region, uid, bpy.types.SpaceView3D.draw_handler_add(_draw, (), "WINDOW", "POST_PIXEL"))


def _draw() -> None:
    """Draw handler: in pixels of the region."""
    context: Context = bpy.context
    region = context.region
    if _shown is None or region is None or region.as_pointer() != _shown.region:
        return
    obj = object_of(_shown.uid)
    if obj is None:
        return
    now = Choice.of(obj.risorius.emotion)
    draw_wheel(_shown.wheel, now, caption(now), scale_of(context), context.preferences.themes[0])


def _menu(menu: Menu, context: Context) -> None:
    """In the Object menu, where Blender's search finds it."""
    if no_face_reason(context) is None:
        menu.layout.operator_context = "INVOKE_REGION_WIN"
        menu.layout.separator()
        menu.layout.operator(RISORIUS_OT_pick_emotion.bl_idname)


def attach(undo: ExitStack) -> None:
    """Be in the menu until undone, and draw no longer than that."""
    undo.callback(_hide)
    bpy.types.VIEW3D_MT_object.append(_menu)
    undo.callback(bpy.types.VIEW3D_MT_object.remove, _menu)


def _hide() -> None:
    """Draw no more."""
    global _shown
    if _shown is not None:
        bpy.types.SpaceView3D.draw_handler_remove(_shown.handle, "WINDOW")
        _shown = None
