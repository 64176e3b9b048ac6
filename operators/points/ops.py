"""Operators for feature points: find them, look at one, put some back, hold on to an edited mesh, export."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
from bpy.props import EnumProperty, StringProperty
from mathutils import Vector

from ...arrays import Floats
from ...errors import RisoriusError, SceneError
from ...files import write_whole
from ...mpeg4 import FAPS, FEATURE_POINTS
from ...progress import Work
from ...scene.mesh import world_matrix
from ...scene.points.bound import followed
from ...scene.points.found import Finding, find_points
from ...scene.points.kept import KeptPoint, has_points, mesh_counts, read_kept, write_kept
from ...scene.points.seen import Visible
from ...scene.points.stored import stored_points
from ..active import active_object
from ..annotated import Annotated
from ..base import RisoriusOperator, WorkOperator
from ..blender_classes import ExportHelper, Operator
from ..blender_types import Context, Object
from .props import mark
from .reasons import no_points_reason, points_reason
from .show import show_finding, show_points
from .view import Viewport

#: How much of a face is seen after jumping to a point: times the distance between the eyes' outer corners.
CLOSE_UP = 1.2


class RISORIUS_OT_find_points(WorkOperator[Finding], Operator):
    """Find the face of this mesh and its feature points, in any direction and at any size"""

    bl_idname = "risorius.find_points"
    bl_label = "Find Face"
    bl_options = {"REGISTER", "UNDO"}
    title = "Finding the face"

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only for meshes that points can be kept with."""
        return points_reason(context.object)

    def work(self, context: Context) -> Work[Finding]:
        """Find and keep them."""
        return find_points(active_object(context), scene=context.scene)

    def finish(self, context: Context, result: Finding) -> str:
        """Show them."""
        return show_finding(self, context, result)


class OnePoint(RisoriusOperator):
    """What operators about one point share: its name, and a tooltip that says what it is for."""

    needs_scipy = False

    point: Annotated[str, StringProperty(name="Point", description="Name of the feature point", options={"SKIP_SAVE"})]

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only where there are points."""
        return no_points_reason(context.object)

    @classmethod
    def description(cls, context: Context, properties: OnePoint) -> str:
        """What the operator does, what the point is, and why it is needed."""
        does = str(cls.__doc__)
        return f"{does}.\n{why_needed(properties.point)}" if properties.point in FEATURE_POINTS else does


def why_needed(name: str) -> str:
    """What a feature point is for, in a few lines."""
    point = FEATURE_POINTS[name]
    moved = [f"{number} {FAPS[number].name}" for number in point.faps]
    moves = (
        f"Moved by FAP {', '.join(moved)}" if moved else "No FAP moves it; it defines the position and size of the face"
    )
    return f"{name}: {point.location}.\n{moves}"


class RISORIUS_OT_jump_to_point(OnePoint, Operator):
    """Zoom to this point"""

    bl_idname = "risorius.jump_to_point"
    bl_label = "View Point"
    bl_options = {"INTERNAL"}

    def run(self, context: Context) -> str:
        """Mark it, and turn a 3D viewport towards it."""
        obj, state = active_object(context), context.window_manager.risorius.points
        kept = followed(read_kept(obj), obj.data).kept
        if self.point not in kept.points:
            raise SceneError(obj.name, f"has no feature point {self.point}")
        show_points(context)
        mark(state, self.point)
        viewport = Viewport.of(context)
        if viewport is not None:
            visible = Visible.of(obj, context.evaluated_depsgraph_get())
            places = visible.places(kept)
            extent = float(np.linalg.norm(np.ptp(np.array(list(places.values())), axis=0)))
            viewport.view.view_location = Vector(places[self.point])
            viewport.view.view_distance = CLOSE_UP * extent
            if visible.hidden({**places}, *viewport.eye())[list(places).index(self.point)]:
                viewport.view.view_rotation = _outward(visible, places[self.point]).to_track_quat("Z", "Y")
        return label_of(self.point)


def _outward(visible: Visible, place: Floats) -> Vector:
    """The direction in the world in which the surface at a place looks."""
    inverse = np.linalg.inv(world_matrix(visible.obj))
    found, _, normal, _ = visible.shown.closest_point_on_mesh(Vector(inverse[:3, :3] @ place + inverse[:3, 3]))
    return Vector(inverse[:3, :3].T @ np.array(normal)).normalized() if found else Vector((0.0, -1.0, 0.0))


def label_of(name: str) -> str:
    """Number and place in words."""
    return f"{name}: {FEATURE_POINTS[name].location}"


class RISORIUS_OT_reset_points(OnePoint, Operator):
    """Reset points to where they were found, clicked or imported"""

    bl_idname = "risorius.reset_points"
    bl_label = "Reset Points"
    bl_options = {"REGISTER", "UNDO"}

    which: Annotated[
        str,
        EnumProperty(
            name="Which",
            description="Points to reset",
            items=(
                ("ONE", "One", "Reset the named point"),
                ("LEFT", "Left Side", "Reset all points on the subject's left"),
                ("RIGHT", "Right Side", "Reset all points on the subject's right"),
                ("ALL", "All", "Reset all points"),
            ),
            default="ALL",
        ),
    ]

    def run(self, context: Context) -> str:
        """Put them back, and those back in that were lost."""
        obj = active_object(context)
        now = followed(read_kept(obj), obj.data).kept
        given = followed(read_kept(obj, as_given=True), obj.data).kept
        if self.which == "ONE":
            names = [self.point]
        else:
            names = [n for n in given.points if self.which == "ALL" or FEATURE_POINTS[n].side.name == self.which]
        back = {name: given.points[name] for name in names if name in given.points}
        if not back:
            raise SceneError(obj.name, f"has no point {self.point} to reset")
        changed = sum(now.points.get(name) != point for name, point in back.items())
        write_kept(obj, replace(now, points=in_order({**now.points, **back})))
        return f"{obj.name}: {changed} point{'s' * (changed != 1)} reset"


def in_order(points: dict[str, KeptPoint]) -> dict[str, KeptPoint]:
    """Points in the standard's order."""
    return {name: points[name] for name in FEATURE_POINTS if name in points}


class RISORIUS_OT_follow_mesh(RisoriusOperator, Operator):
    """Transfer the feature points to the edited mesh, and report the points that are lost"""

    bl_idname = "risorius.follow_mesh"
    bl_label = "Update Points"
    bl_options = {"REGISTER", "UNDO"}
    needs_scipy = False

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only where the mesh has been edited."""
        reason = no_points_reason(context.object)
        if reason is None and not edited(active_object(context)):
            return "The mesh has not been edited since its points were found"
        return reason

    def run(self, context: Context) -> str:
        """Bind them anew."""
        obj = active_object(context)
        now = followed(read_kept(obj), obj.data)
        write_kept(obj, now.kept)
        if now.lost:
            self.report({"WARNING"}, f"{obj.name}: points lost in the edit: {', '.join(now.lost)}")
        return f"{obj.name}: {len(now.kept.points)} feature points updated, {len(now.lost)} lost"


def edited(obj: Object) -> bool:
    """Whether the mesh has another number of vertices or polygons than when its points were kept."""
    try:
        return has_points(obj) and read_kept(obj).counts != mesh_counts(obj.data)
    except RisoriusError:
        return False


class RISORIUS_OT_export_points(RisoriusOperator, Operator, ExportHelper):
    """Export the feature points of this mesh to a JSON file for Import Feature Points"""

    bl_idname = "risorius.export_points"
    bl_label = "Export Feature Points"
    bl_options = {"REGISTER"}
    needs_scipy = False

    filename_ext = ".json"
    filter_glob: Annotated[str, StringProperty(default="*.json", options={"HIDDEN"})]

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only where there are points."""
        return no_points_reason(context.object)

    def run(self, context: Context) -> str:
        """Write them with how sure they are and where they came from."""
        obj = active_object(context)
        points, kept = stored_points(obj), read_kept(obj).points
        table = {
            "mesh": obj.data.name,
            "vertex_count": len(obj.data.vertices),
            "points": {name: point if isinstance(point, int) else list(point) for name, point in points.items()},
            "confidence": {name: kept[name].confidence for name in points},
            "origin": {name: kept[name].origin.value for name in points},
        }
        write_whole(self.filepath, json.dumps(table, indent=1) + "\n")
        return f"Wrote {len(points)} feature points to {self.filepath}"
