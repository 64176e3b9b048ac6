"""Draws the clips of the active face into timeline editors."""

from __future__ import annotations

from contextlib import ExitStack

import bpy

from ...scene.bake.timing import scene_fps
from ...scene.blender_types import Region
from ..active import active_object
from ..blender_types import Context
from ..changes import listen, listen_to_time
from ..points.canvas import Canvas, Colour, text_width
from ..screen import redraw_timelines
from .bars import Bar, lay_out
from .colours import colour_of
from .props import active_clip, playing_clips
from .titles import clip_title

#: Pixels at a scale of 1: letters, their distance from the bar's beginning, a rim.
LETTERS, INDENT, RIM = 11.0, 5.0, 1.2
#: How opaque bars are, and those of clips that do not play.
OPAQUE, SILENT = 0.85, 0.25
TEXT, UNSHADED, MARK = (0.05, 0.05, 0.05, 1.0), (0.0, 0.0, 0.0, 0.0), (1.0, 1.0, 1.0, 1.0)


def bars_of(context: Context, region: Region) -> list[Bar]:
    """The bars that a timeline editor shows; none where it is no timeline, or the active object has no clips."""
    obj, space = context.object, context.space_data
    if obj is None or space is None or space.type != "DOPESHEET_EDITOR" or space.mode != "TIMELINE":
        return []
    view = region.view2d
    return lay_out(
        obj.risorius.timeline.clips,
        scene_fps(context.scene),
        lambda frame: float(view.view_to_region(frame, 0.0, clip=False)[0]),
        float(region.height),
        context.preferences.system.ui_scale,
    )


def _draw() -> None:
    """Draw handler: in pixels of the region."""
    context: Context = bpy.context
    region = context.region
    bars = bars_of(context, region) if region is not None else []
    if not bars:
        return
    timeline, scale = active_object(context).risorius.timeline, context.preferences.system.ui_scale
    playing, active = {clip.path_from_id() for clip in playing_clips(timeline)}, active_clip(timeline)
    canvas = Canvas()
    for bar in bars:
        clip = timeline.clips[bar.number]
        opacity = OPAQUE if clip.path_from_id() in playing else SILENT
        _draw_bar(canvas, bar, clip.peak, (*colour_of(clip.emotion), opacity), MARK if clip == active else None, scale)
        words, size = clip_title(clip), min(LETTERS * scale, bar.high - bar.low - 2.0 * scale)
        room = bar.corners[3] - bar.corners[0] - 2.0 * INDENT * scale
        if size >= 0.6 * LETTERS * scale and text_width(words, size) <= room:
            x = max(bar.corners[0], 0.0) + INDENT * scale
            canvas.text((x, bar.low + 0.3 * (bar.high - bar.low)), words, size, TEXT, shadow=UNSHADED)
    canvas.draw()


def _draw_bar(canvas: Canvas, bar: Bar, peak: float, colour: Colour, rim: Colour | None, scale: float) -> None:
    """Rising to its peak, staying, fading, over a paler ground that can be grabbed."""
    first, full, fading, over = bar.corners
    top = bar.low + peak * (bar.high - bar.low)
    canvas.box((first, bar.low), (over, bar.high), (*colour[:3], 0.45 * colour[3]))
    shape = [(first, bar.low), (full, top), (fading, top), (over, bar.low)]
    for corners in (shape[:3], (shape[0], *shape[2:])):
        canvas.blend([(corner, colour) for corner in corners])
    if rim is not None:
        box = [(first, bar.low), (over, bar.low), (over, bar.high), (first, bar.high), (first, bar.low)]
        canvas.line(box, RIM * scale, rim)


def attach(undo: ExitStack) -> None:
    """Draw until undone, anew whenever clips change."""
    handler = bpy.types.SpaceDopeSheetEditor.draw_handler_add(_draw, (), "WINDOW", "POST_PIXEL")
    undo.callback(bpy.types.SpaceDopeSheetEditor.draw_handler_remove, handler, "WINDOW")
    listen(redraw_timelines, undo)
    listen_to_time(redraw_timelines, undo)
