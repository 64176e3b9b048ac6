"""Presets for a clip's times, and the menu of them."""

from __future__ import annotations

from bpy.props import EnumProperty

from ...mpeg4.timing import load_timings
from ..active import active_object
from ..annotated import Annotated
from ..blender_classes import Menu, Operator
from ..blender_types import Context
from .clips import TIMES, ClipOperator
from .titles import clip_title


class RISORIUS_OT_time_clip(ClipOperator, Operator):
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
