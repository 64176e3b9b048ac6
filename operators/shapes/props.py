"""Which shape keys are made. Kept with the scene."""

import bpy


class RISORIUS_PG_shapes(bpy.types.PropertyGroup):
    """The names that the keys get."""

    names: bpy.props.EnumProperty(  # type: ignore[valid-type]
        name="Names",
        description="The names that the shape keys get, and the shapes that go by them",
        items=(
            ("arkit", "ARKit", "The 52 shapes of ARKit: jawOpen, mouthSmileLeft, ..."),
            ("oculus_visemes", "Oculus Visemes", "The 15 mouth shapes of speech: viseme_aa, viseme_PP, ..."),
            ("ict_facekit", "ICT FaceKit", "ARKit's shapes by ICT FaceKit's names: jawOpen, mouthSmile_L, ..."),
        ),
    )
    replace: bpy.props.BoolProperty(  # type: ignore[valid-type]
        name="Replace", description="Write over shape keys of the same names; otherwise they are refused"
    )
