"""The wheel as a gizmo of every 3D viewport: Blender asks it what is under the pointer, draws it, and knows its keys.

The gizmo only shows and answers; clicks and keys over it run the operators of this folder.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import ExitStack
from typing import ClassVar

from ..active import active_object
from ..blender_classes import Gizmo, GizmoGroup
from ..blender_types import Context, KeyConfig, KeyMap
from ..gizmo_keys import forget_keymap
from .caption import caption, caption_at
from .choice import REACH, Choice
from .geometry import Pixel
from .ops import RISORIUS_OT_drag_emotion, RISORIUS_OT_nudge_emotion
from .picture import draw_wheel, forget_pictures
from .view import RIM, label_at, reason_hidden, scale_of, wheel_of

KEYMAP = "Risorius Emotion Wheel"
#: Degrees and activation of one press of an arrow key; with Shift, with Ctrl.
STEPS = {"": (2.0, 0.1), "shift": (0.5, 0.02), "ctrl": (15.0, 0.5)}


class RISORIUS_GT_wheel(Gizmo):
    """The emotion wheel"""

    bl_idname = "RISORIUS_GT_wheel"

    _pixel: Pixel | None = None
    _then: Choice | None = None

    def setup(self) -> None:
        """It is there while others are in use, and leaves the pointer alone."""
        self.use_draw_modal = True

    def test_select(self, context: Context, location: Sequence[int]) -> int:
        """Whether the pointer is over the wheel; remembers where."""
        wheel, pixel = wheel_of(context), (float(location[0]), float(location[1]))
        if wheel is None or not wheel.contains(pixel, RIM * scale_of(context)):
            return -1
        if pixel != self._pixel:
            self._pixel, self._then = pixel, Choice.of(active_object(context).risorius.emotion)
            if context.region is not None:
                context.region.tag_redraw()
        return 0

    def draw(self, context: Context) -> None:
        """Draw it in pixels of the region."""
        wheel = wheel_of(context)
        if wheel is None:
            return
        now, scale = Choice.of(active_object(context).risorius.emotion), scale_of(context)
        words = caption(now)
        if self.is_highlight and self._pixel is not None and now == self._then:  # else it is being dragged
            words = caption_at(wheel, self._pixel, REACH * scale, label_at(wheel, self._pixel, scale))
        draw_wheel(wheel, now, words, scale, context.preferences.themes[0])


class RISORIUS_GGT_wheel(GizmoGroup):
    """The emotion wheel in the corner of a viewport"""

    bl_idname = "RISORIUS_GGT_wheel"
    bl_label = "Emotion Wheel"
    bl_space_type = "VIEW_3D"
    bl_region_type = "WINDOW"
    bl_options: ClassVar = {"PERSISTENT", "SCALE"}

    @classmethod
    def poll(cls, context: Context) -> bool:
        """Where the wheel is switched on and there is a face."""
        return reason_hidden(context) is None

    @classmethod
    def setup_keymap(cls, keyconfig: KeyConfig) -> KeyMap:
        """Keys while the pointer is over the wheel."""
        keymap = keyconfig.keymaps.new(name=KEYMAP, space_type="VIEW_3D", region_type="WINDOW")
        items = keymap.keymap_items
        items.new(RISORIUS_OT_drag_emotion.bl_idname, "LEFTMOUSE", "PRESS", any=True)
        for modifier, (degrees, activation) in STEPS.items():
            held = {modifier: True} if modifier else {}
            for key, sign in (("LEFT_ARROW", 1.0), ("RIGHT_ARROW", -1.0)):
                nudge = items.new(RISORIUS_OT_nudge_emotion.bl_idname, key, "PRESS", repeat=True, **held)
                nudge.properties.turn = sign * degrees
            for key, sign in (("UP_ARROW", 1.0), ("DOWN_ARROW", -1.0)):
                nudge = items.new(RISORIUS_OT_nudge_emotion.bl_idname, key, "PRESS", repeat=True, **held)
                nudge.properties.strengthen = sign * activation
        return keymap

    def setup(self, context: Context) -> None:
        """Its one gizmo."""
        self.gizmos.new(RISORIUS_GT_wheel.bl_idname)


def attach(undo: ExitStack) -> None:
    """Blender puts the gizmo into every 3D viewport by itself; pictures and keys go when that is undone."""
    undo.callback(forget_pictures)
    undo.callback(forget_keymap, KEYMAP)
