"""The panel that renders a film."""

from __future__ import annotations

from ..blender_classes import Panel
from ..blender_types import Context
from ..shapes.ops import RISORIUS_OT_make_shapes
from ..sidebar import MeshSidebar
from .ops import RISORIUS_OT_export_gltf, RISORIUS_OT_render_film


class RISORIUS_PT_film(MeshSidebar, Panel):
    """Where to, who draws, how large."""

    bl_label = "Render and Export"
    bl_parent_id = "RISORIUS_PT_main"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: Context) -> None:
        """The settings, then the button."""
        layout = self.layout
        layout.use_property_split, layout.use_property_decorate = True, False
        chosen = context.scene.risorius.film
        for name in ("path", "output", "engine", "camera", "frames"):
            layout.prop(chosen, name)
        column = layout.column(align=True)
        column.prop(chosen, "width")
        column.prop(chosen, "height")
        row = layout.row()
        row.scale_y = 1.3
        row.operator(RISORIUS_OT_render_film.bl_idname, icon="RENDER_ANIMATION")
        column = layout.column(align=True)
        column.prop(chosen, "model")
        column.prop(chosen, "morph_normals")
        column.operator(RISORIUS_OT_export_gltf.bl_idname, icon="EXPORT")
        shapes = context.scene.risorius.shapes
        column = layout.column(align=True)
        column.prop(shapes, "names")
        column.prop(shapes, "replace")
        column.operator(RISORIUS_OT_make_shapes.bl_idname, icon="SHAPEKEY_DATA")
