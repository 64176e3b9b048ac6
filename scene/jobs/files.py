"""The file that a job works in and leaves behind.

A job starts from an empty file, so it refuses to run in a Blender with a window, where it would throw away what is
open.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, fields
from pathlib import Path

import bpy
import numpy as np

from ...errors import ParameterError, SceneError


@dataclass(frozen=True)
class Made:
    """What a job has written; ``dict(made)`` names it all."""

    blend: Path | None = None
    film: Path | None = None
    sheet: Path | None = None
    frames: int = 0
    shape_keys: int = 0
    error_mm: float = 0.0
    remarks: tuple[str, ...] = ()

    def __iter__(self) -> Iterator[tuple[str, object]]:
        """Name and value of everything there is."""
        for field in fields(self):
            value = getattr(self, field.name)
            if value not in (None, ()):
                yield field.name, value


def empty_file(fps: float) -> None:
    """An empty file with this frame rate."""
    if not bpy.app.background:
        remedy = "run it from the command line (blender --command risorius)"
        raise SceneError("This job", f"starts from an empty file: {remedy}")
    if not (np.isfinite(fps) and 1.0 <= fps <= 240.0):
        raise ParameterError("fps", "must be between 1 and 240", fps)
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    render = bpy.context.scene.render
    render.fps = max(1, round(fps))
    render.fps_base = render.fps / fps


def save(path: Path) -> None:
    """Save the open file.

    Raises
    ------
    SceneError : it could not be written.
    """
    bpy.context.scene.frame_set(bpy.context.scene.frame_start)
    try:
        bpy.ops.wm.save_as_mainfile(filepath=str(path.resolve()), compress=True, check_existing=False)
    except RuntimeError as problem:
        raise SceneError(str(path), f"could not be saved ({problem}): choose another folder") from problem
