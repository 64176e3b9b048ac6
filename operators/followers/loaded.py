"""Files from before there was a list of followers: what they name part by part comes into the list as they open."""

from __future__ import annotations

from contextlib import ExitStack

import bpy

from ..active import all_objects
from ..blender_events import act_on
from .rows import rows_of, take_slots


def _after_load(*_: object) -> None:
    """Another file is open."""
    for obj in all_objects():
        if obj.type == "MESH" and obj.is_editable and len(rows_of(obj)) > len(obj.risorius.face.followers):
            take_slots(obj)


def attach(undo: ExitStack) -> None:
    """Do so until undone."""
    act_on(bpy.app.handlers.load_post, _after_load, undo)
