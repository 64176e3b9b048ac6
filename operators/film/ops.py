"""The operator that renders a film."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy

from ...errors import SceneError
from ...scene import action, film, refusals
from ...scene.progress import Work
from ...scene.studio import Engine, Look
from ..active import target_of
from ..base import WorkOperator


class RISORIUS_OT_render_film(WorkOperator, bpy.types.Operator):
    """Render the face as a film: framed, lit and encoded as MP4. Your own camera, lights and settings stay untouched"""

    bl_idname = "risorius.render_film"
    bl_label = "Render Film"
    bl_options = {"REGISTER"}
    needs_scipy = False
    title = "Rendering the film"

    @classmethod
    def refusal(cls, context: Any) -> str | None:
        """Only for meshes that can be read."""
        return refusals.reason(context.object, writing=False)

    def work(self, context: Any) -> Work[film.FilmResult]:
        """Render and encode."""
        chosen = context.scene.risorius.film
        path = output_path(chosen)
        start, end = frame_range(context)
        return film.render_film(
            target_of(context.object).objects(),
            path,
            start=start,
            end=end,
            look=look_of(chosen),
            frames=path.with_suffix("") if chosen.keep_pictures else None,
        )

    def finish(self, context: Any, result: film.FilmResult) -> str:
        """Say where it is."""
        for remark in result.remarks:
            self.report({"WARNING"}, remark)
        return f"Rendered {result.frame_count} frames to {result.path}"


def look_of(chosen: Any) -> Look:
    """The look chosen; with a window there is a graphics card that affords the fine one."""
    size = chosen.size // 2 * 2
    return Look(engine=Engine(chosen.engine), width=size, height=size, fine=not bpy.app.background)


def output_path(chosen: Any) -> Path:
    """The film's absolute path, ending in .mp4.

    Raises
    ------
    SceneError : no path, or a path beside a .blend that was never saved.
    """
    if not chosen.path.strip():
        raise SceneError("Film", "has no file to be written to: choose one")
    if chosen.path.startswith("//") and not bpy.data.filepath:
        raise SceneError("Film", f"{chosen.path} lies beside the .blend file: save that first, or choose a full path")
    path = Path(bpy.path.abspath(chosen.path))
    return path if path.suffix.lower() == ".mp4" else path.with_name(path.name + ".mp4")


def frame_range(context: Any) -> tuple[int, int]:
    """First and last frame: of the clip that the face plays, or of the scene."""
    scene, keys = context.scene, context.object.data.shape_keys
    playing = keys.animation_data.action if keys is not None and keys.animation_data is not None else None
    if scene.risorius.film.frames == "CLIP" and playing is not None and action.FACE_TAG in playing:
        return int(playing.frame_start), int(playing.frame_end)
    return int(scene.frame_start), int(scene.frame_end)


CLASSES = (RISORIUS_OT_render_film,)
