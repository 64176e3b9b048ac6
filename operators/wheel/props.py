"""Whether the wheel is shown, where and how large; not saved with the file."""

from __future__ import annotations

from bpy.props import BoolProperty, EnumProperty, IntProperty

from ..annotated import Annotated
from ..blender_classes import PropertyGroup
from ..screen import redraw_viewports
from .geometry import Corner


class RISORIUS_PG_wheel(PropertyGroup):
    """The emotion wheel in the viewport."""

    show: Annotated[
        bool,
        BoolProperty(
            name="Emotion Wheel",
            description="Show the emotion wheel in the viewport. Click or drag in it to choose an emotion. The "
            "direction is the kind of emotion, the distance from the centre its activation",
            default=True,
            update=redraw_viewports,
        ),
    ]
    corner: Annotated[
        str,
        EnumProperty(
            name="Corner",
            description="Corner of the viewport for the wheel",
            items=tuple((corner.value, corner.value.replace("_", " ").title(), "") for corner in Corner),
            default=Corner.BOTTOM_LEFT.value,
            update=redraw_viewports,
        ),
    ]
    size: Annotated[
        int,
        IntProperty(
            name="Size",
            description="Diameter in pixels at an interface scale of 1. In a small viewport the wheel gets smaller",
            default=280,
            min=120,
            max=800,
            subtype="PIXEL",
            update=redraw_viewports,
        ),
    ]
