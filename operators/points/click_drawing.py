"""What is drawn over the viewport while points are clicked: where the wanted one lies, and those that are there."""

from __future__ import annotations

import bpy

from ...scene.blender_types import Area
from ...scene.mesh import world_matrix
from ...scene.points.seen import Visible
from ..blender_types import Context
from .canvas import Canvas, text_width
from .clicks import ASKED, Clicks
from .diagram import HEIGHT, NOW, draw_diagram
from .view import Viewport

#: Pixels at a scale of 1: the diagram's distance from the corner, and letters below it and beside the mouse.
CORNER, LETTERS, SMALL_LETTERS = (50.0, 40.0), 15.0, 12.0
RIM, CLICKED, WHITE = (0.0, 0.0, 0.0, 0.8), (0.16, 0.78, 0.86, 1.0), (1.0, 1.0, 1.0, 1.0)


def draw_clicks(clicks: Clicks, area: Area) -> None:
    """Draw handler: the diagram, the points so far, and the name of the wanted one beside the mouse."""
    context: Context = bpy.context
    viewport, obj = Viewport.of(context), context.object
    if viewport is None or obj is None or context.area != area or context.region != viewport.region:
        return
    canvas, scale = Canvas(), context.preferences.system.ui_scale
    corner = (CORNER[0] * scale, CORNER[1] * scale)
    draw_diagram(canvas, corner, scale, clicks.wanted, clicks.places)
    visible, world = Visible.of(obj, context.evaluated_depsgraph_get()), world_matrix(obj)
    for name, place in clicks.places.items():
        shown = visible.shown_place(place, clicks.surface)
        there = viewport.on_screen(world[:3, :3] @ shown + world[:3, 3])
        if there is not None:
            canvas.disc(there, 6.0 * scale, RIM)
            canvas.disc(there, 4.5 * scale, CLICKED)
            canvas.text((there[0] + 9.0 * scale, there[1] - 4.0 * scale), name, SMALL_LETTERS * scale, WHITE)
    if clicks.wanted is not None:
        words = f"{clicks.wanted}  {ASKED[clicks.wanted]}"
        canvas.text((corner[0], corner[1] + (HEIGHT + 10.0) * scale), words, LETTERS * scale, NOW)
        if clicks.hover is not None:
            at = (clicks.hover[0] + 14.0 * scale, clicks.hover[1] + 14.0 * scale)
            room = viewport.region.width - text_width(words, SMALL_LETTERS * scale) - 8.0
            canvas.text((min(at[0], room), at[1]), words, SMALL_LETTERS * scale, NOW)
    canvas.draw()
