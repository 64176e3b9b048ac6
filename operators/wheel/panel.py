"""Where the wheel is and how large, behind a button beside its switch."""

from __future__ import annotations

from ..blender_classes import Panel
from ..blender_types import Context


class RISORIUS_PT_wheel(Panel):
    """Corner and size of the emotion wheel"""

    bl_label = "Emotion Wheel"
    bl_space_type = "VIEW_3D"
    bl_region_type = "HEADER"
    bl_options = {"INSTANCED"}

    @classmethod
    def poll(cls, context: Context) -> bool:
        """Only for meshes."""
        return context.object is not None and context.object.type == "MESH"

    def draw(self, context: Context) -> None:
        """Place, then size."""
        layout = self.layout
        layout.use_property_split, layout.use_property_decorate = True, False
        wheel = context.window_manager.risorius.wheel
        column = layout.column()
        column.enabled = wheel.show
        column.prop(wheel, "corner")
        column.prop(wheel, "size")
