"""Clicking the few feature points that tell where a face is; the others are found from them."""

from __future__ import annotations

import bpy
from bpy.props import StringProperty

from ...errors import RisoriusError, SceneError
from ...progress import Work
from ...scene.blender_types import Event
from ...scene.points.bound import Surface
from ...scene.points.found import Finding, find_points
from ...scene.points.mirrored import plane_of_mesh
from ...scene.points.seen import Visible
from ..active import active_object
from ..annotated import Annotated
from ..base import WorkOperator
from ..blender_classes import Operator
from ..blender_types import Context
from ..held import Held
from ..requirements import need_scipy
from ..screen import redraw_viewports, show_status
from .click_drawing import draw_clicks
from .clicks import ASKED, Clicks, clicks_of
from .reasons import points_reason
from .show import show_finding
from .view import Viewport, hit_near, is_covered

#: Events that look around.
LOOKING = {
    *("MIDDLEMOUSE", "WHEELUPMOUSE", "WHEELDOWNMOUSE", "WHEELINMOUSE", "WHEELOUTMOUSE", "NDOF_MOTION"),
    *("TRACKPADPAN", "TRACKPADZOOM", "MOUSEROTATE", "MOUSESMARTZOOM", "NDOF_BUTTON_FIT", "HOME"),
    *(f"NUMPAD_{number}" for number in range(10)),
    *("NUMPAD_PERIOD", "NUMPAD_PLUS", "NUMPAD_MINUS", "LEFT_ALT", "LEFT_SHIFT", "LEFT_CTRL"),
}
#: Pixels that a click may lie beside the surface: the chin's underside is its outline when seen from the front.
MISS = 14.0


class RISORIUS_OT_click_points(WorkOperator[Finding], Operator):
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
    #: What has been clicked, in a window.
    _clicks: Clicks | None = None
    #: How the window is given back.
    _asking: Held | None = None

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only for meshes that points can be kept with."""
        return points_reason(context.object)

    def work(self, context: Context) -> Work[Finding]:
        """Find all points from those that were clicked."""
        places = self._clicks.places if self._clicks is not None else clicks_of(self.clicks)
        return find_points(active_object(context), places, scene=context.scene)

    def finish(self, context: Context, result: Finding) -> str:
        """Show them; clicks are kept so that the work can be done again."""
        if self._clicks is not None:
            self.clicks = self._clicks.to_json()
        return show_finding(self, context, result)

    def invoke(self, context: Context, event: Event) -> set[str]:
        """Ask for the first point; clicks given by a script need no asking."""
        area, window = context.area, context.window
        if self.clicks or bpy.app.background or window is None:
            return super().invoke(context, event)
        try:
            need_scipy()
            if area is None or Viewport.of(context) is None:
                raise SceneError("Click Points", "needs a 3D viewport: start it from the sidebar")
            surface = Surface.of(active_object(context).data)
        except RisoriusError as refusal:
            self.report({"ERROR"}, str(refusal))
            return {"CANCELLED"}
        self._clicks = Clicks(surface, plane_of_mesh(surface))
        self._asking = asking = Held()
        asking.gives_back(redraw_viewports)
        asking.gives_back(area.header_text_set, None)
        points = context.window_manager.risorius.points
        asking.gives_back(setattr, points, "show", points.show)
        points.show = False
        handler = bpy.types.SpaceView3D.draw_handler_add(draw_clicks, (self._clicks, area), "WINDOW", "POST_PIXEL")
        asking.gives_back(bpy.types.SpaceView3D.draw_handler_remove, handler, "WINDOW")
        window.cursor_modal_set("CROSSHAIR")
        asking.gives_back(window.cursor_modal_restore)
        asking.holds_status(context)
        context.window_manager.modal_handler_add(self)
        self._ask(context, self._clicks)
        return {"RUNNING_MODAL"}

    def modal(self, context: Context, event: Event) -> set[str]:
        """Clicks first, then the work."""
        clicks, points = self._clicks, context.window_manager.risorius.points
        if self._work is not None or clicks is None:
            return super().modal(context, event)
        if event.type in LOOKING or (event.alt and event.type == "LEFTMOUSE"):
            return {"PASS_THROUGH"}
        if event.type == "MOUSEMOVE":
            viewport = Viewport.of(context)
            clicks.hover = None if viewport is None else viewport.pixel(event)
            redraw_viewports()
            return {"PASS_THROUGH"}
        if event.value != "PRESS":
            return {"RUNNING_MODAL"}
        if event.type == "LEFTMOUSE":
            return self._click(context, event, clicks)
        if event.type in {"ESC", "RIGHTMOUSE"}:
            self.stop(context)
            self.report({"INFO"}, "Clicking was cancelled; nothing has been changed")
            return {"CANCELLED"}
        if event.type == "BACK_SPACE":
            clicks.back()
        if event.type == "M":
            points.mirror = not points.mirror
        self._ask(context, clicks)
        return {"RUNNING_MODAL"}

    def _click(self, context: Context, event: Event, clicks: Clicks) -> set[str]:
        """Take a click on the face; after the last one the work begins."""
        area, viewport = context.area, Viewport.of(context)
        pixel = None if viewport is None else viewport.pixel(event)
        if area is None or viewport is None or pixel is None or is_covered(area, event):
            return {"PASS_THROUGH"}
        visible = Visible.of(active_object(context), context.evaluated_depsgraph_get())
        place = hit_near(visible, viewport, pixel, clicks.surface, MISS * context.preferences.system.ui_scale)
        if place is None:
            self.report({"WARNING"}, "That is not on the face: click on its surface")
            return {"RUNNING_MODAL"}
        clicks.add(place, mirror=context.window_manager.risorius.points.mirror)
        if clicks.wanted is not None:
            self._ask(context, clicks)
            return {"RUNNING_MODAL"}
        self._let_go()
        self.begin(context)
        return {"RUNNING_MODAL"}

    def _ask(self, context: Context, clicks: Clicks) -> None:
        """Say in header and status bar what to click next."""
        name, count = clicks.wanted, len(clicks.places)
        if name is None:
            return
        asked = f"Click {name}, the {ASKED[name]} ({count + 1} of {len(ASKED)})"
        mirror = ""
        if clicks.has_mirror:
            mirror = f"   M: Mirror {'on' if context.window_manager.risorius.points.mirror else 'off'}"
        if context.area is not None:
            context.area.header_text_set(asked)
        keys = f"   Backspace: Undo Click{mirror}   Middle Mouse, Wheel, Numpad: Move View   Esc: Cancel"
        show_status(context, asked + keys)
        redraw_viewports()

    def stop(self, context: Context) -> None:
        """Let go of everything."""
        self._let_go()
        super().stop(context)

    def _let_go(self) -> None:
        """End the asking, and give the window back."""
        if self._asking is not None:
            self._asking.close()
            self._asking = None
