"""The file that a job works in and leaves behind.

A job opens a file of its own, so it refuses to run in a Blender with a window, where it would throw away what is open.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, fields
from pathlib import Path

import bpy
import numpy as np

from ...errors import FormatError, ParameterError, SceneError

#: What a file's name must end in to be a .blend; what else a job is asked to write is a film.
BLEND = ".blend"


@dataclass(frozen=True)
class Made:
    """What a job has written; ``dict(made)`` names it all.

    Attributes
    ----------
    error_mm : of new shape keys, how far the motion is off at most. bytes : size of the .blend.
    clips : reports of clips on a rig (`rig.report`).
    """

    blend: Path | None = None
    film: Path | None = None
    sheet: Path | None = None
    labels: Path | None = None
    face: str = ""
    frames: int | None = None
    shape_keys: int | None = None
    error_mm: float | None = None
    bytes: int | None = None
    clips: tuple[Mapping[str, object], ...] = ()
    remarks: tuple[str, ...] = ()

    def __iter__(self) -> Iterator[tuple[str, object]]:
        """Name and value of everything there is."""
        for field in fields(self):
            value = getattr(self, field.name)
            if value not in (None, (), ""):
                yield field.name, value


def empty_file(fps: float) -> None:
    """An empty file with this frame rate."""
    _refuse_window()
    _refuse_wrong_rate(fps)
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    _set_rate(fps)


def open_file(path: Path, fps: float | None) -> None:
    """Open a .blend as it is; `fps`: at another frame rate than its own.

    Raises
    ------
    FormatError : it is not there, or this Blender cannot read it.
    """
    _refuse_window()
    if fps is not None:
        _refuse_wrong_rate(fps)
    if not os.path.isfile(path):  # Path's own raises where a name is too long
        raise FormatError(path, "does not exist: check the path")
    try:
        bpy.ops.wm.open_mainfile(filepath=os.path.abspath(path), load_ui=False)
    except RuntimeError as problem:
        raise FormatError(path, f"cannot be read by this Blender ({str(problem).strip()})") from problem
    if fps is not None:
        _set_rate(fps)


def _refuse_window() -> None:
    """Refuse a Blender in which somebody works."""
    if not bpy.app.background:
        remedy = "run it from the command line (blender --command risorius)"
        raise SceneError("This job", f"opens a file of its own: {remedy}")


def _refuse_wrong_rate(fps: float) -> None:
    """Refuse a rate that no film has."""
    if not (np.isfinite(fps) and 1.0 <= fps <= 240.0):
        raise ParameterError("fps", "must be between 1 and 240", fps)


def _set_rate(fps: float) -> None:
    """Give the open scene a frame rate."""
    render = bpy.context.scene.render
    render.fps = max(1, round(fps))
    render.fps_base = render.fps / fps


def save(path: Path) -> None:
    """Save the open file.

    Raises
    ------
    SceneError : it could not be written.
    """
    try:
        bpy.ops.wm.save_as_mainfile(filepath=str(path.resolve()), compress=True, check_existing=False)
    except RuntimeError as problem:
        raise SceneError(str(path), f"could not be saved ({problem}): choose another folder") from problem
