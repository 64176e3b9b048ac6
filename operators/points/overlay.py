"""The feature points of the active face, drawn over it: place, number, name, and how sure each is.

The one draw handler looks at what is there at each redraw and keeps nothing: opening a file or deleting the object
needs no cleaning up.
"""

from __future__ import annotations

from contextlib import ExitStack

import bpy

from ...arrays import Floats
from ...errors import RisoriusError
from ...face.fit.doubt import DOUBTFUL
from ...mpeg4 import FEATURE_POINTS
from ...scene.points.kept import KeptPoints, has_points, mesh_counts, read_kept
from ...scene.points.seen import Visible
from ..active import active_object
from ..blender_types import Context
from .canvas import Canvas, Colour, text_width
from .props import active_name
from .view import Viewport

#: Pixels at a scale of 1: a point's radius, the marked one's, what is told apart by a click, and letters.
RADIUS, MARKED_RADIUS, TOUCH, LETTERS = 4.0, 6.5, 14.0, 11.0
SURE, UNSURE, WRONG = (0.16, 0.78, 0.86), (0.98, 0.80, 0.20), (0.96, 0.28, 0.20)
RIM, MARK = (0.05, 0.05, 0.05, 0.9), (1.0, 1.0, 1.0, 1.0)

#: What is behind the words beside the mouse, and their second line.
PAPER, GREY = (0.06, 0.06, 0.07, 0.94), (0.75, 0.75, 0.75, 1.0)

_hovered: str | None = None


def confidence_colour(confidence: float) -> Colour:
    """Blue where it is sure, yellow where it is doubtful, red where it is probably wrong."""
    if confidence >= DOUBTFUL:
        share, low, high = (confidence - DOUBTFUL) / (1.0 - DOUBTFUL), UNSURE, SURE
    else:
        share, low, high = confidence / DOUBTFUL, WRONG, UNSURE
    r, g, b = (a + share * (c - a) for a, c in zip(low, high, strict=True))
    return r, g, b, 1.0


def shows_points(context: Context) -> bool:
    """Whether the points of the active object are drawn now."""
    obj, viewport = context.object, Viewport.of(context)
    state = context.window_manager.risorius.points
    if obj is None or viewport is None or not (state.show and has_points(obj) and viewport.draws_over(obj)):
        return False
    try:
        return read_kept(obj).counts == mesh_counts(obj.data)
    except RisoriusError:
        return False


def drawn_points(context: Context) -> tuple[KeptPoints, dict[str, Floats], Visible] | None:
    """Points that are drawn now, where in the world they are, and what they are on; None where nothing is drawn."""
    if not shows_points(context):
        return None
    obj, state = active_object(context), context.window_manager.risorius.points
    kept = read_kept(obj)
    visible = Visible.of(obj, context.evaluated_depsgraph_get())
    places = visible.places(kept)
    if state.doubtful_only:
        places = {n: p for n, p in places.items() if kept.points[n].confidence < DOUBTFUL or n == active_name(state)}
    return kept, places, visible


def point_at(context: Context, pixel: tuple[float, float]) -> str | None:
    """The name of the drawn point under a pixel, a visible one before a hidden one."""
    drawn, viewport = drawn_points(context), Viewport.of(context)
    if drawn is None or viewport is None:
        return None
    _, places, visible = drawn
    touch = TOUCH * context.preferences.system.ui_scale
    near = {}
    for name, place in places.items():
        there = viewport.on_screen(place)
        if there is not None and abs(there[0] - pixel[0]) < touch and abs(there[1] - pixel[1]) < touch:
            near[name] = (there[0] - pixel[0]) ** 2 + (there[1] - pixel[1]) ** 2
    if not near:
        return None
    behind = dict(zip(places, visible.hidden(places, *viewport.eye()), strict=True))
    return min((bool(behind[name]), far, name) for name, far in near.items())[2]


class Labels:
    """Where something is written already, so that labels do not cover one another: nearer by, more of them show."""

    def __init__(self, scale: float) -> None:
        self._margin = 2.0 * scale
        self._boxes: list[tuple[float, float, float, float]] = []

    def has_room(self, at: tuple[float, float], words: str, size: float) -> bool:
        """Whether words from `at` on cover no others; if so they take that room."""
        left, low = at[0] - self._margin, at[1] - self._margin
        right, high = at[0] + text_width(words, size) + self._margin, at[1] + size
        if any(left < b[2] and b[0] < right and low < b[3] and b[1] < high for b in self._boxes):
            return False
        self._boxes.append((left, low, right, high))
        return True


def _draw() -> None:
    """Draw handler: in pixels of the region."""
    context: Context = bpy.context
    drawn, viewport = drawn_points(context), Viewport.of(context)
    if drawn is None or viewport is None or context.region != viewport.region:
        return
    kept, places, visible = drawn
    behind = visible.hidden(places, *viewport.eye())
    hidden = {name for name, is_hidden in zip(places, behind, strict=True) if is_hidden}
    state, scale = context.window_manager.risorius.points, context.preferences.system.ui_scale
    marked = active_name(state)
    seen = ((name, viewport.on_screen(place)) for name, place in places.items())
    spots = {name: there for name, there in seen if there is not None}
    order = sorted(spots, key=lambda name: (name == marked, name not in hidden))
    canvas, written = Canvas(), Labels(scale)
    for name in order:
        strength = 0.3 if name in hidden and name != marked else 1.0
        radius = (MARKED_RADIUS if name == marked else RADIUS) * scale
        canvas.disc(spots[name], radius + 1.5 * scale, MARK if name == marked else (*RIM[:3], RIM[3] * strength))
        canvas.disc(spots[name], radius, (*confidence_colour(kept.points[name].confidence)[:3], strength))
    for name in reversed(order):
        if name == marked or name not in hidden:
            words = label(name, "PLACES" if name == marked else state.labels)
            size = LETTERS * scale * (1.25 if name == marked else 1.0)
            x, y = spots[name][0] + 1.8 * RADIUS * scale, spots[name][1] - 4.0 * scale
            if words and written.has_room((x, y), words, size):
                canvas.text((x, y), words, size, (1.0, 1.0, 1.0, 1.0))
    canvas.draw()
    if _hovered in spots:
        _draw_name(_hovered, kept.points[_hovered].confidence, spots[_hovered], viewport, scale)


def hover(name: str | None) -> None:
    """The mouse is over this point, or over none."""
    global _hovered
    _hovered = name


def words_of(name: str, confidence: float) -> tuple[str, str]:
    """What is told of the point under the mouse: number and place, and how sure it is."""
    return f"{name}  {FEATURE_POINTS[name].location}", f"{confidence:.0%} confidence"


def _draw_name(name: str, confidence: float, at: tuple[float, float], viewport: Viewport, scale: float) -> None:
    """The name of the point under the mouse, over everything."""
    canvas, size, lines = Canvas(), 1.25 * LETTERS * scale, words_of(name, confidence)
    width = max(text_width(line, size) for line in lines) + 12.0 * scale
    left = min(at[0] + 12.0 * scale, viewport.region.width - width)
    low = min(at[1] + 12.0 * scale, viewport.region.height - 3.4 * size)
    canvas.disc(at, MARKED_RADIUS * scale, MARK)
    canvas.disc(at, RADIUS * scale, confidence_colour(confidence))
    canvas.box((left, low), (left + width, low + 3.4 * size), PAPER)
    canvas.text((left + 6.0 * scale, low + 2.0 * size), lines[0], size, MARK)
    canvas.text((left + 6.0 * scale, low + 0.6 * size), lines[1], size, GREY)
    canvas.draw()


def label(name: str, kind: str) -> str:
    """What is written beside a point."""
    if kind == "NONE":
        return ""
    return name if kind == "NUMBERS" else f"{name}  {FEATURE_POINTS[name].location}"


def attach(undo: ExitStack) -> None:
    """Draw until undone."""
    handler = bpy.types.SpaceView3D.draw_handler_add(_draw, (), "WINDOW", "POST_PIXEL")
    undo.callback(bpy.types.SpaceView3D.draw_handler_remove, handler, "WINDOW")
