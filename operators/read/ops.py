"""Operators that read the animation, show its plot, and take what was written away."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import bpy

from ...errors import SceneError
from ...progress import Work
from ...scene.live import belief_curves
from ...scene.live.reading import read_animation
from ...scene.pictures import belief_plot
from ...scene.pictures.film import refuse_unwritable_output
from ...scene.pictures.lettering import write_picture
from ..active import active_object, reading_reason
from ..base import RisoriusOperator, WorkOperator
from ..blender_classes import Operator
from ..blender_types import Context, Object, Scene
from ..film.ops import absolute
from ..wheel.picture import COLOURS

if TYPE_CHECKING:
    from ...api import BeliefTrack


def unwritable_reason(obj: Object) -> str | None:
    """Why the custom properties of an object cannot be animated, or None."""
    try:
        belief_curves.refuse_unwritable_curves(obj)
    except SceneError as refusal:
        return str(refusal)
    return None


class RISORIUS_OT_read_animation(WorkOperator["BeliefTrack"], Operator):
    """Read the expression in every frame of the scene, however the face is animated. The beliefs in the six emotions \
are written as F-curves of custom properties, and as a plot"""

    bl_idname = "risorius.read_animation"
    bl_label = "Read Animation"
    bl_options = {"REGISTER", "UNDO"}
    title = "Reading the animation"

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only on a face with points, whose properties can be animated."""
        return reading_reason(context.object) or unwritable_reason(active_object(context))

    def work(self, context: Context) -> Work[BeliefTrack]:
        """Refuse files that cannot be written, then read."""
        scene = context.scene
        for path in files_of(scene).values():
            refuse_unwritable_output(path)
        start, end = (scene.frame_start, scene.frame_end)
        if scene.use_preview_range:
            start, end = scene.frame_preview_start, scene.frame_preview_end
        return read_animation(active_object(context), scene, start=start, end=end, rule=scene.risorius.read.rule)

    def finish(self, context: Context, result: BeliefTrack) -> str:
        """Files first, which may fail; then the plot and the F-curves."""
        obj, files = active_object(context), files_of(context.scene)
        rule = "the paper's rule" if context.scene.risorius.read.rule == "paper" else "the robust rule"
        _write_files(files, result, obj.name)
        colours = {str(name): colour for name, colour in COLOURS.items()}
        picture = belief_plot.draw_plot(result, f"{obj.name}: beliefs by {rule}", colours)
        if "plot" in files:
            write_picture(picture, files["plot"])
        belief_curves.write_curves(obj, result)
        image = belief_plot.keep_plot(obj, picture)
        wrote = "".join(f", {path.name}" for path in files.values())
        return f"Read {len(result.frames)} frames of {obj.name}: F-curves, the image {image.name}{wrote}"


def files_of(scene: Scene) -> dict[str, Path]:
    """Kind -> file, of those that are to be written."""
    chosen = scene.risorius.read
    kinds = (("stream", ".fap"), ("table", ".csv"), ("plot", ".png"))
    named = [(kind, getattr(chosen, kind), ending) for kind, ending in kinds if getattr(chosen, kind)]
    return {kind: absolute(name, ending, keep=(ending,)) for kind, name, ending in named}


def _write_files(files: dict[str, Path], track: BeliefTrack, name: str) -> None:
    """The FAPs as a stream, and the table."""
    from ... import api

    if "stream" in files:
        stream = api.FapStream(track.frames, fps=track.fps, name=name, first_frame=max(0, track.first_frame))
        api.write_fap(files["stream"], stream)
    if "table" in files:
        api.write_belief_csv(files["table"], track)


class RISORIUS_OT_show_beliefs(RisoriusOperator, Operator):
    """Open the plot of the beliefs in a new window"""

    bl_idname = "risorius.show_beliefs"
    bl_label = "Show Plot"
    bl_options = {"REGISTER"}
    needs_scipy = False

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only where there is one."""
        if context.object is None or belief_plot.plot_of(context.object) is None:
            return "The animation has not been read yet"
        return "Needs a window" if context.window is None else None

    def run(self, context: Context) -> str:
        """A new window with an image editor."""
        image = belief_plot.plot_of(active_object(context))
        assert image is not None
        bpy.ops.wm.window_new()
        area = context.window_manager.windows[-1].screen.areas[0]
        area.ui_type = "IMAGE_EDITOR"
        area.spaces.active.image = image
        return f"Showing {image.name}"


class RISORIUS_OT_clear_reading(RisoriusOperator, Operator):
    """Remove the beliefs: custom properties, their F-curves and the plot"""

    bl_idname = "risorius.clear_reading"
    bl_label = "Clear Reading"
    bl_options = {"REGISTER", "UNDO"}
    needs_scipy = False

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only where there is something to clear."""
        if context.object is None or not belief_curves.has_curves(context.object):
            return "The animation has not been read yet"
        return unwritable_reason(context.object)

    def run(self, context: Context) -> str:
        """Remove it."""
        obj = active_object(context)
        belief_curves.remove_curves(obj)
        belief_plot.remove_plot(obj)
        return f"Cleared the beliefs of {obj.name}"
