"""The panel that speaks."""

from __future__ import annotations

from ..active import active_object
from ..blender_classes import Panel
from ..blender_types import Context
from ..sidebar import MeshSidebar
from .ops import RISORIUS_OT_speak


class RISORIUS_PT_speech(MeshSidebar, Panel):
    """What is said, how, and the button."""

    bl_label = "Speak"
    bl_parent_id = "RISORIUS_PT_main"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: Context) -> None:
        """A text with its voice, or timings with their sound; then how it is said."""
        layout, chosen = self.layout, active_object(context).risorius.speech
        layout.row().prop(chosen, "source", expand=True)
        layout.use_property_split, layout.use_property_decorate = True, False
        names = ("voice", "speed", "pitch") if chosen.source == "TEXT" else ("timings", "sound", "tier")
        if chosen.source == "TEXT":
            layout.row().prop(chosen, "text", text="", placeholder="What is said")
        column = layout.column(align=True)
        for name in names:
            column.prop(chosen, name)
        column = layout.column(align=True)
        for name in ("articulation", "jaw"):
            column.prop(chosen, name, slider=True)
        layout.prop(chosen, "with_feeling")
        if chosen.with_feeling:
            layout.prop(chosen, "lean", slider=True)
        row = layout.row()
        row.scale_y = 1.3
        row.operator(RISORIUS_OT_speak.bl_idname, icon="SPEAKER")
