"""What work was about to take away again goes also where a save, an autosave or an undo step in between has kept it."""

from __future__ import annotations

from contextlib import ExitStack

import bpy

from ..scene.creases.marks import measure_again
from ..scene.passing import remove_left
from .active import all_objects
from .blender_events import act_on


def _after_change_of_file(*_: object) -> None:
    """Another file is open, or another step of this one: no work goes on in it."""
    remove_left()
    measure_again(obj for obj in all_objects() if obj.library is None)


def attach(undo: ExitStack) -> None:
    """Do so until undone."""
    for event in (bpy.app.handlers.load_post, bpy.app.handlers.undo_post, bpy.app.handlers.redo_post):
        act_on(event, _after_change_of_file, undo)
