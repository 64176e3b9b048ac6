"""Dragging on the wheel, and moving its point by keys; one step of undo each."""

from __future__ import annotations

import math
from typing import Any

import bpy

from ..base import RisoriusOperator
from .caption import title_of
from .choice import REACH, Choice, Hand, choose_pixel, choose_word, strengthen, turn
from .geometry import Pixel
from .view import label_at, reason_hidden, redraw, scale_of, wheel_of

#: Pixels at a scale of 1 that a hand moves while it clicks on a label.
STILL = 4.0
HELP = "Ctrl: No Snapping to Words   Shift: Fine   Release: Choose   Esc, Right Mouse: Back"


class RISORIUS_OT_drag_emotion(bpy.types.Operator):
    """Choose an emotion by clicking or dragging on the emotion wheel"""

    bl_idname = "risorius.drag_emotion"
    bl_label = "Choose Emotion on the Wheel"
    bl_options = {"UNDO", "INTERNAL", "BLOCKING"}

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Where there is a wheel."""
        reason = reason_hidden(context)
        if reason is not None:
            cls.poll_message_set(reason)
        return reason is None

    def invoke(self, context: Any, event: Any) -> set[str]:
        """Take the point to the pointer; a click beside the wheel is for others."""
        wheel, pixel = wheel_of(context), (float(event.mouse_region_x), float(event.mouse_region_y))
        if wheel is None:
            return {"PASS_THROUGH"}
        self._wheel, self._obj, self._scale = wheel, context.object.name, scale_of(context)
        self._before = Choice.of(context.object.risorius.emotion)
        self._hand, self._clicked = Hand(pixel, pixel), None if event.ctrl else label_at(wheel, pixel, self._scale)
        if self._clicked is not None:
            choose_word(self._emotion(), self._clicked)
        else:
            self._choose(event)
        context.window_manager.modal_handler_add(self)
        self._show(context)
        return {"RUNNING_MODAL"}

    def modal(self, context: Any, event: Any) -> set[str]:
        """Follow the pointer; release to keep, Esc or the right button to have it back."""
        if self._obj not in bpy.data.objects:
            self._let_go(context)
            return {"CANCELLED"}
        if event.type == "MOUSEMOVE":
            pixel: Pixel = (float(event.mouse_region_x), float(event.mouse_region_y))
            if self._clicked is not None and math.dist(pixel, self._hand.pointer) > STILL * self._scale:
                self._clicked = None
            if pixel != self._hand.pointer and self._clicked is None:
                self._hand = self._hand.moved(pixel, fine=event.shift)
                self._choose(event)
                self._show(context)
        elif event.type in {"ESC", "RIGHTMOUSE"} and event.value == "PRESS":
            self._before.write(self._emotion())
            self._let_go(context)
            return {"CANCELLED"}
        elif event.type == "LEFTMOUSE" and event.value == "RELEASE":
            self._let_go(context)
            return {"CANCELLED"} if Choice.of(self._emotion()) == self._before else {"FINISHED"}
        return {"RUNNING_MODAL"}

    def _emotion(self) -> Any:
        """The emotion that is being chosen."""
        return bpy.data.objects[self._obj].risorius.emotion

    def _choose(self, event: Any) -> None:
        """Choose what is under the hand."""
        reach = 0.0 if event.ctrl else REACH * self._scale
        choose_pixel(self._emotion(), self._wheel, self._hand.at, reach=reach)

    def _show(self, context: Any) -> None:
        """Say in the status bar what is chosen and which keys there are."""
        context.workspace.status_text_set(f"{title_of(self._emotion())}   {HELP}")
        redraw()

    def _let_go(self, context: Any) -> None:
        """Give the status bar back."""
        if context.workspace is not None:
            context.workspace.status_text_set(None)
        redraw()

    def cancel(self, context: Any) -> None:
        """Blender ends the operator itself."""
        self._let_go(context)


class RISORIUS_OT_nudge_emotion(RisoriusOperator, bpy.types.Operator):
    """Move the point of the emotion wheel a little"""

    bl_idname = "risorius.nudge_emotion"
    bl_label = "Move on the Emotion Wheel"
    bl_options = {"UNDO_GROUPED", "INTERNAL"}
    bl_undo_group = "Move on the Emotion Wheel"
    needs_scipy = False

    turn: bpy.props.FloatProperty(  # type: ignore[valid-type]
        name="Turn",
        description="Degrees to turn the point around the centre, counter-clockwise",
        default=0.0,
        options={"SKIP_SAVE"},
    )
    strengthen: bpy.props.FloatProperty(  # type: ignore[valid-type]
        name="Strengthen",
        description="Activation to add, on the scale from 1 to 7",
        default=0.0,
        options={"SKIP_SAVE"},
    )

    @classmethod
    def refusal(cls, context: Any) -> str | None:
        """Where there is a wheel."""
        return reason_hidden(context)

    def run(self, context: Any) -> str:
        """Turn it, strengthen it."""
        emotion = context.object.risorius.emotion
        if self.turn:
            turn(emotion, self.turn)
        if self.strengthen:
            strengthen(emotion, self.strengthen)
        redraw()
        return title_of(emotion)


CLASSES = (RISORIUS_OT_drag_emotion, RISORIUS_OT_nudge_emotion)
