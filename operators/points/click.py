"""Clicking the few feature points that tell where a face is; the others are found from them."""

from __future__ import annotations

import json
from typing import Any

import bpy
import numpy as np
from bpy.props import StringProperty

from ...arrays import Floats
from ...errors import RisoriusError, SceneError
from ...mpeg4 import FEATURE_POINTS
from ...progress import Work
from ...scene.mesh import world_matrix
from ...scene.points.bound import Surface
from ...scene.points.found import Finding, find_points
from ...scene.points.mirrored import MirrorPlane, plane_of_mesh
from ...scene.points.seen import Visible
from ..annotated import Annotated
from ..base import WorkOperator
from ..requirements import need_scipy
from .canvas import Canvas, text_width
from .diagram import HEIGHT, NOW, draw_diagram
from .props import redraw
from .reasons import points_reason
from .show import show_finding
from .view import Viewport

#: What is asked for, in this order, and where it lies. Left and right are the face's own.
ASKED = {
    "3.7": "outer corner of its left eye",
    "3.12": "outer corner of its right eye",
    "8.3": "left corner of its mouth",
    "8.4": "right corner of its mouth",
    "9.3": "tip of the nose",
    "2.1": "underside of the chin, in the middle",
}
#: Events that look around.
LOOKING = {
    *("MIDDLEMOUSE", "WHEELUPMOUSE", "WHEELDOWNMOUSE", "WHEELINMOUSE", "WHEELOUTMOUSE", "NDOF_MOTION"),
    *("TRACKPADPAN", "TRACKPADZOOM", "MOUSEROTATE", "MOUSESMARTZOOM", "NDOF_BUTTON_FIT", "HOME"),
    *(f"NUMPAD_{number}" for number in range(10)),
    *("NUMPAD_PERIOD", "NUMPAD_PLUS", "NUMPAD_MINUS", "LEFT_ALT", "LEFT_SHIFT", "LEFT_CTRL"),
}
LETTERS = 15.0
#: Pixels that a click may lie beside the surface: the chin's underside is its outline when seen from the front.
MISS = 14.0


class Clicks:
    """Points that have been clicked so far: name -> (3,) in the mesh's own coordinates, and how to go back."""

    def __init__(self, surface: Surface, plane: MirrorPlane | None) -> None:
        self._surface, self._plane = surface, plane
        self._steps: list[dict[str, Floats]] = []

    @property
    def has_mirror(self) -> bool:
        """Whether the mesh is the same on both sides."""
        return self._plane is not None

    @property
    def places(self) -> dict[str, Floats]:
        """All that are there."""
        return {name: place for step in self._steps for name, place in step.items()}

    @property
    def wanted(self) -> str | None:
        """The point to be clicked next; None when all are there."""
        return next((name for name in ASKED if name not in self.places), None)

    def add(self, place: Floats, *, mirror: bool) -> None:
        """Take a click for the wanted point; with `mirror` its counterpart is set too where the mesh allows."""
        name = self.wanted
        if name is None:
            return
        step = {name: place}
        other = FEATURE_POINTS[name].mirror
        if mirror and self._plane is not None and other in ASKED and other not in self.places:
            near = self._surface.nearest(self._plane.reflected(place))
            if near is not None:
                step[other] = near[0]
        self._steps.append(step)

    def back(self) -> bool:
        """Take the last click back, its counterpart with it."""
        return bool(self._steps) and self._steps.pop() is not None


class RISORIUS_OT_click_points(WorkOperator, bpy.types.Operator):
    """Click the corners of eyes and mouth, the tip of the nose and the chin. All other points are found from these"""

    bl_idname = "risorius.click_points"
    bl_label = "Click Points"
    bl_options = {"REGISTER", "UNDO"}
    title = "Finding the face from the clicks"

    clicks: Annotated[
        str,
        StringProperty(
            name="Clicks",
            description='For scripts: the points as JSON, {"3.7": [x, y, z], ...} in the coordinates of the mesh',
            options={"SKIP_SAVE"},
        ),
    ]
    _clicks: Clicks | None = None
    _handler: Any = None
    _hover: tuple[float, float] | None = None

    @classmethod
    def refusal(cls, context: Any) -> str | None:
        """Only for meshes that points can be kept with."""
        return points_reason(context.object)

    def work(self, context: Any) -> Work[Finding]:
        """Find all points from those that were clicked."""
        places = self._clicks.places if self._clicks is not None else _given(self.clicks)
        return find_points(context.object, places, scene=context.scene)

    def finish(self, context: Any, result: Finding) -> str:
        """Show them; clicks are kept so that the work can be done again."""
        if self._clicks is not None:
            self.clicks = json.dumps({name: place.tolist() for name, place in self._clicks.places.items()})
        return show_finding(self, context, result)

    def invoke(self, context: Any, event: Any) -> set[str]:
        """Ask for the first point; clicks given by a script need no asking."""
        if self.clicks or bpy.app.background or context.window is None:
            return super().invoke(context, event)
        try:
            need_scipy()
            if Viewport.of(context) is None:
                raise SceneError("Click Points", "needs a 3D viewport: start it from the sidebar")
            surface = Surface.of(context.object.data)
        except RisoriusError as refusal:
            self.report({"ERROR"}, str(refusal))
            return {"CANCELLED"}
        self._clicks = Clicks(surface, plane_of_mesh(surface))
        self._surface, self._area = surface, context.area
        state = context.window_manager.risorius.points
        self._shown, state.show = bool(state.show), False
        self._handler = bpy.types.SpaceView3D.draw_handler_add(self._draw, (context,), "WINDOW", "POST_PIXEL")
        context.window.cursor_modal_set("CROSSHAIR")
        context.window_manager.modal_handler_add(self)
        self._ask(context)
        return {"RUNNING_MODAL"}

    def modal(self, context: Any, event: Any) -> set[str]:
        """Clicks first, then the work."""
        if self._work is not None:
            return super().modal(context, event)
        if event.type in LOOKING or (event.alt and event.type == "LEFTMOUSE"):
            return {"PASS_THROUGH"}
        if event.type == "MOUSEMOVE":
            viewport = Viewport.of(context)
            self._hover = None if viewport is None else viewport.pixel(event)
            redraw()
            return {"PASS_THROUGH"}
        if event.value != "PRESS":
            return {"RUNNING_MODAL"}
        if event.type == "LEFTMOUSE":
            return self._click(context, event)
        if event.type in {"ESC", "RIGHTMOUSE"}:
            self.stop(context)
            self.report({"INFO"}, "Clicking was cancelled; nothing has been changed")
            return {"CANCELLED"}
        if event.type == "BACK_SPACE" and self._clicks is not None:
            self._clicks.back()
        if event.type == "M":
            state = context.window_manager.risorius.points
            state.mirror = not state.mirror
        self._ask(context)
        return {"RUNNING_MODAL"}

    def _click(self, context: Any, event: Any) -> set[str]:
        """Take a click on the face; after the last one the work begins."""
        viewport = Viewport.of(context)
        pixel = None if viewport is None else viewport.pixel(event)
        if viewport is None or pixel is None or _over_another_region(context, event):
            return {"PASS_THROUGH"}
        assert self._clicks is not None
        visible = Visible.of(context.object, context.evaluated_depsgraph_get())
        place = hit_near(visible, viewport, pixel, self._surface, MISS * context.preferences.system.ui_scale)
        if place is None:
            self.report({"WARNING"}, "That is not on the face: click on its surface")
            return {"RUNNING_MODAL"}
        self._clicks.add(place, mirror=bool(context.window_manager.risorius.points.mirror))
        if self._clicks.wanted is not None:
            self._ask(context)
            return {"RUNNING_MODAL"}
        self._let_go(context)
        self.start(context)
        return {"RUNNING_MODAL"}

    def _ask(self, context: Any) -> None:
        """Say in header and status bar what to click next."""
        assert self._clicks is not None
        name, count = self._clicks.wanted, len(self._clicks.places)
        if name is None:
            return
        asked = f"Click {name}, the {ASKED[name]} ({count + 1} of {len(ASKED)})"
        mirror = ""
        if self._clicks.has_mirror:
            mirror = f"   M: Mirror {'on' if context.window_manager.risorius.points.mirror else 'off'}"
        self._area.header_text_set(asked)
        keys = f"   Backspace: Undo Click{mirror}   Middle Mouse, Wheel, Numpad: Move View   Esc: Cancel"
        context.workspace.status_text_set(asked + keys)
        redraw()

    def stop(self, context: Any) -> None:
        """Let go of everything."""
        self._let_go(context)
        super().stop(context)

    def _let_go(self, context: Any) -> None:
        """End the asking."""
        if self._handler is not None:
            bpy.types.SpaceView3D.draw_handler_remove(self._handler, "WINDOW")
            self._handler = None
            context.window_manager.risorius.points.show = self._shown
            self._area.header_text_set(None)
            context.window.cursor_modal_restore()
            redraw()

    def _draw(self, context: Any) -> None:
        """The diagram, the points so far, and the name of the wanted one beside the mouse."""
        here = bpy.context
        viewport = Viewport.of(here)
        if viewport is None or here.area != self._area or here.region != viewport.region or self._clicks is None:
            return
        scale = here.preferences.system.ui_scale
        canvas, wanted, places = Canvas(), self._clicks.wanted, self._clicks.places
        corner = (50.0 * scale, 40.0 * scale)
        draw_diagram(canvas, corner, scale, wanted, places)
        visible = Visible.of(here.object, here.evaluated_depsgraph_get())
        world = world_matrix(here.object)
        for name, place in places.items():
            shown = visible.shown_place(place, self._surface)
            there = viewport.on_screen(world[:3, :3] @ shown + world[:3, 3])
            if there is not None:
                canvas.disc(there, 6.0 * scale, (0.0, 0.0, 0.0, 0.8))
                canvas.disc(there, 4.5 * scale, (0.16, 0.78, 0.86, 1.0))
                canvas.text((there[0] + 9.0 * scale, there[1] - 4.0 * scale), name, 12.0 * scale, (1.0, 1.0, 1.0, 1.0))
        if wanted is not None:
            words = f"{wanted}  {ASKED[wanted]}"
            canvas.text((corner[0], corner[1] + (HEIGHT + 10.0) * scale), words, LETTERS * scale, NOW)
            if self._hover is not None:
                at = (self._hover[0] + 14.0 * scale, self._hover[1] + 14.0 * scale)
                room = viewport.region.width - text_width(words, 12.0 * scale) - 8.0
                canvas.text((min(at[0], room), at[1]), words, 12.0 * scale, NOW)
        canvas.draw()


def hit_near(visible: Visible, viewport: Viewport, pixel: tuple[float, float], surface: Surface, miss: float) -> Any:
    """(3,) the place of the resting surface under a pixel, or under one as near to it as `miss`; None beside that."""
    for far in np.linspace(0.0, miss, 5):
        for turn in np.linspace(0.0, 2.0 * np.pi, 13 if far > 0.0 else 2)[:-1]:
            beside = (pixel[0] + far * float(np.cos(turn)), pixel[1] + far * float(np.sin(turn)))
            place = visible.hit(*viewport.ray(beside), surface)
            if place is not None:
                return place
    return None


def _given(text: str) -> dict[str, Floats]:
    """Clicks of a script.

    Raises
    ------
    SceneError : none, or no such table.
    """
    remedy = 'give them as JSON, {"3.7": [x, y, z], ...}, or use a window to click them'
    try:
        table = json.loads(text)
        return {str(name): np.array(place, dtype=np.float64) for name, place in table.items()}
    except (ValueError, TypeError, AttributeError) as problem:
        raise SceneError("Clicks", f"are missing: {remedy}") from problem


def _over_another_region(context: Any, event: Any) -> bool:
    """Whether the mouse is over sidebar, toolbar or header that lie over the viewport."""
    for region in context.area.regions:
        inside = (
            region.x <= event.mouse_x < region.x + region.width and region.y <= event.mouse_y < region.y + region.height
        )
        if region.type != "WINDOW" and inside and min(region.width, region.height) > 1:
            return True
    return False
