"""How feature points are shown and corrected. Kept with the window, not with the file: the points are the mesh's."""

from __future__ import annotations

from typing import Any

import bpy
from bpy.props import BoolProperty, CollectionProperty, EnumProperty, IntProperty

from ...mpeg4 import FEATURE_POINTS
from ..annotated import Annotated
from ..blender_types import Entries


def redraw(owner: Any = None, context: Any = None) -> None:
    """Draw all 3D viewports again."""
    manager = bpy.context.window_manager
    for window in manager.windows if manager is not None else ():
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                area.tag_redraw()


class RISORIUS_PG_point_name(bpy.types.PropertyGroup):
    """One of the standard's feature points, by its name: what the list shows, whichever of them a mesh has."""


class RISORIUS_PG_points(bpy.types.PropertyGroup):
    """What the overlay and the list of feature points show."""

    names: Annotated[
        Entries[RISORIUS_PG_point_name],
        CollectionProperty(
            type=RISORIUS_PG_point_name, name="Points", description="All feature points of the standard"
        ),
    ]
    active: Annotated[
        int,
        IntProperty(
            name="Feature Point",
            description="Selected point; it is marked on the face",
            default=0,
            min=0,
            update=redraw,
        ),
    ]
    show: Annotated[
        bool,
        BoolProperty(
            name="Show Points", description="Draw the feature points on the face", default=False, update=redraw
        ),
    ]
    labels: Annotated[
        str,
        EnumProperty(
            name="Labels",
            description="Text beside the points; the selected point always shows its name",
            items=(
                ("NONE", "None", "Show no labels"),
                ("NUMBERS", "Numbers", "Show the numbers of the standard, such as 8.4"),
                ("PLACES", "Places", "Show numbers and places in words"),
            ),
            default="NUMBERS",
            update=redraw,
        ),
    ]
    mirror: Annotated[
        bool,
        BoolProperty(
            name="Mirror",
            description="Move the matching point on the other side along with a clicked or dragged point",
            default=True,
        ),
    ]
    doubtful_only: Annotated[
        bool,
        BoolProperty(name="Doubtful Only", description="List and draw only points with low confidence", update=redraw),
    ]


def active_name(state: Any) -> str | None:
    """The name of the marked point."""
    return str(state.names[state.active].name) if state.active < len(state.names) else None


def mark(state: Any, name: str) -> None:
    """Mark a point in the list and on the face."""
    list_names()
    index = state.names.find(name)
    if index >= 0:
        state.active = index


def list_names() -> None:
    """Fill the list with the standard's names; after a file was opened the window's properties are empty."""
    if not hasattr(bpy.types.WindowManager, "risorius"):
        return
    for manager in bpy.data.window_managers:
        names = manager.risorius.points.names
        if len(names) != len(FEATURE_POINTS):
            names.clear()
            for name in FEATURE_POINTS:
                names.add().name = name


def list_names_soon() -> None:
    """Fill the list after drawing, where nothing may be written. (A load handler makes bpy 4.5 hang at exit.)"""
    if not bpy.app.background and not bpy.app.timers.is_registered(list_names):
        bpy.app.timers.register(list_names, first_interval=0.0)
