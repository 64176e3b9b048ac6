"""Which shape keys are made. Kept with the scene."""

from __future__ import annotations

from bpy.props import BoolProperty, EnumProperty

from ..annotated import Annotated
from ..blender_classes import PropertyGroup


class RISORIUS_PG_shapes(PropertyGroup):
    """The names that the keys get."""

    names: Annotated[
        str,
        EnumProperty(
            name="Names",
            description="Names of the shape keys, and the shapes that belong to them",
            items=(
                ("arkit", "ARKit", "The 52 shapes of ARKit: jawOpen, mouthSmileLeft, ..."),
                ("oculus_visemes", "Oculus Visemes", "The 15 mouth shapes of speech: viseme_aa, viseme_PP, ..."),
                ("vrm1", "VRM 1.0", "The 18 expressions of VRM characters: happy, aa, blinkLeft, lookUp, ..."),
                (
                    "arkit,oculus_visemes,talkinghead_extras",
                    "TalkingHead",
                    "What TalkingHead's avatars have: ARKit, Oculus Visemes, and mouthOpen, eyesClosed, ...",
                ),
                ("ict_facekit", "ICT FaceKit", "ARKit's shapes by ICT FaceKit's names: jawOpen, mouthSmile_L, ..."),
            ),
        ),
    ]
    replace: Annotated[
        bool,
        BoolProperty(
            name="Replace", description="Replace shape keys with the same names. If off, existing names are an error"
        ),
    ]
