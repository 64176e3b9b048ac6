"""What is drawn over the face; not saved with the file."""

from __future__ import annotations

import bpy
from bpy.props import BoolProperty

from ..annotated import Annotated
from ..blender_classes import PropertyGroup
from ..blender_types import Context
from ..screen import redraw_viewports


def _switched(owner: RISORIUS_PG_show, context: Context) -> None:
    """The preview holds the face that muscles and paths are read from."""
    from ..preview import live

    live.refresh_active(bpy.context)
    redraw_viewports()


class RISORIUS_PG_show(PropertyGroup):
    """What is drawn over the active face."""

    muscles: Annotated[
        bool,
        BoolProperty(
            name="Muscles",
            description="Draw the muscles from the bone to the skin: blue is relaxed, red is contracted. Needs "
            "Live Preview",
            update=_switched,
        ),
    ]
    strain: Annotated[
        bool,
        BoolProperty(
            name="Strain",
            description="Colour the skin by strain: red is stretched by 30 % or more, blue is compressed as much",
            update=redraw_viewports,
        ),
    ]
    paths: Annotated[
        bool,
        BoolProperty(
            name="Paths",
            description="Draw the path of the skin into the expression, from blue at rest to red at the apex. "
            "Needs Live Preview",
            update=_switched,
        ),
    ]
