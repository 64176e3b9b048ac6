"""Where all panels are: the 3D viewport's sidebar, tab Risorius."""

from __future__ import annotations

from typing import Any

#: Letters that fit on a line of the sidebar at its usual width.
LINE = 38


class Sidebar:
    """Mix into `bpy.types.Panel`."""

    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Risorius"
    layout: Any
