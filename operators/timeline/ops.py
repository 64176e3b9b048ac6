"""Operators on the clips of a timeline."""

from __future__ import annotations

from bpy.props import EnumProperty

from ..active import active_object, face_reason
from ..annotated import Annotated
from ..base import RisoriusOperator
from ..blender_classes import Menu, Operator
from ..blender_types import Context
from ..changes import retimed
from .clips import TIMES, ClipOperator, copy_clip, end_of
from .linked import copy_choice
from .titles import clip_title


class RISORIUS_OT_add_clip(RisoriusOperator, Operator):
    """Add the emotion in the Emotion panel as a clip at the current frame"""

    bl_idname = "risorius.add_clip"
    bl_label = "Add Clip"
    bl_options = {"REGISTER", "UNDO"}
    needs_scipy = False

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only on a face."""
        return face_reason(context.object)

    def run(self, context: Context) -> str:
        """Add it, with the times of the clip that was selected."""
        obj = active_object(context)
        timeline = obj.risorius.timeline
        before = timeline.active if timeline.clips else None
        clip = timeline.clips.add()
        copy_choice(obj.risorius.emotion, clip.emotion)
        if before is not None:
            for name in TIMES:
                setattr(clip, name, getattr(timeline.clips[before], name))
        clip.start = context.scene.frame_current
        timeline.active = len(timeline.clips) - 1
        return f"Added {clip_title(clip)} at frame {clip.start}"


class RISORIUS_OT_duplicate_clip(ClipOperator, Operator):
    """Add a copy of the selected clip after its end"""

    bl_idname = "risorius.duplicate_clip"
    bl_label = "Duplicate Clip"
    bl_options = {"REGISTER", "UNDO"}

    def run(self, context: Context) -> str:
        """Copy it."""
        from ...scene.bake.timing import scene_fps

        timeline = active_object(context).risorius.timeline
        place = timeline.active
        timeline.clips.add()
        source, clip = timeline.clips[place], timeline.clips[len(timeline.clips) - 1]
        copy_clip(source, clip)
        clip.name, clip.start = source.name, end_of(source, scene_fps(context.scene))
        timeline.clips.move(len(timeline.clips) - 1, place + 1)
        timeline.active = place + 1
        return f"Duplicated {clip_title(timeline.clips[place + 1])}"


class RISORIUS_OT_remove_clip(ClipOperator, Operator):
    """Remove the selected clip from the timeline. Baked animation stays until the next bake"""

    bl_idname = "risorius.remove_clip"
    bl_label = "Remove Clip"
    bl_options = {"REGISTER", "UNDO"}

    def run(self, context: Context) -> str:
        """Remove it; the one after it, or the last, is selected then."""
        timeline = active_object(context).risorius.timeline
        place = timeline.active
        title = clip_title(timeline.clips[place])
        timeline.clips.remove(place)
        timeline.active = max(0, min(place, len(timeline.clips) - 1))
        retimed(timeline, context)
        return f"Removed {title}"


class RISORIUS_OT_move_clip(ClipOperator, Operator):
    """Move the selected clip up or down in the list. Its time does not change"""

    bl_idname = "risorius.move_clip"
    bl_label = "Move Clip"
    bl_options = {"REGISTER", "UNDO"}

    direction: Annotated[
        str,
        EnumProperty(
            name="Direction",
            description="Direction in the list",
            items=(("UP", "Up", "Move up one place"), ("DOWN", "Down", "Move down one place")),
            options={"SKIP_SAVE"},
        ),
    ]

    def run(self, context: Context) -> str:
        """Move it, and keep it selected."""
        timeline = active_object(context).risorius.timeline
        to = timeline.active + (1 if self.direction == "DOWN" else -1)
        if 0 <= to < len(timeline.clips):
            timeline.clips.move(timeline.active, to)
            timeline.active = to
        return f"{clip_title(timeline.clips[timeline.active])} is number {timeline.active + 1}"


class RISORIUS_OT_sort_clips(ClipOperator, Operator):
    """Sort the clips by start frame"""

    bl_idname = "risorius.sort_clips"
    bl_label = "Sort by Start Frame"
    bl_options = {"REGISTER", "UNDO"}

    def run(self, context: Context) -> str:
        """Sort them; the selected one stays selected."""
        timeline = active_object(context).risorius.timeline
        for place in range(len(timeline.clips)):
            first = min(range(place, len(timeline.clips)), key=lambda k: timeline.clips[k].start)
            if first != place:
                timeline.clips.move(first, place)
                active = timeline.active
                if active == first:
                    timeline.active = place
                elif place <= active < first:
                    timeline.active = active + 1
        return f"Sorted {len(timeline.clips)} clips"


class RISORIUS_OT_clear_clips(ClipOperator, Operator):
    """Remove all clips from the timeline. Baked animation stays"""

    bl_idname = "risorius.clear_clips"
    bl_label = "Remove All Clips"
    bl_options = {"REGISTER", "UNDO"}

    def run(self, context: Context) -> str:
        """Remove them."""
        timeline = active_object(context).risorius.timeline
        count = len(timeline.clips)
        timeline.clips.clear()
        timeline.active = 0
        retimed(timeline, context)
        return f"Removed {count} clip{'s' * (count != 1)}"


class RISORIUS_MT_clips(Menu):
    """More operations on clips"""

    bl_idname = "RISORIUS_MT_clips"
    bl_label = "Clips"

    def draw(self, context: Context) -> None:
        """What concerns all of them."""
        self.layout.operator(RISORIUS_OT_duplicate_clip.bl_idname, icon="DUPLICATE")
        self.layout.operator(RISORIUS_OT_sort_clips.bl_idname, icon="SORTTIME")
        self.layout.separator()
        self.layout.operator(RISORIUS_OT_clear_clips.bl_idname, icon="TRASH")
