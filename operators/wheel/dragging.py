"""Following a hand over a wheel, until it chooses or gives up."""

from __future__ import annotations

import math
from typing import ClassVar

import bpy

from ...scene.blender_types import Event
from ..active import active_object
from ..blender_types import Context, Object
from ..emotion.props import RISORIUS_PG_emotion
from ..screen import redraw_viewports, show_status
from .caption import title_of
from .choice import REACH, Choice, Hand, choose_pixel
from .geometry import Pixel, Wheel

#: Pixels at a scale of 1 that a hand moves while it clicks on a label.
STILL = 4.0


class Dragging:
    """Mix into `bpy.types.Operator`: its invoke calls `_take_hold`, and the rest follows here."""

    #: What the left button does when the choice is made, and how the status bar says so.
    chooses_on: ClassVar[str] = "RELEASE"
    chooses_by: ClassVar[str] = "Release"

    def _take_hold(self, context: Context, wheel: Wheel, hand: Hand, scale: float) -> None:
        """Remember what there is, to be able to put it back."""
        self._wheel, self._hand, self._scale, self._obj = wheel, hand, scale, active_object(context).name
        self._before, self._clicked = Choice.of(active_object(context).risorius.emotion), False

    def modal(self, context: Context, event: Event) -> set[str]:
        """Follow the pointer; the left button keeps, Esc or the right button to have it back."""
        if self._obj not in bpy.data.objects:
            self._let_go(context)
            return {"CANCELLED"}
        if event.type == "MOUSEMOVE":
            pixel: Pixel = (float(event.mouse_region_x), float(event.mouse_region_y))
            if self._clicked and math.dist(pixel, self._hand.pointer) > STILL * self._scale:
                self._clicked = False
            if pixel != self._hand.pointer and not self._clicked:
                self._hand = self._hand.moved(pixel, fine=event.shift)
                self._choose(event)
                self._show(context)
        elif event.type in {"ESC", "RIGHTMOUSE"} and event.value == "PRESS":
            self._before.write(self._emotion())
            self._let_go(context)
            return {"CANCELLED"}
        elif event.type == "LEFTMOUSE" and event.value == self.chooses_on:
            self._let_go(context)
            return {"CANCELLED"} if Choice.of(self._emotion()) == self._before else {"FINISHED"}
        return {"RUNNING_MODAL"}

    def _emotion(self) -> RISORIUS_PG_emotion:
        """The emotion that is being chosen."""
        obj: Object = bpy.data.objects[self._obj]
        return obj.risorius.emotion

    def _choose(self, event: Event) -> None:
        """Choose what is under the hand."""
        reach = 0.0 if event.ctrl else REACH * self._scale
        choose_pixel(self._emotion(), self._wheel, self._hand.at, reach=reach)

    def _show(self, context: Context) -> None:
        """Say in the status bar what is chosen and which keys there are."""
        show_status(context, f"{title_of(self._emotion())}   {self._help()}")
        redraw_viewports()

    def _help(self) -> str:
        """Keys."""
        return f"Ctrl: No Snapping to Words   Shift: Fine   {self.chooses_by}: Choose   Esc, Right Mouse: Cancel"

    def _let_go(self, context: Context) -> None:
        """Give the status bar back."""
        show_status(context, None)
        redraw_viewports()

    def cancel(self, context: Context) -> None:
        """Blender ends the operator itself."""
        self._let_go(context)
