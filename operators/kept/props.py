"""Whether prepared faces are kept: a setting of the user, not of a file."""

from __future__ import annotations

from bpy.props import BoolProperty

from ...scene import faces
from ..annotated import Annotated
from ..blender_classes import AddonPreferences
from ..blender_types import Context, UILayout
from .folder import PACKAGE, kept_folder


class RISORIUS_AP_preferences(AddonPreferences):
    """Risorius in Blender's preferences."""

    bl_idname = PACKAGE
    layout: UILayout

    keep_faces: Annotated[
        bool,
        BoolProperty(
            name="Keep Prepared Faces",
            description="Keep what was worked out for a face on this computer, so that the face shows at once when its "
            "file is opened again. A gigabyte is used at most; the faces that were not used for longest are deleted",
            default=True,
        ),
    ]

    def draw(self, context: Context) -> None:
        """The setting, where faces are kept, and the way to be rid of them."""
        self.layout.prop(self, "keep_faces")
        column = self.layout.column()
        column.label(text=str(kept_folder()))
        if faces.keeping_trouble():
            column.label(text=faces.keeping_trouble(), icon="ERROR")
        column.operator("risorius.clear_kept_faces")
