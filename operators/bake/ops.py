"""Operators that bake, and that clear what was baked."""

from __future__ import annotations

import bpy
from bpy.props import StringProperty

from ...progress import Work
from ...scene import bake
from ...scene.bake import shape_keys
from ...scene.bake.notes import BakeKind
from ...scene.points.found import Finding
from ...scene.points.kept import has_points, read_kept
from ..active import active_object, face_reason, target_of
from ..annotated import Annotated
from ..base import RisoriusOperator, WorkOperator
from ..blender_classes import Operator
from ..blender_types import Context
from ..emotion.performance import performance_of
from ..points.first import with_points
from ..points.look import turn_to_face
from ..points.show import show_finding
from .settings import stale_clips, timing_of
from .work import expression_work, motion_work, silent_reason, strips_work


class BakeOperator(WorkOperator[bake.BakeResult | Finding]):
    """What all bakes share: the face is found first where its points are not known yet."""

    _is_new = False

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only on a face that can be written to."""
        return face_reason(context.object)

    def work(self, context: Context) -> Work[bake.BakeResult | Finding]:
        """Find the face if need be, then bake."""
        self._is_new = not has_points(active_object(context))
        return with_points(active_object(context), lambda: self.baking(context), scene=context.scene)

    def baking(self, context: Context) -> Work[bake.BakeResult]:
        """The bake itself."""
        raise NotImplementedError

    def show_apex(self, context: Context) -> None:
        """Go to where the first expression is full: at its first frame a bake looks like nothing happened."""
        if not bpy.app.background:
            context.scene.frame_set(int(performance_of(active_object(context), context.scene).apex()) + 1)

    def finish(self, context: Context, result: bake.BakeResult | Finding) -> str:
        """Name what was written, and remark on what the user should know."""
        if isinstance(result, Finding):
            return show_finding(self, context, result)
        for remark in result.remarks:
            self.report({"WARNING"}, remark)
        self.show_apex(context)
        if self._is_new:
            turn_to_face(context, read_kept(active_object(context)))
        first, last = result.frame_range
        keys = f"{len(result.keys)} shape keys" if len(result.keys) > 1 else f"shape key {result.keys[0]}"
        within = f", within {result.error * 1000.0:.2f} mm" if result.error > 0.0 else ""
        return f"Baked {result.clip}: {keys}{within}, frames {first:g} to {last:g}, action {result.action}"


class RISORIUS_OT_bake_expression(BakeOperator, Operator):
    """Bake the emotion at its apex as one shape key, with keyframes for onset, apex and offset. Easy to edit by hand"""

    bl_idname = "risorius.bake_expression"
    bl_label = "Bake Expression"
    bl_options = {"REGISTER", "UNDO"}
    title = "Baking the expression"

    def show_apex(self, context: Context) -> None:
        """Go to where the expression is full."""
        if not bpy.app.background:
            timing = timing_of(active_object(context), context.scene)
            context.scene.frame_set(int(timing.start + timing.onset * timing.fps) + 1)

    def baking(self, context: Context) -> Work[bake.BakeResult]:
        """Pose the face and write its shape."""
        return expression_work(active_object(context), context.scene)


class RISORIUS_OT_bake_motion(BakeOperator, Operator):
    """Simulate the motion of muscles, skin and jaw through all clips, or the current emotion, and bake it frame by \
frame"""

    bl_idname = "risorius.bake_motion"
    bl_label = "Bake Motion"
    bl_options = {"REGISTER", "UNDO"}
    title = "Baking the motion"

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only on a face that can be written to, and where something moves."""
        return face_reason(context.object) or silent_reason(active_object(context))

    def baking(self, context: Context) -> Work[bake.BakeResult]:
        """Simulate the face and write its motion."""
        return motion_work(active_object(context), context.scene)


class RISORIUS_OT_bake_strips(BakeOperator, Operator):
    """Bake each clip as a shape key with its own strip in the NLA editor, to move and edit by hand"""

    bl_idname = "risorius.bake_strips"
    bl_label = "Bake Strips"
    bl_options = {"REGISTER", "UNDO"}
    title = "Baking the strips"

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only on a face that can be written to, and with clips."""
        reason = face_reason(context.object)
        if reason is None and not active_object(context).risorius.timeline.clips:
            return "The timeline has no clips yet: add one with +"
        return reason or silent_reason(active_object(context))

    def baking(self, context: Context) -> Work[bake.BakeResult]:
        """Pose the face for each clip and write strips."""
        return strips_work(active_object(context), context.scene)


class RISORIUS_OT_bake_again(BakeOperator, Operator):
    """Bake again everything whose settings have changed since its last bake"""

    bl_idname = "risorius.bake_again"
    bl_label = "Bake Again"
    bl_options = {"REGISTER", "UNDO"}
    title = "Baking again"

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only where something is out of date."""
        reason = face_reason(context.object) or silent_reason(active_object(context))
        if reason is None and not stale_clips(active_object(context), context.scene):
            return "Everything baked is up to date"
        return reason

    def baking(self, context: Context) -> Work[bake.BakeResult]:
        """Bake each kind that is out of date, as it was baked before."""
        obj, scene = active_object(context), context.scene
        kinds = set(stale_clips(obj, scene).values())
        result: bake.BakeResult | None = None
        for kind, work in (
            (BakeKind.EXPRESSION, expression_work),
            (BakeKind.STRIP, strips_work),
            (BakeKind.MOTION, motion_work),
        ):
            if kind in kinds:
                result = yield from work(obj, scene)
        assert result is not None
        return result


class RISORIUS_OT_clear(RisoriusOperator, Operator):
    """Remove the shape keys and actions that Risorius has baked on this face. Your own keys stay"""

    bl_idname = "risorius.clear"
    bl_label = "Clear Bake"
    bl_options = {"REGISTER", "UNDO"}
    needs_scipy = False

    clip: Annotated[
        str,
        StringProperty(name="Name", description="Bake to remove. Empty: all bakes of this face", options={"SKIP_SAVE"}),
    ]

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only where there is something to clear."""
        if not shape_keys.has_own(context.object):
            return "Nothing has been baked on this face yet"
        return None

    def run(self, context: Context) -> str:
        """Remove it."""
        removed = bake.clear(target_of(active_object(context)), clips=[self.clip] if self.clip else None)
        what = self.clip or "everything baked"
        return f"Cleared {what} on {active_object(context).name}: {len(removed)} shape key{'s' * (len(removed) != 1)}"
