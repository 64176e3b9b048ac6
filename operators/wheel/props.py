"""Whether the wheel is shown, where and how large; not saved with the file."""

from __future__ import annotations

from typing import Any

import bpy
from bpy.props import BoolProperty, EnumProperty, IntProperty

from ..annotated import Annotated
from .geometry import Corner
from .view import redraw


def _shown_otherwise(owner: Any, context: Any) -> None:
    """Draw the viewports anew."""
    redraw()


class RISORIUS_PG_wheel(bpy.types.PropertyGroup):
    """The emotion wheel in the viewport."""

    show: Annotated[
        bool,
        BoolProperty(
            name="Emotion Wheel",
            description="Show the emotion wheel in the viewport. Click or drag in it to choose an emotion. The "
            "direction is the kind of emotion, the distance from the centre its activation",
            default=True,
            update=_shown_otherwise,
        ),
    ]
    corner: Annotated[
        str,
        EnumProperty(
            name="Corner",
            description="Corner of the viewport for the wheel",
            items=tuple((corner.value, corner.value.replace("_", " ").title(), "") for corner in Corner),
            default=Corner.BOTTOM_LEFT.value,
            update=_shown_otherwise,
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
            update=_shown_otherwise,
        ),
    ]
