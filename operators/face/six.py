"""One button: the six emotions of a face, found if need be, one after another on the timeline."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import bpy

from ...progress import Work
from ...scene import bake
from ...scene.bake import performance
from ...scene.points.found import Finding
from ...scene.points.kept import read_kept
from ...scene.rig import bake_expressions_onto
from ...scene.rig.baking import Expression
from ...scene.rig.destinations import BakeTo, find_rig
from ..active import active_object, target_of
from ..bake.destination import bake_reason, destination_of
from ..bake.ops import tell
from ..bake.settings import creases_wanted
from ..base import WorkOperator
from ..blender_classes import Operator
from ..blender_types import Context
from ..points.first import with_points
from ..points.look import turn_to_face
from ..points.show import show_finding

if TYPE_CHECKING:
    from ...api import Cue


class RISORIUS_OT_bake_six(WorkOperator[list[bake.BakeResult] | Finding], Operator):
    """Bake joy, surprise, fear, anger, sadness and disgust one after another on the timeline: as one shape key each, \
or to your own keys or bones as the Bake panel says. If the mesh has no feature points yet, find the face first"""

    bl_idname = "risorius.bake_six"
    bl_label = "Bake Six Emotions"
    bl_options = {"REGISTER", "UNDO"}
    title = "Baking six emotions"

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only on a face on which it can be baked to what is chosen."""
        return bake_reason(context.object)

    def work(self, context: Context) -> Work[list[bake.BakeResult] | Finding]:
        """Find the face if need be, then bake all six."""
        return with_points(active_object(context), lambda: self.baking(context), scene=context.scene)

    def baking(self, context: Context) -> Work[list[bake.BakeResult]]:
        """One after another on the timeline; all six or, closed early, none."""
        obj, target = active_object(context), target_of(active_object(context), context.scene)
        cues = performance.cues_of(performance.ARCHETYPES)
        fps, creases = bake.scene_fps(context.scene), creases_wanted(obj)
        where, start = destination_of(obj), context.scene.frame_start
        if where.to is not BakeTo.NEW:
            expressions = [_expression(cue, start, fps) for cue in cues]
            return (yield from bake_expressions_onto(target, expressions, find_rig(where.to), onto=where.onto))
        return (yield from performance.pose_all(target, cues, fps, creases, first_frame=start))

    def finish(self, context: Context, result: list[bake.BakeResult] | Finding) -> str:
        """Put them on the timeline, and show the first at its apex."""
        if isinstance(result, Finding):
            return show_finding(self, context, result)
        obj, scene, apex = active_object(context), context.scene, result[0].frame_range
        on_rig = any(one.followed is not None for one in result)
        last = math.ceil(result[-1].frame_range[1]) if on_rig else performance.line_up(target_of(obj), result)
        tell(self, obj, result)
        if not bpy.app.background:
            scene.frame_set(round(sum(apex) / 2.0))
            turn_to_face(context, read_kept(obj))
        if last > scene.frame_end:
            self.report({"WARNING"}, f"The scene ends at frame {scene.frame_end}: set End to {last} to play all six")
        frames = f"frames {scene.frame_start} to {last}"
        if on_rig:
            shares = [f"{one.clip} {one.followed.explained:.0%}" for one in result if one.followed is not None]
            return f"{obj.name}: six emotions on its own controls, {frames}: {', '.join(shares)}"
        return f"{obj.name}: six emotions, {frames}; press the space bar over the viewport to play"


def _expression(cue: Cue, start: int, fps: float) -> Expression:
    """A cue as a clip on a rig, from the scene's first frame on."""
    first = start + cue.start * fps
    timing = bake.ClipTiming(cue.onset, cue.apex, cue.offset, start=first, fps=fps)
    return Expression(str(cue.profile.word), cue.profile.frame(), timing, cue.peak, cue.profile.weights)
