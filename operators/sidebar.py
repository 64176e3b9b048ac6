"""Where all panels are: the 3D viewport's sidebar, tab Risorius."""

from __future__ import annotations

from .blender_types import Context

#: Letters that fit on a line of the sidebar at its usual width.
LINE = 38


class Sidebar:
    """Mix into `bpy.types.Panel`."""

    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Risorius"


class MeshSidebar(Sidebar):
    """Mix into panels that are there only while a mesh is active."""

    @classmethod
    def poll(cls, context: Context) -> bool:
        """Only for meshes."""
        return context.object is not None and context.object.type == "MESH"
