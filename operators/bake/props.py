"""When and under what name an expression is baked."""

from __future__ import annotations

from bpy.props import BoolProperty, FloatProperty, IntProperty, StringProperty

from ...mpeg4.timing import load_timings
from ..annotated import Annotated
from ..blender_classes import PropertyGroup

_TIMING = load_timings()["natural"]


def seconds(name: str, description: str, default: float, **options: object) -> object:
    """A duration."""
    return FloatProperty(
        name=name, description=description, default=default, min=0.0, soft_max=10.0, step=5, precision=2, **options
    )


class RISORIUS_PG_bake(PropertyGroup):
    """Name and timing of the next bake."""

    clip: Annotated[
        str,
        StringProperty(
            name="Name",
            description="Name of the shape keys and the action. Empty: the name of the emotion. A bake with the"
            " same name is replaced",
        ),
    ]
    start: Annotated[
        int,
        IntProperty(name="Start Frame", description="Frame at which the expression starts", default=1),
    ]
    onset: Annotated[float, seconds("Onset (s)", "Seconds from the start to the full expression", _TIMING.onset)]
    apex: Annotated[float, seconds("Apex (s)", "Seconds for which the expression is held", _TIMING.apex)]
    offset: Annotated[
        float, seconds("Offset (s)", "Seconds from the end of the apex to the neutral face", _TIMING.offset)
    ]
    creases: Annotated[
        bool,
        BoolProperty(
            name="Creases",
            description="Prepare wrinkles with the next bake: mark on the mesh where compressed skin creases, "
            "and add a modifier that measures how much. To see them, add the shader node group "
            "Risorius Creases to the material; the default head's material has it. If off, the next"
            " bake removes marks and modifier",
            default=False,
        ),
    ]
