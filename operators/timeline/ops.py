"""Operators on the clips of a timeline."""

from __future__ import annotations

from bpy.props import EnumProperty

from ...mpeg4.timing import load_timings
from ..active import active_object, face_reason
from ..annotated import Annotated
from ..base import RisoriusOperator
from ..blender_classes import Menu, Operator
from ..blender_types import Context
from ..changes import retimed
from .linked import copy_choice
from .props import RISORIUS_PG_clip, active_clip
from .titles import clip_title

#: What of a clip a timing preset says.
TIMES = ("onset", "apex", "offset", "peak", "ramp")


def copy_clip(source: RISORIUS_PG_clip, target: RISORIUS_PG_clip) -> None:
    """Copy a clip, all but its name."""
    copy_choice(source.emotion, target.emotion)
    for name in (*TIMES, "start", "mute", "solo"):
        setattr(target, name, getattr(source, name))


def end_of(clip: RISORIUS_PG_clip, fps: float) -> int:
    """The first frame at which a clip is over."""
    return int(clip.start + round((clip.onset + clip.apex + clip.offset) * fps))


class _ClipOperator(RisoriusOperator):
    """What the operators on the active clip share."""

    needs_scipy = False

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only where a clip is selected."""
        if context.object is None:
            return "There is no active object"
        if active_clip(context.object.risorius.timeline) is None:
            return "The timeline has no clips yet: add one with +"
        return None


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


class RISORIUS_OT_duplicate_clip(_ClipOperator, Operator):
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


class RISORIUS_OT_remove_clip(_ClipOperator, Operator):
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


class RISORIUS_OT_move_clip(_ClipOperator, Operator):
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


class RISORIUS_OT_sort_clips(_ClipOperator, Operator):
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


class RISORIUS_OT_clear_clips(_ClipOperator, Operator):
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


class RISORIUS_OT_time_clip(_ClipOperator, Operator):
    """Set onset, apex and offset of the selected clip from a preset"""

    bl_idname = "risorius.time_clip"
    bl_label = "Timing"
    bl_options = {"REGISTER", "UNDO"}

    timing: Annotated[
        str,
        EnumProperty(
            name="Timing",
            description="Timing preset to use",
            items=[(name, name.capitalize(), timing.reason) for name, timing in load_timings().items()],
            options={"SKIP_SAVE"},
        ),
    ]

    @classmethod
    def description(cls, context: Context, properties: RISORIUS_OT_time_clip) -> str:
        """What the preset says of itself, with its times."""
        timing = load_timings()[properties.timing]
        times = f"onset {timing.onset:g} s, apex {timing.apex:g} s, offset {timing.offset:g} s"
        return f"{timing.reason} {times[0].upper()}{times[1:]}, peak {timing.peak:g}"

    def run(self, context: Context) -> str:
        """Take them."""
        timeline, timing = active_object(context).risorius.timeline, load_timings()[self.timing]
        clip = timeline.clips[timeline.active]
        for name in TIMES:
            setattr(clip, name, getattr(timing, name))
        return f"{clip_title(clip)}: {self.timing}"


class RISORIUS_MT_clip_timing(Menu):
    """Set the times of the selected clip from a preset"""

    bl_idname = "RISORIUS_MT_clip_timing"
    bl_label = "Timing"

    def draw(self, context: Context) -> None:
        """One entry for each."""
        for name in load_timings():
            self.layout.operator(RISORIUS_OT_time_clip.bl_idname, text=name.capitalize()).timing = name


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
