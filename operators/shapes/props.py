"""Which shape keys are made. Kept with the scene."""

from __future__ import annotations

from typing import Annotated

import bpy
from bpy.props import BoolProperty, EnumProperty


class RISORIUS_PG_shapes(bpy.types.PropertyGroup):
    """The names that the keys get."""

    names: Annotated[
        str,
        EnumProperty(
            name="Names",
            description="The names that the shape keys get, and the shapes that go by them",
            items=(
                ("arkit", "ARKit", "The 52 shapes of ARKit: jawOpen, mouthSmileLeft, ..."),
                ("oculus_visemes", "Oculus Visemes", "The 15 mouth shapes of speech: viseme_aa, viseme_PP, ..."),
                ("ict_facekit", "ICT FaceKit", "ARKit's shapes by ICT FaceKit's names: jawOpen, mouthSmile_L, ..."),
            ),
        ),
    ]
    replace: Annotated[
        bool,
        BoolProperty(name="Replace", description="Write over shape keys of the same names; otherwise they are refused"),
    ]
