"""Which version saved a file: one that a later version saved says so in the sidebar, and stays marked so.

What only the later version knows is kept by Blender as it is, but not shown, played or baked here.
"""

from __future__ import annotations

from contextlib import ExitStack

import bpy

from ..resources import version
from ..scene.points.kept import has_points
from .active import all_objects
from .blender_events import act_on
from .blender_types import Scene, UILayout

#: The newest version that saved a scene with a face, as a custom property of the scene.
SAVED_BY = "risorius_saved_by"


def later_version(scene: Scene) -> str | None:
    """The later version that saved this scene, or None."""
    found = scene.get(SAVED_BY)
    return found if isinstance(found, str) and _numbers(found) > _numbers(version()) else None


def draw_later(layout: UILayout, scene: Scene) -> None:
    """Say that a later version saved this file."""
    later = later_version(scene)
    if later is None:
        return
    box = layout.box().column(align=True)
    box.alert = True
    box.label(text=f"Saved by Risorius {later}", icon="ERROR")
    box.label(text="Update to see and bake all of it")


def _numbers(text: str) -> tuple[int, ...]:
    """A version as numbers that compare; what is no version comes before all."""
    parts = text.split(".")
    return tuple(int(part) for part in parts) if all(part.isdecimal() for part in parts) else ()


def _before_save(*_: object) -> None:
    """Mark the scenes of a file with faces, unless a later version did."""
    if not any(obj.type == "MESH" and has_points(obj) for obj in all_objects()):
        return
    for scene in bpy.data.scenes:
        if scene.library is None and later_version(scene) is None:
            scene[SAVED_BY] = version()


def attach(undo: ExitStack) -> None:
    """Do so until undone."""
    act_on(bpy.app.handlers.save_pre, _before_save, undo)
