"""The one property that Risorius adds to objects, the one it adds to scenes, and the one it adds to the window."""

from __future__ import annotations

from contextlib import ExitStack

import bpy
from bpy.props import PointerProperty

from .annotated import Annotated
from .bake.props import RISORIUS_PG_bake
from .blender_classes import PropertyGroup
from .emotion.props import RISORIUS_PG_emotion
from .face.props import RISORIUS_PG_face
from .film.props import RISORIUS_PG_film
from .muscles.props import RISORIUS_PG_muscle_list, RISORIUS_PG_muscles
from .parts.props import RISORIUS_PG_parts
from .points.props import RISORIUS_PG_points
from .preview.props import RISORIUS_PG_preview
from .read.props import RISORIUS_PG_read
from .recording.props import RISORIUS_PG_recording
from .shapes.props import RISORIUS_PG_shapes
from .show.props import RISORIUS_PG_show
from .speech.props import RISORIUS_PG_speech
from .timeline.props import RISORIUS_PG_timeline
from .tissue.props import RISORIUS_PG_tissue
from .wheel.props import RISORIUS_PG_wheel


class RISORIUS_PG_object(PropertyGroup):
    """All that is chosen for one face; saved with its object."""

    face: Annotated[RISORIUS_PG_face, PointerProperty(type=RISORIUS_PG_face)]
    emotion: Annotated[RISORIUS_PG_emotion, PointerProperty(type=RISORIUS_PG_emotion)]
    timeline: Annotated[RISORIUS_PG_timeline, PointerProperty(type=RISORIUS_PG_timeline)]
    muscles: Annotated[RISORIUS_PG_muscles, PointerProperty(type=RISORIUS_PG_muscles)]
    tissue: Annotated[RISORIUS_PG_tissue, PointerProperty(type=RISORIUS_PG_tissue)]
    bake: Annotated[RISORIUS_PG_bake, PointerProperty(type=RISORIUS_PG_bake)]
    recording: Annotated[RISORIUS_PG_recording, PointerProperty(type=RISORIUS_PG_recording)]
    speech: Annotated[RISORIUS_PG_speech, PointerProperty(type=RISORIUS_PG_speech)]


class RISORIUS_PG_scene(PropertyGroup):
    """All that is chosen for a scene."""

    film: Annotated[RISORIUS_PG_film, PointerProperty(type=RISORIUS_PG_film)]
    shapes: Annotated[RISORIUS_PG_shapes, PointerProperty(type=RISORIUS_PG_shapes)]
    read: Annotated[RISORIUS_PG_read, PointerProperty(type=RISORIUS_PG_read)]


class RISORIUS_PG_window(PropertyGroup):
    """How things are shown; not saved with the file."""

    points: Annotated[RISORIUS_PG_points, PointerProperty(type=RISORIUS_PG_points)]
    parts: Annotated[RISORIUS_PG_parts, PointerProperty(type=RISORIUS_PG_parts)]
    muscles: Annotated[RISORIUS_PG_muscle_list, PointerProperty(type=RISORIUS_PG_muscle_list)]
    wheel: Annotated[RISORIUS_PG_wheel, PointerProperty(type=RISORIUS_PG_wheel)]
    preview: Annotated[RISORIUS_PG_preview, PointerProperty(type=RISORIUS_PG_preview)]
    show: Annotated[RISORIUS_PG_show, PointerProperty(type=RISORIUS_PG_show)]


def attach(undo: ExitStack) -> None:
    """Give objects, scenes and the window their property, until undone. What is saved in files stays there."""
    for owner, group in (
        (bpy.types.Object, RISORIUS_PG_object),
        (bpy.types.Scene, RISORIUS_PG_scene),
        (bpy.types.WindowManager, RISORIUS_PG_window),
    ):
        owner.risorius = PointerProperty(type=group)
        undo.callback(delattr, owner, "risorius")
