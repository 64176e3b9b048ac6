"""The panel of the timeline: the list of clips, and the times of the selected one."""

from __future__ import annotations

from ..active import active_object
from ..blender_classes import Panel, UIList
from ..blender_types import Context, UILayout
from ..sidebar import MeshSidebar
from .colours import icon_of
from .ops import (
    RISORIUS_MT_clips,
    RISORIUS_OT_add_clip,
    RISORIUS_OT_duplicate_clip,
    RISORIUS_OT_move_clip,
    RISORIUS_OT_remove_clip,
)
from .props import RISORIUS_PG_clip, RISORIUS_PG_timeline, active_clip
from .timing import RISORIUS_MT_clip_timing
from .titles import clip_title

#: The menu of preset files, by name: the library knows the timeline, and not the other way round.
LIBRARY = "RISORIUS_MT_library"

#: Rows of the list.
ROWS = 5


class RISORIUS_UL_clips(UIList):
    """Clips of the active face: name, first frame, solo, mute."""

    def draw_item(
        self,
        context: Context,
        layout: UILayout,
        data: RISORIUS_PG_timeline,
        item: RISORIUS_PG_clip,
        icon: int,
        active_data: object,
        active_property: str,
    ) -> None:
        """One clip."""
        silent = (item.mute and not item.solo) or (not item.solo and any(clip.solo for clip in data.clips))
        split = layout.split(factor=0.6, align=True)
        split.active = not silent
        split.label(text=clip_title(item), icon_value=icon_of(item.emotion))
        row = split.row(align=True)
        row.label(text=str(item.start))
        row.prop(item, "solo", text="", icon="SOLO_ON" if item.solo else "SOLO_OFF", emboss=False)
        row.prop(item, "mute", text="", icon="HIDE_ON" if item.mute else "HIDE_OFF", emboss=False)


class RISORIUS_PT_timeline(MeshSidebar, Panel):
    """Expressions in time."""

    bl_label = "Timeline"
    bl_parent_id = "RISORIUS_PT_main"

    def draw(self, context: Context) -> None:
        """The list, then what is selected in it."""
        layout, timeline = self.layout, active_object(context).risorius.timeline
        if not timeline.clips:
            column = layout.column(align=True)
            column.scale_y = 1.2
            column.operator(RISORIUS_OT_add_clip.bl_idname, icon="ADD")
            column.menu(LIBRARY, icon="PRESET")
            hint = layout.column(align=True)
            hint.label(text="Without clips the emotion above", icon="INFO")
            hint.label(text="plays from its start frame.", icon="BLANK1")
            return
        row = layout.row()
        row.template_list("RISORIUS_UL_clips", "", timeline, "clips", timeline, "active", rows=ROWS)
        side = row.column(align=True)
        side.operator(RISORIUS_OT_add_clip.bl_idname, text="", icon="ADD")
        side.operator(RISORIUS_OT_remove_clip.bl_idname, text="", icon="REMOVE")
        side.operator(RISORIUS_OT_duplicate_clip.bl_idname, text="", icon="DUPLICATE")
        side.menu(RISORIUS_MT_clips.bl_idname, text="", icon="DOWNARROW_HLT")
        side.operator(RISORIUS_OT_move_clip.bl_idname, text="", icon="TRIA_UP").direction = "UP"
        side.operator(RISORIUS_OT_move_clip.bl_idname, text="", icon="TRIA_DOWN").direction = "DOWN"
        layout.menu(LIBRARY, icon="PRESET")
        self._draw_clip(layout, timeline)

    def _draw_clip(self, layout: UILayout, timeline: RISORIUS_PG_timeline) -> None:
        """Times of the selected clip."""
        clip = active_clip(timeline)
        if clip is None:
            return
        layout.prop(timeline, "linked", icon="LINKED" if timeline.linked else "UNLINKED", toggle=True)
        column = layout.column(align=True)
        column.use_property_split, column.use_property_decorate = True, False
        column.prop(clip, "name", placeholder=clip_title(clip))
        column.menu(RISORIUS_MT_clip_timing.bl_idname, icon="PRESET")
        for name in ("start", "onset", "apex", "offset"):
            column.prop(clip, name)
        column.prop(clip, "peak", slider=True)
        column.prop(clip, "ramp")


class RISORIUS_PT_variation(MeshSidebar, Panel):
    """What makes the performance look alive."""

    bl_label = "Natural Variation"
    bl_parent_id = "RISORIUS_PT_timeline"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: Context) -> None:
        """Each with its seed."""
        variation = active_object(context).risorius.timeline.variation
        column = self.layout.column(align=True)
        for name in ("draws", "blinks", "head", "eyes"):
            row = column.split(factor=0.68, align=True)
            row.prop(variation, name, slider=True)
            seed = row.row(align=True)
            seed.active = getattr(variation, name) > 0.0
            seed.prop(variation, f"{name}_seed")
