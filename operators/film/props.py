"""How a film is rendered and a model exported. Kept with the scene."""

from __future__ import annotations

from typing import Annotated

import bpy
from bpy.props import EnumProperty, IntProperty, StringProperty

#: From 4.5 on Blender wants to be told that "//" is understood.
_RELATIVE = {"PATH_SUPPORTS_BLEND_RELATIVE"} if bpy.app.version >= (4, 5) else set()


class RISORIUS_PG_film(bpy.types.PropertyGroup):
    """Where to, who draws, how large, which frames."""

    path: Annotated[
        str,
        StringProperty(
            name="File",
            description="The film to write. A name that begins with // lies beside the .blend file, or in your home "
            "folder where that was never saved",
            default="//risorius.mp4",
            subtype="FILE_PATH",
            options=_RELATIVE,
        ),
    ]
    engine: Annotated[
        str,
        EnumProperty(
            name="Engine",
            description="Who draws the film",
            items=(
                ("WORKBENCH", "Workbench", "Fast and plain: the face in its viewport colours"),
                ("EEVEE", "EEVEE", "With your materials and soft light; wants a graphics card"),
                ("CYCLES", "Cycles", "With your materials and real light; slow"),
            ),
            default="WORKBENCH",
        ),
    ]
    width: Annotated[
        int,
        IntProperty(
            name="Width", description="Width in pixels", default=720, min=64, max=8192, step=2, subtype="PIXEL"
        ),
    ]
    height: Annotated[
        int,
        IntProperty(
            name="Height", description="Height in pixels", default=720, min=64, max=8192, step=2, subtype="PIXEL"
        ),
    ]
    camera: Annotated[
        str,
        EnumProperty(
            name="Camera",
            description="Who looks at the face",
            items=(
                ("FACE", "On the Face", "A portrait camera with lights of its own; nothing but the face is seen"),
                ("SCENE", "Scene's Own", "The camera, lights, world and objects of your scene"),
            ),
            default="FACE",
        ),
    ]
    frames: Annotated[
        str,
        EnumProperty(
            name="Frames",
            description="Which frames to render",
            items=(
                ("CLIP", "Clip", "The frames of the clip that the face plays"),
                ("SCENE", "Scene", "The frame range of the scene"),
            ),
            default="CLIP",
        ),
    ]
    output: Annotated[
        str,
        EnumProperty(
            name="Output",
            description="What to write",
            items=(
                ("MP4", "MP4", "A film"),
                ("PNG", "Pictures", "A picture per frame, as PNG files in a folder named after the film"),
                ("BOTH", "Both", "A film, and a picture per frame"),
            ),
            default="MP4",
        ),
    ]
    model: Annotated[
        str,
        StringProperty(
            name="glTF",
            description="The glTF file to export the face with its clips to: .glb, or .gltf for separate files. A name "
            "that begins with // lies beside the .blend file, or in your home folder where that was never saved",
            default="//risorius.glb",
            subtype="FILE_PATH",
            options=_RELATIVE,
        ),
    ]
