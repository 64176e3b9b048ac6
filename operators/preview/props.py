"""Whether the preview is on; not saved with the file."""

from __future__ import annotations

from bpy.props import BoolProperty

from ..annotated import Annotated
from ..blender_classes import PropertyGroup
from ..blender_types import Context


def _switched(owner: RISORIUS_PG_preview, context: Context) -> None:
    """Show the active face, or take every preview away."""
    from . import live

    if owner.show:
        live.refresh_active(context)
    else:
        live.end()


class RISORIUS_PG_preview(PropertyGroup):
    """The live preview of a window."""

    show: Annotated[
        bool,
        BoolProperty(
            name="Live Preview",
            description="Show the chosen emotion on the face at once, and play expressions that are not baked. "
            "Shape keys, renders and the saved file do not change",
            default=True,
            update=_switched,
        ),
    ]
