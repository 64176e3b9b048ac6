"""Recordings dropped on the viewport."""

from __future__ import annotations

from ...face.tracked.formats import READABLE
from ..bake.destination import bake_reason
from ..blender_classes import FileHandler
from ..blender_types import Context
from .ops import RISORIUS_OT_import_fap


class RISORIUS_FH_fap(FileHandler):
    """Streams of FAPs and recordings of trackers dropped on the viewport"""

    bl_idname = "RISORIUS_FH_fap"
    bl_label = "Face Recording"
    bl_import_operator = RISORIUS_OT_import_fap.bl_idname
    bl_file_extensions = ";".join(READABLE)

    @classmethod
    def poll_drop(cls, context: Context) -> bool:
        """On a viewport, with a face on which it can be baked to what is chosen."""
        on_viewport = context.area is not None and context.area.type == "VIEW_3D"
        return on_viewport and bake_reason(context.object) is None
