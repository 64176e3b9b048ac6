"""Dragging on the wheel, and moving its point by keys; one step of undo each."""

from __future__ import annotations

from bpy.props import FloatProperty

from ...scene.blender_types import Event
from ..active import active_object
from ..annotated import Annotated
from ..base import RisoriusOperator
from ..blender_classes import Operator
from ..blender_types import Context
from ..screen import redraw_viewports
from .caption import title_of
from .choice import Hand, choose_word, strengthen, turn
from .dragging import Dragging
from .view import label_at, reason_hidden, scale_of, wheel_of


class RISORIUS_OT_drag_emotion(Dragging, Operator):
    """Choose an emotion by clicking or dragging on the emotion wheel"""

    bl_idname = "risorius.drag_emotion"
    bl_label = "Choose Emotion on Wheel"
    bl_options = {"UNDO", "INTERNAL", "BLOCKING"}

    @classmethod
    def poll(cls, context: Context) -> bool:
        """Where there is a wheel."""
        reason = reason_hidden(context)
        if reason is not None:
            cls.poll_message_set(reason)
        return reason is None

    def invoke(self, context: Context, event: Event) -> set[str]:
        """Take the point to the pointer; a click beside the wheel is for others."""
        wheel, pixel = wheel_of(context), (float(event.mouse_region_x), float(event.mouse_region_y))
        if wheel is None:
            return {"PASS_THROUGH"}
        self._take_hold(context, wheel, Hand(pixel, pixel), scale_of(context))
        word = None if event.ctrl else label_at(wheel, pixel, self._scale)
        if word is not None:
            self._clicked = True
            choose_word(self._emotion(), word)
        else:
            self._choose(event)
        context.window_manager.modal_handler_add(self)
        self._show(context)
        return {"RUNNING_MODAL"}


class RISORIUS_OT_nudge_emotion(RisoriusOperator, Operator):
    """Move the point of the emotion wheel a little"""

    bl_idname = "risorius.nudge_emotion"
    bl_label = "Move on Emotion Wheel"
    bl_options = {"UNDO_GROUPED", "INTERNAL"}
    bl_undo_group = "Move on Emotion Wheel"
    needs_scipy = False

    turn: Annotated[
        float,
        FloatProperty(
            name="Turn",
            description="Degrees to turn the point around the centre, counter-clockwise",
            default=0.0,
            options={"SKIP_SAVE"},
        ),
    ]
    strengthen: Annotated[
        float,
        FloatProperty(
            name="Strengthen",
            description="Activation to add, on the scale from 1 to 7",
            default=0.0,
            options={"SKIP_SAVE"},
        ),
    ]

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Where there is a wheel."""
        return reason_hidden(context)

    def run(self, context: Context) -> str:
        """Turn it, strengthen it."""
        emotion = active_object(context).risorius.emotion
        if self.turn:
            turn(emotion, self.turn)
        if self.strengthen:
            strengthen(emotion, self.strengthen)
        redraw_viewports()
        return title_of(emotion)
