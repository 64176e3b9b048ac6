"""How a film is rendered and a model exported. Kept with the scene."""

from __future__ import annotations

import bpy
from bpy.props import BoolProperty, EnumProperty, IntProperty, StringProperty

from ..annotated import Annotated
from ..blender_classes import PropertyGroup

#: From 4.5 on Blender wants to be told that "//" is understood.
_RELATIVE = {"PATH_SUPPORTS_BLEND_RELATIVE"} if bpy.app.version >= (4, 5) else set()


class RISORIUS_PG_film(PropertyGroup):
    """Where to, who draws, how large, which frames."""

    path: Annotated[
        str,
        StringProperty(
            name="File",
            description="Video file to write. A path that begins with // is relative to the .blend file, or to "
            "your home folder if the .blend file was never saved",
            default="//risorius.mp4",
            subtype="FILE_PATH",
            options=_RELATIVE,
        ),
    ]
    engine: Annotated[
        str,
        EnumProperty(
            name="Engine",
            description="Render engine for the video",
            items=(
                ("WORKBENCH", "Workbench", "Fast: the face in its viewport colours"),
                ("EEVEE", "EEVEE", "Your materials and soft light; needs a graphics card"),
                ("CYCLES", "Cycles", "Your materials and realistic light; slow"),
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
            description="Camera to render from",
            items=(
                ("FACE", "Portrait", "Use a portrait camera with its own lights; only the face is rendered"),
                ("SCENE", "Scene", "Use the camera, lights, world and objects of your scene"),
            ),
            default="FACE",
        ),
    ]
    frames: Annotated[
        str,
        EnumProperty(
            name="Frames",
            description="Frames to render",
            items=(
                ("CLIP", "Clip", "Render the frames of the animation that the face plays"),
                ("SCENE", "Scene", "Render the frame range of the scene"),
            ),
            default="CLIP",
        ),
    ]
    output: Annotated[
        str,
        EnumProperty(
            name="Output",
            description="Files to write",
            items=(
                ("MP4", "Video", "Write a video"),
                ("PNG", "Images", "Write an image per frame, as PNG files in a folder named after the video"),
                ("BOTH", "Both", "Write a video, and an image per frame"),
            ),
            default="MP4",
        ),
    ]
    model: Annotated[
        str,
        StringProperty(
            name="glTF",
            description="glTF file for the face with its clips: .glb, or .gltf for separate files. A path that "
            "begins with // is relative to the .blend file, or to your home folder if the .blend "
            "file was never saved",
            default="//risorius.glb",
            subtype="FILE_PATH",
            options=_RELATIVE,
        ),
    ]
    morph_normals: Annotated[
        bool,
        BoolProperty(
            name="Morph Normals",
            description="Let morph targets move the normals, too. Folds are shaded correctly, but the file is larger",
        ),
    ]
