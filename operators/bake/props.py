"""When and under what name an expression is baked."""

import bpy

from ...mpeg4.timing import load_timings

_TIMING = load_timings()["natural"]


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
    onset: bpy.props.FloatProperty(  # type: ignore[valid-type]
        name="Onset", description="Seconds until the expression is full", default=_TIMING.onset, min=0.0, soft_max=5.0,
        step=5, subtype="TIME_ABSOLUTE", unit="TIME_ABSOLUTE",
    )  # fmt: skip
    apex: bpy.props.FloatProperty(  # type: ignore[valid-type]
        name="Apex", description="Seconds that the expression is held", default=_TIMING.apex, min=0.0, soft_max=10.0,
        step=5, subtype="TIME_ABSOLUTE", unit="TIME_ABSOLUTE",
    )  # fmt: skip
    offset: bpy.props.FloatProperty(  # type: ignore[valid-type]
        name="Offset", description="Seconds until the face is at rest again", default=_TIMING.offset, min=0.0,
        soft_max=5.0, step=5, subtype="TIME_ABSOLUTE", unit="TIME_ABSOLUTE",
    )  # fmt: skip


CLASSES = (RISORIUS_PG_bake,)
