"""The panel of the tissue, with Blender's own menu of presets."""

from __future__ import annotations

from typing import Any

import bpy
from bl_ui.utils import PresetPanel

from ..sidebar import Sidebar
from .ops import FOLDER, RISORIUS_OT_add_tissue_preset
from .props import FIGURES, OWN


class RISORIUS_PT_tissue_presets(PresetPanel, bpy.types.Panel):
    """The user's tissues."""

    bl_label = "Tissue Presets"
    preset_subdir = FOLDER
    preset_operator = "script.execute_preset"
    preset_add_operator = RISORIUS_OT_add_tissue_preset.bl_idname


class RISORIUS_PT_tissue(Sidebar, bpy.types.Panel):
    """What the skin is made of."""

    bl_label = "Tissue"
    bl_parent_id = "RISORIUS_PT_muscles"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Only for meshes."""
        return context.object is not None and context.object.type == "MESH"

    def draw_header_preset(self, context: Any) -> None:
        """Blender's button of presets."""
        RISORIUS_PT_tissue_presets.draw_panel_header(self.layout)

    def draw(self, context: Any) -> None:
        """The choice, and the figures where they are one's own."""
        layout, tissue = self.layout, context.object.risorius.tissue
        layout.use_property_split, layout.use_property_decorate = True, False
        layout.prop(tissue, "kind")
        if tissue.kind == OWN:
            column = layout.column(align=True)
            for name in FIGURES:
                column.prop(tissue, name)
