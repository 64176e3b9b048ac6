"""How feature points are shown and corrected. Kept with the window, not with the file: the points are the mesh's."""

from __future__ import annotations

from bpy.props import BoolProperty, CollectionProperty, EnumProperty, IntProperty

from ...mpeg4 import FEATURE_POINTS
from ..annotated import Annotated
from ..blender_classes import PropertyGroup
from ..blender_types import Entries
from ..names import fill, fill_soon, shown_lists
from ..screen import redraw_viewports


class RISORIUS_PG_point_name(PropertyGroup):
    """One of the standard's feature points, by its name: what the list shows, whichever of them a mesh has."""


class RISORIUS_PG_points(PropertyGroup):
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
            update=redraw_viewports,
        ),
    ]
    show: Annotated[
        bool,
        BoolProperty(
            name="Show Points",
            description="Draw the feature points on the face",
            default=False,
            update=redraw_viewports,
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
            update=redraw_viewports,
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
        BoolProperty(
            name="Doubtful Only", description="List and draw only points with low confidence", update=redraw_viewports
        ),
    ]


def active_name(state: RISORIUS_PG_points) -> str | None:
    """The name of the marked point."""
    return str(state.names[state.active].name) if state.active < len(state.names) else None


def mark(state: RISORIUS_PG_points, name: str) -> None:
    """Mark a point in the list and on the face."""
    list_names()
    index = state.names.find(name)
    if index >= 0:
        state.active = index


def list_names() -> None:
    """Fill the list with the standard's names."""
    for shown in shown_lists():
        fill(shown.points.names, FEATURE_POINTS)


def list_names_soon() -> None:
    """Fill the list after drawing."""
    fill_soon(list_names)
