"""Lists of names that panels show, filled when they are first drawn."""

from __future__ import annotations

from collections.abc import Callable

import bpy


def fill_soon(fill: Callable[[], None]) -> None:
    """Fill a list after drawing, where nothing may be written."""
    if not bpy.app.background and not bpy.app.timers.is_registered(fill):
        bpy.app.timers.register(fill, first_interval=0.0)
