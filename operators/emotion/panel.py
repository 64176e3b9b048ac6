"""The panel where the emotion is chosen."""

from __future__ import annotations

import math
import textwrap

from ..active import active_object
from ..blender_classes import Panel
from ..blender_types import Context
from ..preview import live
from ..sidebar import LINE, MeshSidebar
from ..timeline.linked import linked_clip
from ..timeline.titles import clip_title
from ..wheel.panel import RISORIUS_PT_wheel
from ..wheel.places import between
from .ops import RISORIUS_OT_reset_activation
from .props import own_activation


class RISORIUS_PT_emotion(MeshSidebar, Panel):
    """Word, activation, variant, seed."""

    bl_label = "Emotion"
    bl_parent_id = "RISORIUS_PT_main"

    def draw(self, context: Context) -> None:
        """The choice, most important first."""
        layout = self.layout
        layout.use_property_split, layout.use_property_decorate = True, False
        emotion, preview = active_object(context).risorius.emotion, context.window_manager.risorius.preview
        layout.prop(preview, "show", icon="HIDE_OFF" if preview.show else "HIDE_ON", toggle=True)
        why = live.why_not(active_object(context))
        if why:
            box = layout.box().column(align=True)
            for line in textwrap.wrap(why, LINE):
                box.label(text=line)
        wheel = context.window_manager.risorius.wheel
        row = layout.row(align=True)
        row.prop(wheel, "show", icon="HIDE_OFF" if wheel.show else "HIDE_ON", toggle=True)
        row.popover(RISORIUS_PT_wheel.__name__, text="", icon="PREFERENCES")
        clip = linked_clip(active_object(context))
        if clip is not None:
            layout.label(text=f"Edits the clip {clip_title(clip)}", icon="LINKED")
        layout.row().prop(emotion, "by", expand=True)
        on_wheel = emotion.by == "WHEEL"
        layout.prop(emotion, "angle" if on_wheel else "word")
        column = layout.column(align=True)
        column.prop(emotion, "activation", slider=True)
        if not on_wheel:
            row = column.row(align=True)
            row.alignment = "RIGHT"
            row.label(text=f"{emotion.word.capitalize()}'s own: {own_activation(emotion.word):.1f}")
            row.operator(RISORIUS_OT_reset_activation.bl_idname, text="", icon="LOOP_BACK")
            layout.prop(emotion, "variant")
        else:
            row = column.row()
            row.alignment = "RIGHT"
            row.label(text=between(math.degrees(emotion.angle)).capitalize())
        layout.prop(emotion, "seed")
        layout.prop(emotion, "drive")
