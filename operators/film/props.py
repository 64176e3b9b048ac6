"""How a film is rendered. Kept with the scene."""

import bpy

#: From 4.5 on Blender wants to be told that "//" is understood.
_RELATIVE = {"PATH_SUPPORTS_BLEND_RELATIVE"} if bpy.app.version >= (4, 5) else set()


class RISORIUS_PG_film(bpy.types.PropertyGroup):
    """Where to, who draws, how large, which frames."""

    path: bpy.props.StringProperty(  # type: ignore[valid-type]
        name="File",
        description="The film to write, an MP4",
        default="//risorius.mp4",
        subtype="FILE_PATH",
        options=_RELATIVE,
    )
    engine: bpy.props.EnumProperty(  # type: ignore[valid-type]
        name="Engine",
        description="Who draws the film",
        items=(
            ("WORKBENCH", "Workbench", "Fast and plain: the face in its viewport colours"),
            ("EEVEE", "EEVEE", "With your materials and soft light; wants a graphics card"),
            ("CYCLES", "Cycles", "With your materials and real light; slow"),
        ),
        default="WORKBENCH",
    )
    size: bpy.props.IntProperty(  # type: ignore[valid-type]
        name="Size", description="Width and height in pixels", default=720, min=64, max=4096, step=2, subtype="PIXEL"
    )
    frames: bpy.props.EnumProperty(  # type: ignore[valid-type]
        name="Frames",
        description="Which frames to render",
        items=(
            ("CLIP", "Clip", "The frames of the clip that the face plays"),
            ("SCENE", "Scene", "The frame range of the scene"),
        ),
        default="CLIP",
    )
    keep_pictures: bpy.props.BoolProperty(  # type: ignore[valid-type]
        name="Keep Pictures", description="Keep the frames as PNG files too, in a folder named after the film"
    )


CLASSES = (RISORIUS_PG_film,)
