"""When, under what name and to what an expression is baked."""

from __future__ import annotations

from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty

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
    """Name, destination and timing of the next bake."""

    clip: Annotated[
        str,
        StringProperty(
            name="Name",
            description="Name of the shape keys and the action. Empty: the name of the emotion. A bake with the"
            " same name is replaced",
        ),
    ]
    onto: Annotated[
        str,
        EnumProperty(
            name="Bake To",
            description="What the next bake keys",
            items=(
                (
                    "NEW",
                    "New Keys",
                    "Add new shape keys that show exactly what the muscles do. Your own keys stay as they are",
                ),
                (
                    "KEYS",
                    "My Keys",
                    "Animate the shape keys that the face already has, whatever their names. No key is added or "
                    "changed. Shows what these keys can show",
                ),
                (
                    "BONES",
                    "My Bones",
                    "Animate the bones and custom properties of the rig that the face already has. No shape key is "
                    "added. Shows what these bones can show",
                ),
            ),
            default="NEW",
        ),
    ]
    above: Annotated[
        bool,
        BoolProperty(
            name="On Top",
            description="Play on top of the animation that is there, as a layer that can be taken off again. If off, "
            "write the keyframes into the action that plays, in place of its own between the first and the last",
            default=True,
        ),
    ]
    symmetric: Annotated[
        bool,
        BoolProperty(
            name="Symmetric",
            description="Give left and right controls the same value, even where the expression is uneven",
            default=False,
        ),
    ]
    smooth: Annotated[
        float,
        FloatProperty(
            name="Smooth",
            description="How smooth a baked motion is over time. 1 suits most motions, 0 computes each frame by itself",
            default=1.0,
            min=0.0,
            soft_max=10.0,
            precision=2,
        ),
    ]
    max_keys: Annotated[
        int,
        IntProperty(
            name="Max Keys",
            description="Shape keys that a baked motion may have. Engines limit them. The best ones are taken, and the "
            "bake says how far the motion is off. 0: as many as it takes",
            default=0,
            min=0,
            soft_max=100,
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
