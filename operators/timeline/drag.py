"""Clips and speech dragged about in a timeline editor: as a whole, or the end of one of their times."""

from __future__ import annotations

from contextlib import ExitStack
from dataclasses import dataclass

import bpy

from ...errors import RisoriusError
from ...scene.bake.timing import scene_fps
from ...scene.blender_types import Event
from ...scene.fingerprint import uid_of
from ..active import active_object, object_of
from ..blender_classes import Operator
from ..blender_types import Context, Object, Scene, WindowManager
from ..held import Held
from ..screen import redraw_timelines
from ..speech.bars import is_stretched, stretched_by
from ..speech.fitting import fit_sound
from ..speech.strips import length_of
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
    """Select a clip or speech and drag it in time. Drag a corner of a clip to change its onset, apex or offset, the \
end of speech to stretch it. Esc cancels"""

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
        (bar, grip), self._area, self._region = hit, area, region
        obj = active_object(context)
        self._dragged, self._uid, self._held = _Dragged.of(obj, bar.number, grip), uid_of(obj), Held()
        self._held.gives_back(area.header_text_set, None)
        self._from = self._frame(event)
        context.window_manager.modal_handler_add(self)
        redraw_timelines()
        return {"RUNNING_MODAL"}

    def modal(self, context: Context, event: Event) -> set[str]:
        """Follow the pointer until the button is let go."""
        obj = object_of(self._uid)
        if obj is None or self._held.is_outdated or not self._dragged.is_there(obj):
            self._held.close()
            return {"CANCELLED"}
        if event.type in {"ESC", "RIGHTMOUSE"} and event.value == "PRESS":
            self._dragged.undo(obj)
            self._held.close()
            return {"CANCELLED"}
        is_released = event.type == "LEFTMOUSE" and event.value == "RELEASE"
        if event.type == "MOUSEMOVE" or is_released:  # where it is let go counts, seen to move there or not
            said = self._dragged.by(obj, self._frame(event) - self._from, scene_fps(context.scene))
            self._area.header_text_set(f"{said}   Esc: Cancel")
        if is_released:
            self._held.close()
            try:
                self._dragged.finish(obj, context.scene)
            except RisoriusError as refusal:
                self.report({"WARNING"}, f"The sound keeps its length: {refusal}")
            return {"FINISHED"}
        return {"RUNNING_MODAL"}

    def cancel(self, context: Context) -> None:
        """Blender ends the operator itself."""
        self._held.close()

    def _frame(self, event: Event) -> float:
        """The frame under the pointer."""
        return float(self._region.view2d.region_to_view(event.mouse_region_x, 0)[0])


@dataclass(frozen=True)
class _Dragged:
    """What is dragged: which field of the clip or of the speech of a number, its value, and what was selected."""

    number: int
    grip: Grip
    field: str
    before: float
    was_active: int
    is_speech: bool

    @classmethod
    def of(cls, obj: Object, number: int, grip: Grip) -> _Dragged:
        """A bar's, which is selected with it."""
        timeline, speech = obj.risorius.timeline, obj.risorius.speech
        if number < len(timeline.clips):
            was, timeline.active = timeline.active, number
            return cls(number, grip, grip.value, getattr(timeline.clips[number], grip.value), was, is_speech=False)
        number -= len(timeline.clips)
        field = "stretch" if is_stretched(grip) else "start"
        was, speech.active = speech.active, number
        return cls(number, grip, field, getattr(speech.strips[number], field), was, is_speech=True)

    def is_there(self, obj: Object) -> bool:
        """Whether the object still has it."""
        return self.number < len(obj.risorius.speech.strips if self.is_speech else obj.risorius.timeline.clips)

    def _owner(self, obj: Object) -> object:
        """The clip or speech."""
        return obj.risorius.speech.strips[self.number] if self.is_speech else obj.risorius.timeline.clips[self.number]

    def by(self, obj: Object, frames: float, fps: float) -> str:
        """Drag it by so many frames; how it is now, in words."""
        if self.field == "stretch":
            strip = obj.risorius.speech.strips[self.number]
            strip.stretch = stretched_by(strip, self.before, frames, fps)
            return f"Stretch: {strip.stretch:.2f}, {length_of(strip):.2f} s"
        grip = Grip.START if self.is_speech else self.grip
        value = dragged(grip, self.before, frames, fps)
        self._set(obj, value)
        unit = f"frame {value:g}" if grip is Grip.START else f"{value:.2f} s"
        return f"{grip.value.capitalize()}: {unit}"

    def finish(self, obj: Object, scene: Scene) -> None:
        """It stays so; the sound of speech becomes as long."""
        if self.field == "stretch":
            fit_sound(scene, obj.risorius.speech.strips[self.number])

    def undo(self, obj: Object) -> None:
        """As it was."""
        self._set(obj, self.before)
        (obj.risorius.speech if self.is_speech else obj.risorius.timeline).active = self.was_active

    def _set(self, obj: Object, value: float) -> None:
        """Set what is dragged."""
        setattr(self._owner(obj), self.field, int(value) if self.field == "start" else value)


def attach(undo: ExitStack) -> None:
    """Until undone, a press of the left button in timeline editors looks for a clip first."""
    manager: WindowManager | None = bpy.context.window_manager
    configs = manager.keyconfigs.addon if manager is not None else None
    if configs is not None:
        keymap = configs.keymaps.new("Dopesheet", space_type="DOPESHEET_EDITOR")
        item = keymap.keymap_items.new(RISORIUS_OT_drag_clip.bl_idname, "LEFTMOUSE", "PRESS", head=True)
        undo.callback(keymap.keymap_items.remove, item)
