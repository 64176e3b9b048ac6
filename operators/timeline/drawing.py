"""Draws the clips of the active face into timeline editors."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import ExitStack

import bpy

from ...scene.bake.timing import scene_fps
from ...scene.blender_types import Region
from ..active import active_object
from ..blender_types import Context
from ..changes import listen, listen_to_time
from ..points.canvas import Canvas, Colour, text_width
from ..screen import redraw_timelines
from ..speech.bars import SpokenTimes, word_spans
from ..speech.strips import title_of_strip
from .bars import Bar, lay_out
from .colours import colour_of
from .props import active_clip, playing_clips
from .titles import clip_title

#: Pixels at a scale of 1: letters, their distance from the bar's beginning, a rim.
LETTERS, INDENT, RIM = 11.0, 5.0, 1.2
#: How opaque bars are, and those of clips that do not play.
OPAQUE, SILENT = 0.85, 0.25
#: Of speech, and of the word that is being edited; pixels of the narrowest word that is drawn by itself.
SPEECH, EDITED, LEAST_WORD = (0.62, 0.78, 0.86), (0.95, 0.95, 0.98), 2.0
TEXT, UNSHADED, MARK = (0.05, 0.05, 0.05, 1.0), (0.0, 0.0, 0.0, 0.0), (1.0, 1.0, 1.0, 1.0)


def bars_of(context: Context, region: Region) -> list[Bar]:
    """The bars that a timeline editor shows: of the active object's clips, then of its speech."""
    obj, space = context.object, context.space_data
    if obj is None or space is None or space.type != "DOPESHEET_EDITOR" or space.mode != "TIMELINE":
        return []
    spoken = [SpokenTimes.of(strip) for strip in obj.risorius.speech.strips]
    return lay_out(
        [*obj.risorius.timeline.clips, *spoken],
        scene_fps(context.scene),
        lambda frame: _pixel(region, frame),
        float(region.height),
        context.preferences.system.ui_scale,
    )


def _pixel(region: Region, frame: float) -> float:
    """Where a frame is in a region."""
    return float(region.view2d.view_to_region(frame, 0.0, clip=False)[0])


def _draw() -> None:
    """Draw handler: in pixels of the region."""
    context: Context = bpy.context
    region = context.region
    bars = bars_of(context, region) if region is not None else []
    if region is None or not bars:
        return
    timeline, scale = active_object(context).risorius.timeline, context.preferences.system.ui_scale
    playing, active = {clip.path_from_id() for clip in playing_clips(timeline)}, active_clip(timeline)
    canvas = Canvas()
    for bar in bars:
        if bar.number >= len(timeline.clips):
            _draw_speech(canvas, context, region, bar)
            continue
        clip = timeline.clips[bar.number]
        opacity = OPAQUE if clip.path_from_id() in playing else SILENT
        _draw_bar(canvas, bar, clip.peak, (*colour_of(clip.emotion), opacity), MARK if clip == active else None, scale)
        _write(canvas, bar, (bar.corners[0], bar.corners[3]), clip_title(clip), INDENT * scale, scale)
    canvas.draw()


def _write(canvas: Canvas, bar: Bar, sides: tuple[float, float], words: str, indent: float, scale: float) -> None:
    """Words between two pixels of a bar, where there is room."""
    size = min(LETTERS * scale, bar.high - bar.low - 2.0 * scale)
    if size >= 0.6 * LETTERS * scale and text_width(words, size) <= sides[1] - sides[0] - 2.0 * indent:
        at = max(sides[0], 0.0) + indent, bar.low + 0.3 * (bar.high - bar.low)
        canvas.text(at, words, size, TEXT, shadow=UNSHADED)


def _draw_speech(canvas: Canvas, context: Context, region: Region, bar: Bar) -> None:
    """A strip with a box for each word that can be seen, as strong as it is said."""
    obj, scale = active_object(context), context.preferences.system.ui_scale
    number = bar.number - len(obj.risorius.timeline.clips)
    strip, speech = obj.risorius.speech.strips[number], obj.risorius.speech
    opacity = SILENT if strip.mute else OPAQUE
    begin, end = bar.corners[0], max(bar.corners[3], bar.corners[0] + scale)
    canvas.box((begin, bar.low), (end, bar.high), (*SPEECH, 0.35 * opacity))
    words = 0.0
    for first, last, title, strength, edited in word_spans(strip, scene_fps(context.scene), region_x(region)):
        if last < 0.0 or first > region.width or last - first < LEAST_WORD:
            continue
        words += last - first
        high = bar.low + (0.35 + 0.65 * min(strength, 1.0)) * (bar.high - bar.low)
        colour = EDITED if edited and number == speech.active else SPEECH
        canvas.box((first, bar.low), (last - 1.5 * scale, high), (*colour, opacity))
        _write(canvas, bar, (first, last), title, 2.0 * scale, scale)
    if not words:
        _write(canvas, bar, (begin, end), title_of_strip(strip), INDENT * scale, scale)
    if number == speech.active:
        box = [(begin, bar.low), (end, bar.low), (end, bar.high), (begin, bar.high), (begin, bar.low)]
        canvas.line(box, RIM * scale, MARK)


def region_x(region: Region) -> Callable[[float], float]:
    """From frames to pixels of a region."""
    origin, unit = _pixel(region, 0.0), _pixel(region, 1000.0) - _pixel(region, 0.0)
    return lambda frame: origin + frame * unit / 1000.0


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
