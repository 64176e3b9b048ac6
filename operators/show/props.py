"""What is drawn over the face; not saved with the file."""

from __future__ import annotations

from typing import Any

import bpy
from bpy.props import BoolProperty

from ..annotated import Annotated
from ..points.props import redraw


def _switched(owner: Any, context: Any) -> None:
    """The preview holds the face that muscles and paths are read from."""
    from ..preview import live

    live.refresh_active(bpy.context)
    redraw()


class RISORIUS_PG_show(bpy.types.PropertyGroup):
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
            update=redraw,
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
