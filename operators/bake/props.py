"""When and under what name an expression is baked."""

from typing import Any

import bpy

from ...mpeg4.timing import load_timings

_TIMING = load_timings()["natural"]


def seconds(name: str, description: str, default: float, **options: Any) -> Any:
    """A duration."""
    return bpy.props.FloatProperty(
        name=name, description=description, default=default, min=0.0, soft_max=10.0, step=5, precision=2, **options
    )


class RISORIUS_PG_bake(bpy.types.PropertyGroup):
    """Name and timing of the next bake."""

    clip: bpy.props.StringProperty(  # type: ignore[valid-type]
        name="Name",
        description="Name of the shape keys and the action. Empty: named after the emotion. "
        "What was baked under the same name is replaced",
    )
    start: bpy.props.IntProperty(  # type: ignore[valid-type]
        name="Start Frame", description="Frame at which the expression begins to show", default=1
    )
    onset: seconds("Onset (s)", "Seconds until the expression is full", _TIMING.onset)  # type: ignore[valid-type]
    apex: seconds("Apex (s)", "Seconds that the expression is held", _TIMING.apex)  # type: ignore[valid-type]
    offset: seconds("Offset (s)", "Seconds until the face is at rest again", _TIMING.offset)  # type: ignore[valid-type]
    creases: bpy.props.BoolProperty(  # type: ignore[valid-type]
        name="Creases",
        description="With the next bake, mark on the mesh where squeezed skin wrinkles, and add a modifier that "
        "measures how much. Your materials stay as they are: add the shader node group Risorius Creases to one to see "
        "it. The default head's material has it. Off: the next bake takes all of that away",
        default=False,
    )
