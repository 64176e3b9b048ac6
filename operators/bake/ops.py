"""Operators that bake, and that clear what was baked."""

from __future__ import annotations

from typing import Any

import bpy

from ...scene import bake, shape_keys
from ...scene.motion import CueMotion
from ...scene.points_found import Finding
from ...scene.points_kept import has_points, read_kept
from ...scene.progress import Work
from ..active import face_reason, target_of
from ..base import RisoriusOperator, WorkOperator
from ..emotion.profile import frame_of, profile_of
from ..points.first import with_points
from ..points.look import turn_to_face
from ..points.show import show_finding

MOTION_SUFFIX = " motion"


def clip_name(obj: Any, *, motion: bool = False) -> str:
    """The name the user gave, or the emotion's."""
    chosen = str(obj.risorius.bake.clip).strip() or str(obj.risorius.emotion.word)
    return chosen + MOTION_SUFFIX if motion else chosen


def timing_of(obj: Any, context: Any) -> bake.ClipTiming:
    """The timing chosen for the object."""
    chosen = obj.risorius.bake
    return bake.ClipTiming(
        start=float(chosen.start),
        onset=chosen.onset,
        apex=chosen.apex,
        offset=chosen.offset,
        fps=bake.scene_fps(context.scene),
    )


def creases_wanted(obj: Any) -> bool | None:
    """What the user has said about creases; None where nothing, and the material decides."""
    chosen = obj.risorius.bake
    return bool(chosen.creases) if chosen.is_property_set("creases") else None


def show_apex(context: Any) -> None:
    """Go to the frame where the expression is full: at its first frame a bake looks like nothing happened."""
    if not bpy.app.background:
        timing = timing_of(context.object, context)
        context.scene.frame_set(int(timing.start + timing.onset * timing.fps) + 1)


class BakeOperator(WorkOperator):
    """What both bakes share: the face is found first where its points are not known yet."""

    @classmethod
    def refusal(cls, context: Any) -> str | None:
        """Only on a face that can be written to."""
        return face_reason(context.object)

    def work(self, context: Any) -> Work[bake.BakeResult | Finding]:
        """Find the face if need be, then bake."""
        self._is_new = not has_points(context.object)
        return with_points(context.object, lambda: self.baking(context), scene=context.scene)

    def baking(self, context: Any) -> Work[bake.BakeResult]:
        """The bake itself."""
        raise NotImplementedError

    def finish(self, context: Any, result: bake.BakeResult | Finding) -> str:
        """Name what was written, and remark on what the user should know."""
        if isinstance(result, Finding):
            return show_finding(self, context, result)
        for remark in result.remarks:
            self.report({"WARNING"}, remark)
        show_apex(context)
        if self._is_new:
            turn_to_face(context, read_kept(context.object))
        first, last = result.frame_range
        keys = f"{len(result.keys)} shape keys" if len(result.keys) > 1 else f"shape key {result.keys[0]}"
        within = f", within {result.error * 1000.0:.2f} mm" if result.error > 0.0 else ""
        return f"Baked {result.clip}: {keys}{within}, frames {first:g} to {last:g}, action {result.action}"


class RISORIUS_OT_bake_expression(BakeOperator, bpy.types.Operator):
    """Bake the emotion at its apex as one shape key, with keyframes for onset, apex and offset. Easy to edit by hand"""

    bl_idname = "risorius.bake_expression"
    bl_label = "Bake Expression"
    bl_options = {"REGISTER", "UNDO"}
    title = "Baking the expression"

    def baking(self, context: Any) -> Work[bake.BakeResult]:
        """Pose the face and write its shape."""
        obj = context.object
        profile = profile_of(obj.risorius.emotion)
        return bake.bake_expression(
            target_of(obj),
            frame_of(profile, obj.risorius.emotion.seed),
            clip=clip_name(obj),
            timing=timing_of(obj, context),
            drive=obj.risorius.emotion.drive,
            emotion=profile.weights,
            creases=creases_wanted(obj),
        )


class RISORIUS_OT_bake_motion(BakeOperator, bpy.types.Operator):
    """Simulate how muscles, skin and jaw move into the emotion and out of it, and bake that motion frame by frame"""

    bl_idname = "risorius.bake_motion"
    bl_label = "Bake Motion"
    bl_options = {"REGISTER", "UNDO"}
    title = "Baking the motion"

    def baking(self, context: Any) -> Work[bake.BakeResult]:
        """Simulate the face and write its motion."""
        from ... import api

        obj = context.object
        timing = timing_of(obj, context)
        cue = api.Cue(
            profile_of(obj.risorius.emotion),
            onset=timing.onset,
            apex=timing.apex,
            offset=timing.offset,
            seed=obj.risorius.emotion.seed or None,
        )
        return bake.bake_motion(
            target_of(obj),
            CueMotion([cue]),
            clip=clip_name(obj, motion=True),
            start=timing.start,
            fps=timing.fps,
            drive=obj.risorius.emotion.drive,
            creases=creases_wanted(obj),
        )


class RISORIUS_OT_clear(RisoriusOperator, bpy.types.Operator):
    """Remove what Risorius has baked on this face: its own shape keys and actions. Yours stay"""

    bl_idname = "risorius.clear"
    bl_label = "Clear"
    bl_options = {"REGISTER", "UNDO"}
    needs_scipy = False

    clip: bpy.props.StringProperty(  # type: ignore[valid-type]
        name="Name", description="Which bake to remove. Empty: all of this face", options={"SKIP_SAVE"}
    )

    @classmethod
    def refusal(cls, context: Any) -> str | None:
        """Only where there is something to clear."""
        if not shape_keys.has_own(context.object):
            return "Nothing has been baked on this face yet"
        return None

    def run(self, context: Any) -> str:
        """Remove it."""
        removed = bake.clear(target_of(context.object), clips=[self.clip] if self.clip else None)
        what = self.clip or "everything baked"
        return f"Cleared {what} on {context.object.name}: {len(removed)} shape key{'s' * (len(removed) != 1)}"


CLASSES = (RISORIUS_OT_bake_expression, RISORIUS_OT_bake_motion, RISORIUS_OT_clear)
