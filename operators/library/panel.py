"""The menu of presets, and what may be dropped on the viewport."""

from __future__ import annotations

import bpy

from ...mpeg4.preset_file import PresetKind
from ..active import face_reason
from ..blender_classes import FileHandler, Menu
from ..blender_types import Context
from ..recording.ops import RISORIUS_OT_import_fap
from .exchange import BUNDLED, preset_files
from .ops import RISORIUS_OT_load_preset, RISORIUS_OT_save_preset


class RISORIUS_MT_library(Menu):
    """Load or save expressions and timelines"""

    bl_idname = "RISORIUS_MT_library"
    bl_label = "Presets"

    def draw(self, context: Context) -> None:
        """Yours, those that come with Risorius, and ways in and out."""
        layout, files = self.layout, preset_files()
        for number, path in enumerate(files):
            if number and path.parent == BUNDLED != files[number - 1].parent:
                layout.separator()
            text = bpy.path.display_name(path.stem)
            layout.operator(RISORIUS_OT_load_preset.bl_idname, text=text).filepath = str(path)
        layout.separator()
        for kind, text in ((PresetKind.EXPRESSION, "Save Expression..."), (PresetKind.TIMELINE, "Save Timeline...")):
            layout.operator(RISORIUS_OT_save_preset.bl_idname, text=text, icon="ADD").kind = kind.value
        layout.separator()
        # Left over from a preset above, the path would be loaded instead of asked for.
        layout.operator(RISORIUS_OT_load_preset.bl_idname, text="Load from File...", icon="FILE_FOLDER").filepath = ""
        layout.operator(RISORIUS_OT_import_fap.bl_idname, text="Import Recording...", icon="IMPORT").filepath = ""


class RISORIUS_FH_preset(FileHandler):
    """Presets dropped on the viewport"""

    bl_idname = "RISORIUS_FH_preset"
    bl_label = "Risorius Preset"
    bl_import_operator = RISORIUS_OT_load_preset.bl_idname
    bl_file_extensions = ".toml"

    @classmethod
    def poll_drop(cls, context: Context) -> bool:
        """On a viewport, with a face to load it on."""
        return context.area is not None and context.area.type == "VIEW_3D" and face_reason(context.object) is None
