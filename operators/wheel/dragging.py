"""Following a hand over a wheel, until it chooses or gives up."""

from __future__ import annotations

import math
from typing import ClassVar

from ...scene.blender_types import Event
from ...scene.fingerprint import uid_of
from ..active import active_object, object_of
from ..blender_types import Context
from ..emotion.props import RISORIUS_PG_emotion
from ..held import Held
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
        obj = active_object(context)
        self._wheel, self._hand, self._scale, self._uid = wheel, hand, scale, uid_of(obj)
        self._before, self._clicked, self._held = Choice.of(obj.risorius.emotion), False, Held()
        self._held.gives_back(redraw_viewports)
        self._held.holds_status(context)

    def modal(self, context: Context, event: Event) -> set[str]:
        """Follow the pointer; the left button keeps, Esc or the right button to have it back."""
        if object_of(self._uid) is None:
            self._held.close()
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
            self._held.close()
            return {"CANCELLED"}
        elif event.type == "LEFTMOUSE" and event.value == self.chooses_on:
            self._held.close()
            return {"CANCELLED"} if Choice.of(self._emotion()) == self._before else {"FINISHED"}
        return {"RUNNING_MODAL"}

    def _emotion(self) -> RISORIUS_PG_emotion:
        """The emotion that is being chosen."""
        obj = object_of(self._uid)
        assert obj is not None
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

    def cancel(self, context: Context) -> None:
        """Blender ends the operator itself."""
        self._held.close()
