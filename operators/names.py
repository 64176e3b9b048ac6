"""Lists of names that panels show, filled when they are first drawn: nothing may be written while drawing.

They are kept with the window, whose properties are empty after a file was opened. (A load handler would make bpy 4.5
hang at its exit.)
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from typing import TYPE_CHECKING

import bpy

from ..scene.blender_types import Items
from .blender_classes import PropertyGroup
from .blender_types import Entries, WindowManager

if TYPE_CHECKING:
    from .props import RISORIUS_PG_window


def shown_lists() -> list[RISORIUS_PG_window]:
    """What keeps the lists; nothing once Risorius was taken out of Blender."""
    if not hasattr(bpy.types.WindowManager, "risorius"):
        return []
    managers: Items[WindowManager] = bpy.data.window_managers
    return [manager.risorius for manager in managers]


def fill(entries: Entries[PropertyGroup], names: Collection[str]) -> None:
    """Fill a list with names, unless it is."""
    if len(entries) != len(names):
        entries.clear()
        for name in names:
            entries.add().name = name


def fill_soon(fill_all: Callable[[], None]) -> None:
    """Fill lists after drawing."""
    if not bpy.app.background and not bpy.app.timers.is_registered(fill_all):
        bpy.app.timers.register(fill_all, first_interval=0.0)
