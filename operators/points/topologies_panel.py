"""The panel of known topologies: meshes whose feature points need not be searched."""

from __future__ import annotations

from ...scene.points.presets import preset_names, shipped_names
from ..blender_classes import Panel
from ..blender_types import Context
from ..requirements import has_scipy
from ..sidebar import MeshSidebar
from .topologies import RISORIUS_OT_remove_topology, RISORIUS_OT_save_topology


class RISORIUS_PT_topologies(MeshSidebar, Panel):
    """Which meshes are known by their polygons."""

    bl_label = "Known Topologies"
    bl_parent_id = "RISORIUS_PT_points"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: Context) -> None:
        """Save this one; those that were saved, and those that Risorius brings."""
        layout = self.layout
        layout.operator(RISORIUS_OT_save_topology.bl_idname, icon="FILE_TICK")
        if not has_scipy():
            return
        column = layout.column(align=True)
        for file, name in preset_names().items():
            row = column.row(align=True)
            row.label(text=name, icon="USER")
            row.operator(RISORIUS_OT_remove_topology.bl_idname, text="", icon="X").file = file
        for name in shipped_names():
            column.label(text=name, icon="MESH_GRID")
