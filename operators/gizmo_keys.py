"""Keymaps of gizmos, which Blender makes of itself and keeps after their classes are gone."""

from __future__ import annotations

import bpy

from .blender_types import WindowManager


def forget_keymap(name: str) -> None:
    """Take a gizmo's keymap out of Blender's keys, and out of the user's copy of them."""
    manager: WindowManager | None = bpy.context.window_manager
    for config in () if manager is None else (manager.keyconfigs.user, manager.keyconfigs.default):
        if config is not None and name in config.keymaps:
            config.keymaps.remove(config.keymaps[name])
