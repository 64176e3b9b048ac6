"""The one property that Risorius adds to objects, the one it adds to scenes, and the one it adds to the window."""

from contextlib import ExitStack

import bpy

from .bake.props import RISORIUS_PG_bake
from .emotion.props import RISORIUS_PG_emotion
from .face.props import RISORIUS_PG_face
from .film.props import RISORIUS_PG_film
from .muscles.props import RISORIUS_PG_muscle_list, RISORIUS_PG_muscles
from .parts.props import RISORIUS_PG_parts
from .points.props import RISORIUS_PG_points
from .preview.props import RISORIUS_PG_preview
from .read.props import RISORIUS_PG_read
from .shapes.props import RISORIUS_PG_shapes
from .show.props import RISORIUS_PG_show
from .timeline.props import RISORIUS_PG_timeline
from .tissue.props import RISORIUS_PG_tissue
from .wheel.props import RISORIUS_PG_wheel


class RISORIUS_PG_object(bpy.types.PropertyGroup):
    """All that is chosen for one face; saved with its object."""

    face: bpy.props.PointerProperty(type=RISORIUS_PG_face)  # type: ignore[valid-type]
    emotion: bpy.props.PointerProperty(type=RISORIUS_PG_emotion)  # type: ignore[valid-type]
    timeline: bpy.props.PointerProperty(type=RISORIUS_PG_timeline)  # type: ignore[valid-type]
    muscles: bpy.props.PointerProperty(type=RISORIUS_PG_muscles)  # type: ignore[valid-type]
    tissue: bpy.props.PointerProperty(type=RISORIUS_PG_tissue)  # type: ignore[valid-type]
    bake: bpy.props.PointerProperty(type=RISORIUS_PG_bake)  # type: ignore[valid-type]


class RISORIUS_PG_scene(bpy.types.PropertyGroup):
    """All that is chosen for a scene."""

    film: bpy.props.PointerProperty(type=RISORIUS_PG_film)  # type: ignore[valid-type]
    shapes: bpy.props.PointerProperty(type=RISORIUS_PG_shapes)  # type: ignore[valid-type]
    read: bpy.props.PointerProperty(type=RISORIUS_PG_read)  # type: ignore[valid-type]


class RISORIUS_PG_window(bpy.types.PropertyGroup):
    """How things are shown; not saved with the file."""

    points: bpy.props.PointerProperty(type=RISORIUS_PG_points)  # type: ignore[valid-type]
    parts: bpy.props.PointerProperty(type=RISORIUS_PG_parts)  # type: ignore[valid-type]
    muscles: bpy.props.PointerProperty(type=RISORIUS_PG_muscle_list)  # type: ignore[valid-type]
    wheel: bpy.props.PointerProperty(type=RISORIUS_PG_wheel)  # type: ignore[valid-type]
    preview: bpy.props.PointerProperty(type=RISORIUS_PG_preview)  # type: ignore[valid-type]
    show: bpy.props.PointerProperty(type=RISORIUS_PG_show)  # type: ignore[valid-type]


def attach(undo: ExitStack) -> None:
    """Give objects, scenes and the window their property, until undone. What is saved in files stays there."""
    for owner, group in (
        (bpy.types.Object, RISORIUS_PG_object),
        (bpy.types.Scene, RISORIUS_PG_scene),
        (bpy.types.WindowManager, RISORIUS_PG_window),
    ):
        owner.risorius = bpy.props.PointerProperty(type=group)
        undo.callback(delattr, owner, "risorius")
