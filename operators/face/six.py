"""One button: the six emotions of a face, found if need be, one after another on the timeline."""

from __future__ import annotations

import bpy

from ...progress import Work
from ...scene import bake
from ...scene.bake import performance, shape_keys
from ...scene.points.found import Finding
from ...scene.points.kept import read_kept
from ..active import active_object, face_reason, target_of
from ..bake.settings import creases_wanted
from ..base import WorkOperator
from ..blender_classes import Operator
from ..blender_types import Context
from ..points.first import with_points
from ..points.look import turn_to_face
from ..points.show import show_finding


class RISORIUS_OT_bake_six(WorkOperator[list[bake.BakeResult] | Finding], Operator):
    """Bake joy, surprise, fear, anger, sadness and disgust as one shape key each, one after another on the \
timeline. If the mesh has no feature points yet, find the face first"""

    bl_idname = "risorius.bake_six"
    bl_label = "Bake Six Emotions"
    bl_options = {"REGISTER", "UNDO"}
    title = "Baking six emotions"

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only on a face that can be written to."""
        return face_reason(context.object)

    def work(self, context: Context) -> Work[list[bake.BakeResult] | Finding]:
        """Find the face if need be, then bake all six."""
        return with_points(active_object(context), lambda: self.baking(context), scene=context.scene)

    def baking(self, context: Context) -> Work[list[bake.BakeResult]]:
        """One after another; closed early, those that are done and were not there before are taken away again."""
        obj, target = active_object(context), target_of(active_object(context), context.scene)
        cues, before = performance.cues_of(performance.ARCHETYPES), set(shape_keys.read_own(obj.data).clips)
        fps, creases = bake.scene_fps(context.scene), creases_wanted(obj)
        try:
            return (yield from performance.pose_all(target, cues, fps, creases, first_frame=context.scene.frame_start))
        except GeneratorExit:
            made = set(shape_keys.read_own(obj.data).clips) - before
            if made:
                bake.clear(target, clips=sorted(made))
            raise

    def finish(self, context: Context, result: list[bake.BakeResult] | Finding) -> str:
        """Put them on the timeline, and show the first at its apex."""
        if isinstance(result, Finding):
            return show_finding(self, context, result)
        for remark in dict.fromkeys(remark for one in result for remark in one.remarks):
            self.report({"WARNING"}, remark)
        obj, scene, apex = active_object(context), context.scene, result[0].frame_range
        last = performance.line_up(target_of(obj), result)
        if not bpy.app.background:
            scene.frame_set(round(sum(apex) / 2.0))
            turn_to_face(context, read_kept(obj))
        if last > scene.frame_end:
            self.report({"WARNING"}, f"The scene ends at frame {scene.frame_end}: set End to {last} to play all six")
        frames = f"frames {scene.frame_start} to {last}"
        return f"{obj.name}: six emotions, {frames}; press the space bar over the viewport to play"
