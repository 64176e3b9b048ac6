"""An operator that clears prepared faces."""

from __future__ import annotations

from ...errors import FormatError
from ..base import RisoriusOperator
from ..blender_classes import Operator
from ..blender_types import Context
from .folder import kept_folder


class RISORIUS_OT_clear_kept_faces(RisoriusOperator, Operator):
    """Delete all prepared faces. A face is prepared again when it is next shown"""

    bl_idname = "risorius.clear_kept_faces"
    bl_label = "Clear Prepared Faces"
    bl_options = {"REGISTER"}

    def run(self, context: Context) -> str:
        """Delete them."""
        from ...api import KeptFaces

        folder = kept_folder()
        entries = KeptFaces(folder).entries
        size = entries.size()
        try:
            count = entries.clear()
        except OSError as reason:
            raise FormatError(folder, f"cannot be cleared ({reason.strerror}): delete the folder yourself") from reason
        return f"Cleared {count} prepared faces, {size / 1e6:.0f} MB" if count else "There are no prepared faces"
