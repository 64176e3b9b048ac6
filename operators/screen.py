"""What windows show beside panels: their status bars, and editors that are drawn anew."""

from __future__ import annotations

from collections.abc import Sequence

import bpy

from ..scene.blender_types import Window
from .blender_types import Context, WindowManager


def windows() -> Sequence[Window]:
    """All windows; none where Blender has none."""
    manager: WindowManager | None = bpy.context.window_manager
    return () if manager is None else manager.windows.values()


def is_playing() -> bool:
    """Whether a window plays the timeline."""
    return any(window.screen.is_animation_playing for window in windows())


def redraw_viewports(owner: object = None, context: Context | None = None) -> None:
    """Draw all 3D viewports anew; may be the update function of a property."""
    _redraw("VIEW_3D")


def redraw_timelines(owner: object = None, context: Context | None = None) -> None:
    """Draw all timeline editors anew; may be the update function of a property."""
    _redraw("DOPESHEET_EDITOR")


def _redraw(editor: str) -> None:
    """Draw all editors of a kind anew."""
    for window in windows():
        for area in window.screen.areas:
            if area.type == editor:
                area.tag_redraw()


def show_status(context: Context, text: str | None) -> None:
    """Text in the status bar of the context's window, or Blender's own again."""
    if context.workspace is not None:
        context.workspace.status_text_set(text)


def show_status_everywhere(text: str | None) -> None:
    """Text in the status bars of all windows, or Blender's own again."""
    for window in windows():
        window.workspace.status_text_set(text)
