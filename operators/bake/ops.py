"""Operators that bake, and that clear what was baked."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import bpy
from bpy.props import BoolProperty, StringProperty

from ...progress import Work, written_together
from ...scene import bake, refusals
from ...scene.bake import shape_keys
from ...scene.bake.notes import BakeKind
from ...scene.points.found import Finding
from ...scene.points.kept import has_points, read_kept
from ...scene.rig import remove_rig_clips
from ...scene.rig.beside import adding_up
from ...scene.rig.clips import rig_clips
from ...scene.rig.kept import Followed
from ..active import active_object, face_reason, target_of
from ..annotated import Annotated
from ..base import RisoriusOperator, WorkOperator
from ..blender_classes import Operator
from ..blender_types import Context, Object
from ..emotion.performance import drawn_ways, performance_of
from ..emotion.profile import Wanted, title_of, wanted_of
from ..points.first import with_points
from ..points.look import turn_to_face
from ..points.show import show_finding
from .destination import bake_reason, destination_again
from .settings import stale_clips, stale_rig_clips, timing_of
from .work import expression_work, motion_work, silent_reason, strips_work


def tell(operator: RisoriusOperator, obj: Object, results: Sequence[bake.BakeResult]) -> None:
    """Report what bakes have to say, each line once: what wants something done as warnings."""
    for line in dict.fromkeys(line for result in results for line in result.told):
        operator.report({"INFO"}, line)
    remarks = [remark for result in results for remark in result.remarks]
    for remark in dict.fromkeys([*remarks, *adding_up(obj)]):
        operator.report({"WARNING"}, remark)


class BakeOperator(WorkOperator[bake.BakeResult | Finding]):
    """What all bakes share: the face is found first where its points are not known yet."""

    _is_new = False

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only on a face on which it can be baked to what is chosen."""
        return bake_reason(context.object)

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

    def expressions(self, context: Context) -> Iterable[tuple[str, Wanted]]:
        """What is baked, by its title."""
        performance = performance_of(active_object(context), context.scene)
        return zip(performance.titles, performance.wanted, strict=True)

    def finish(self, context: Context, result: bake.BakeResult | Finding) -> str:
        """Name what was written, and remark on what the user should know."""
        if isinstance(result, Finding):
            return show_finding(self, context, result)
        tell(self, active_object(context), [result])
        for line in drawn_ways(self.expressions(context)):
            self.report({"INFO"}, line)
        self.show_apex(context)
        if self._is_new:
            turn_to_face(context, read_kept(active_object(context)))
        first, last = result.frame_range
        if result.told:
            said = f": {Followed.of(result.followed).line}" if result.followed is not None else ""
            count = f"{len(result.keys)} control{'s' * (len(result.keys) != 1)}"
            return f"Baked {result.clip} to {count}{said}, frames {first:g} to {last:g}"
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

    def expressions(self, context: Context) -> Iterable[tuple[str, Wanted]]:
        """The chosen emotion, whatever the timeline holds."""
        obj = active_object(context)
        return [(title_of(obj.risorius.emotion), wanted_of(obj))]

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
        """Only where it can be baked, and something moves."""
        return bake_reason(context.object) or silent_reason(active_object(context))

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
        """Only where it can be baked, and with clips."""
        reason = bake_reason(context.object)
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
        reason = refusals.reason(context.object, writing=False) or silent_reason(active_object(context))
        if reason is not None:
            return reason
        obj, scene = active_object(context), context.scene
        if stale_clips(obj, scene):
            return face_reason(obj)
        return None if stale_rig_clips(obj, scene) else "Everything baked is up to date"

    def baking(self, context: Context) -> Work[bake.BakeResult]:
        """Bake each kind that is out of date, as it was baked before and to what it was baked to."""
        obj, scene = active_object(context), context.scene
        stale = {("", kind) for kind in stale_clips(obj, scene).values()}
        stale |= {(note.onto, note.kind) for note in stale_rig_clips(obj, scene).values()}
        works = {
            BakeKind.EXPRESSION: expression_work,
            BakeKind.STRIP: strips_work,
            BakeKind.MOTION: motion_work,
        }
        wanted = [
            work(obj, scene, destination_again(obj, onto))
            for onto in sorted({onto for onto, _ in stale})
            for kind, work in works.items()
            if (onto, kind) in stale
        ]
        results = yield from written_together(wanted)
        return results[0] if len(results) == 1 else bake.joined(results)


class RISORIUS_OT_clear(RisoriusOperator, Operator):
    """Remove the shape keys and actions that Risorius has baked on this face, and clips from your own keys and bones. \
Your own keys, bones and animation stay"""

    bl_idname = "risorius.clear"
    bl_label = "Clear Bake"
    bl_options = {"REGISTER", "UNDO"}
    needs_scipy = False

    clip: Annotated[
        str,
        StringProperty(name="Name", description="Bake to remove. Empty: all bakes of this face", options={"SKIP_SAVE"}),
    ]
    on_rig: Annotated[
        bool,
        BoolProperty(
            name="On the Rig",
            description="Remove the clip of this name from your own keys and bones, not the new shape keys",
            default=False,
            options={"SKIP_SAVE"},
        ),
    ]

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only where there is something to clear."""
        obj = context.object
        if obj is None or not (shape_keys.has_own(obj) or rig_clips(obj)):
            return "Nothing has been baked on this face yet"
        return None

    def run(self, context: Context) -> str:
        """Remove it."""
        obj, clips, removed = active_object(context), [self.clip] if self.clip else None, []
        if not self.on_rig and shape_keys.has_own(obj):
            keys = bake.clear(target_of(obj), clips=clips)
            removed.append(f"{len(keys)} shape key{'s' * (len(keys) != 1)}")
        if self.on_rig or not self.clip:
            taken = remove_rig_clips(obj, clips)
            removed += [f"{len(taken)} clip{'s' * (len(taken) != 1)} on the rig"] if taken else []
        return f"Cleared {self.clip or 'everything baked'} on {obj.name}: {' and '.join(removed)}"
