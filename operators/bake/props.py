"""When and under what name an expression is baked."""

from __future__ import annotations

from typing import Annotated, Any

import bpy
from bpy.props import BoolProperty, FloatProperty, IntProperty, StringProperty

from ...mpeg4.timing import load_timings

_TIMING = load_timings()["natural"]


def seconds(name: str, description: str, default: float, **options: Any) -> Any:
    """A duration."""
    return FloatProperty(
        name=name, description=description, default=default, min=0.0, soft_max=10.0, step=5, precision=2, **options
    )


class RISORIUS_PG_bake(bpy.types.PropertyGroup):
    """Name and timing of the next bake."""

    clip: Annotated[
        str,
        StringProperty(
            name="Name",
            description="Name of the shape keys and the action. Empty: named after the emotion. "
            "What was baked under the same name is replaced",
        ),
    ]
    start: Annotated[
        int,
        IntProperty(name="Start Frame", description="Frame at which the expression begins to show", default=1),
    ]
    onset: Annotated[float, seconds("Onset (s)", "Seconds until the expression is full", _TIMING.onset)]
    apex: Annotated[float, seconds("Apex (s)", "Seconds that the expression is held", _TIMING.apex)]
    offset: Annotated[float, seconds("Offset (s)", "Seconds until the face is at rest again", _TIMING.offset)]
    creases: Annotated[
        bool,
        BoolProperty(
            name="Creases",
            description="With the next bake, mark on the mesh where squeezed skin wrinkles, and add a modifier that "
            "measures how much. Your materials stay as they are: add the shader node group Risorius Creases to one to "
            "see it. The default head's material has it. Off: the next bake takes all of that away",
            default=False,
        ),
    ]
