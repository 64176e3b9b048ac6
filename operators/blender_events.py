"""Listening to Blender's events: another frame, saving, undo, another file."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import ExitStack
from typing import TypeAlias

from bpy.app.handlers import persistent

from ..scene.blender_types import Depsgraph
from .blender_types import Scene

#: What is done after an event. Blender hands over nothing but zeros with some events.
Handler: TypeAlias = Callable[[Scene, Depsgraph], None]


def act_on(event: list[Handler], action: Handler, undo: ExitStack) -> None:
    """Do it at each such event, in every file, until undone."""
    event.append(persistent(action))
    undo.callback(event.remove, action)
