"""The panel of the tissue, with Blender's own menu of presets."""

from __future__ import annotations

from ..active import active_object
from ..blender_classes import Panel, PresetPanel
from ..blender_types import Context
from ..sidebar import MeshSidebar
from .ops import FOLDER, RISORIUS_OT_add_tissue_preset
from .props import FIGURES, OWN


class RISORIUS_PT_tissue_presets(PresetPanel, Panel):
    """The user's tissues."""

    bl_label = "Tissue Presets"
    preset_subdir = FOLDER
    preset_operator = "script.execute_preset"
    preset_add_operator = RISORIUS_OT_add_tissue_preset.bl_idname


class RISORIUS_PT_tissue(MeshSidebar, Panel):
    """What the skin is made of."""

    bl_label = "Tissue"
    bl_parent_id = "RISORIUS_PT_muscles"
    bl_options = {"DEFAULT_CLOSED"}

    def draw_header_preset(self, context: Context) -> None:
        """Blender's button of presets."""
        RISORIUS_PT_tissue_presets.draw_panel_header(self.layout)

    def draw(self, context: Context) -> None:
        """The choice, and the figures where they are one's own."""
        layout, tissue = self.layout, active_object(context).risorius.tissue
        layout.use_property_split, layout.use_property_decorate = True, False
        layout.prop(tissue, "kind")
        if tissue.kind == OWN:
            column = layout.column(align=True)
            for name in FIGURES:
                column.prop(tissue, name)
