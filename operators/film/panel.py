"""The panel that renders a film."""

from __future__ import annotations

from typing import Any

import bpy

from ..sidebar import Sidebar
from .ops import RISORIUS_OT_render_film


class RISORIUS_PT_film(Sidebar, bpy.types.Panel):
    """Where to, who draws, how large."""

    bl_label = "Film"
    bl_parent_id = "RISORIUS_PT_main"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Only for meshes."""
        return context.object is not None and context.object.type == "MESH"

    def draw(self, context: Any) -> None:
        """The settings, then the button."""
        layout = self.layout
        layout.use_property_split, layout.use_property_decorate = True, False
        chosen = context.scene.risorius.film
        for name in ("path", "engine", "size", "frames", "keep_pictures"):
            layout.prop(chosen, name)
        row = layout.row()
        row.scale_y = 1.3
        row.operator(RISORIUS_OT_render_film.bl_idname, icon="RENDER_ANIMATION")


CLASSES = (RISORIUS_PT_film,)
