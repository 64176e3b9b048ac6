"""Looking at the face: turning a 3D viewport to its front, as near as its points need."""

from __future__ import annotations

import bpy
import numpy as np
from mathutils import Matrix, Vector

from ...arrays import Floats
from ...mpeg4 import FEATURE_POINTS
from ...scene.points.bound import followed
from ...scene.points.kept import KeptPoints, read_kept
from ...scene.points.seen import Visible
from ..active import active_object
from ..base import RisoriusOperator
from ..blender_classes import Operator
from ..blender_types import Context
from .reasons import no_points_reason
from .view import Viewport

#: How much is seen: times the diagonal of all points.
FRAMED = 1.5
#: A face whose points fill less of the viewport's height than this is looked at from nearer.
SMALL = 0.3
#: And one of which more points than this share are hidden, from the front.
TURNED = 0.6


def front_of(places: dict[str, Floats]) -> Matrix | None:
    """(3, 3) a view's rotation that looks at a face from its front; None where its points do not tell which that is."""
    pairs = [(n, p.mirror) for n, p in FEATURE_POINTS.items() if p.mirror in places and n in places]
    sides = [places[n] - places[m] for n, m in pairs if m is not None and FEATURE_POINTS[n].side.value == "left"]
    eyes, mouth = ([places[n] for n in names if n in places] for names in (("3.7", "3.12"), ("8.3", "8.4")))
    if not (sides and eyes and mouth):
        return None
    left, up = np.mean(sides, axis=0), np.mean(eyes, axis=0) - np.mean(mouth, axis=0)
    front = np.cross(left, up)
    up = np.cross(front, left)
    axes = np.array([axis / np.linalg.norm(axis) for axis in (left, up, front)])
    return Matrix(axes.T.tolist()) if np.isfinite(axes).all() else None


def look_at_face(viewport: Viewport, places: dict[str, Floats]) -> None:
    """Turn a viewport to the front of a face whose points lie there in the world."""
    all_places = np.array(list(places.values()))
    low, high = all_places.min(axis=0), all_places.max(axis=0)
    viewport.view.view_location = Vector((low + high) / 2.0)
    viewport.view.view_distance = FRAMED * float(np.linalg.norm(high - low))
    front = front_of(places)
    if front is not None:
        viewport.view.view_rotation = front.to_quaternion()


def seen_badly(viewport: Viewport, visible: Visible, places: dict[str, Floats]) -> bool:
    """Whether the face is small in the viewport, out of it, or turned away."""
    spots = [viewport.on_screen(place) for place in places.values()]
    inside = [s for s in spots if s is not None and 0 <= s[0] < viewport.region.width and s[1] >= 0]
    if len(inside) < len(spots):
        return True
    height = max(s[1] for s in inside) - min(s[1] for s in inside)
    small = not SMALL * viewport.region.height < height <= viewport.region.height
    return small or float(np.mean(visible.hidden(places, *viewport.eye()))) > TURNED


def turn_to_face(context: Context, kept: KeptPoints, *, always: bool = False) -> None:
    """Look at the active face in the viewport of the context, if there is one and it is seen badly there."""
    viewport = None if bpy.app.background else Viewport.of(context)
    if viewport is None:
        return
    visible = Visible.of(active_object(context), context.evaluated_depsgraph_get())
    places = visible.places(kept)
    if places and (always or seen_badly(viewport, visible, places)):
        look_at_face(viewport, places)


class RISORIUS_OT_look_at_face(RisoriusOperator, Operator):
    """View this face from the front"""

    bl_idname = "risorius.look_at_face"
    bl_label = "View Face"
    bl_options = {"INTERNAL"}
    needs_scipy = False

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only where there are points."""
        return no_points_reason(context.object)

    def run(self, context: Context) -> str:
        """Turn the viewport."""
        obj = active_object(context)
        turn_to_face(context, followed(read_kept(obj), obj.data).kept, always=True)
        return f"View of {obj.name} from the front"
