"""What the last import had to assume, for the panel."""

from __future__ import annotations

from bpy.props import StringProperty

from ..annotated import Annotated
from ..blender_classes import PropertyGroup


class RISORIUS_PG_recording(PropertyGroup):
    """The last import of a face: its clip, and what was assumed and not read, a line each."""

    clip: Annotated[str, StringProperty(name="Clip", description="Clip of the last import")]
    said: Annotated[
        str,
        StringProperty(name="Assumed", description="What was assumed to read it, and what was not read, a line each"),
    ]
