"""Whether the preview is on; not saved with the file."""

from typing import Any

import bpy


def _switched(owner: Any, context: Any) -> None:
    """Show the active face, or take every preview away."""
    from . import live

    if owner.show:
        live.refresh_active(context)
    else:
        live.end()


class RISORIUS_PG_preview(bpy.types.PropertyGroup):
    """The live preview of a window."""

    show: bpy.props.BoolProperty(  # type: ignore[valid-type]
        name="Live Preview",
        description="Show on the face what is chosen here, while it is being chosen, and let unbaked expressions "
        "play. Shape keys, renders and the saved file stay as they are",
        default=True,
        update=_switched,
    )
