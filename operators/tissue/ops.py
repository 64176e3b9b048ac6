"""Saving the figures of a tissue as one of Blender's presets."""

from __future__ import annotations

from ..blender_classes import AddPresetBase, Operator
from .props import FIGURES

FOLDER = "risorius/tissue"


class RISORIUS_OT_add_tissue_preset(AddPresetBase, Operator):
    """Save these values as a preset, or remove the selected preset"""

    bl_idname = "risorius.add_tissue_preset"
    bl_label = "Add Tissue Preset"

    preset_menu = "RISORIUS_PT_tissue_presets"
    preset_subdir = FOLDER
    preset_defines = ["tissue = bpy.context.object.risorius.tissue"]
    preset_values = [f"tissue.{name}" for name in FIGURES]
