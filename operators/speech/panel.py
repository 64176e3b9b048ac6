"""The panels of speech: what is to be said, the strips that say it, and the words of one."""

from __future__ import annotations

from ..active import active_object
from ..blender_classes import Panel, UIList
from ..blender_types import Context, UILayout
from ..sidebar import MeshSidebar
from .props import RISORIUS_PG_speech
from .sharing import stray_sounds
from .strip_ops import (
    RISORIUS_OT_add_speech,
    RISORIUS_OT_fit_speech_sound,
    RISORIUS_OT_remove_speech,
    RISORIUS_OT_remove_stray_sounds,
    chosen_strip,
    sound_is_off,
)
from .strip_props import RISORIUS_PG_speech_strip
from .strips import length_of, shortened, title_of_strip, trouble_of

#: Rows of the list.
ROWS = 3


class RISORIUS_UL_speech(UIList):
    """Speech of the active face: name, first frame, mute."""

    def draw_item(
        self,
        context: Context,
        layout: UILayout,
        data: RISORIUS_PG_speech,
        item: RISORIUS_PG_speech_strip,
        icon: int,
        active_data: object,
        active_property: str,
    ) -> None:
        """One strip."""
        split = layout.split(factor=0.68, align=True)
        split.active = not item.mute
        split.label(text=title_of_strip(item), icon="SPEAKER" if item.sound is not None else "OUTLINER_DATA_FONT")
        row = split.row(align=True)
        row.label(text=str(item.start))
        row.prop(item, "mute", text="", icon="HIDE_ON" if item.mute else "HIDE_OFF", emboss=False)


class RISORIUS_PT_speech(MeshSidebar, Panel):
    """What is said, how, and the strips that say it."""

    bl_label = "Speak"
    bl_parent_id = "RISORIUS_PT_main"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: Context) -> None:
        """A text with its voice, or timings with their sound; then the strips, and how all of them are said."""
        layout, obj = self.layout, active_object(context)
        chosen = obj.risorius.speech
        layout.row().prop(chosen, "source", expand=True)
        layout.use_property_split, layout.use_property_decorate = True, False
        names = ("voice", "speed", "pitch") if chosen.source == "TEXT" else ("timings", "sound", "tier")
        if chosen.source == "TEXT":
            layout.row().prop(chosen, "text", text="", placeholder="What is said")
        column = layout.column(align=True)
        for name in names:
            column.prop(chosen, name)
        row = layout.row(align=True)
        row.scale_y = 1.3
        row.operator(RISORIUS_OT_add_speech.bl_idname, icon="ADD")
        self._draw_strays(layout, context)
        if not chosen.strips:
            return
        self._draw_strips(layout, context, chosen)
        column = layout.column(align=True)
        for name in ("articulation", "jaw", "lean"):
            column.prop(chosen, name, slider=True)
        if not obj.risorius.timeline.clips:
            layout.prop(chosen, "with_feeling")

    def _draw_strays(self, layout: UILayout, context: Context) -> None:
        """Sounds whose face is gone: they stay until the user removes them."""
        strays = stray_sounds(context.scene)
        if strays:
            names = shortened(", ".join(str(sound.name) for _, sound in strays))
            box = layout.box()
            box.label(text="Sounds without a face" if len(strays) > 1 else "Sound without a face", icon="INFO")
            box.label(text=names, icon="SPEAKER")
            box.operator(RISORIUS_OT_remove_stray_sounds.bl_idname, icon="X")

    def _draw_strips(self, layout: UILayout, context: Context, chosen: RISORIUS_PG_speech) -> None:
        """The list, and the times of the selected one."""
        row = layout.row()
        row.template_list("RISORIUS_UL_speech", "", chosen, "strips", chosen, "active", rows=ROWS)
        row.column(align=True).operator(RISORIUS_OT_remove_speech.bl_idname, text="", icon="REMOVE")
        strip = chosen_strip(active_object(context))
        if strip is None:
            return
        column = layout.column(align=True)
        column.prop(strip, "name", placeholder=title_of_strip(strip))
        column.prop(strip, "start")
        column.prop(strip, "stretch")
        trouble = trouble_of(strip)
        if trouble:
            layout.label(text=trouble, icon="ERROR")
        elif sound_is_off(strip):
            layout.operator(RISORIUS_OT_fit_speech_sound.bl_idname, icon="ERROR")
        layout.label(text=f"{length_of(strip):.2f} s", icon="TIME")
