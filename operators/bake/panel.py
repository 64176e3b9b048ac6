"""The panel that bakes."""

from __future__ import annotations

from ...scene.bake import shape_keys
from ...scene.points.kept import has_points
from ...scene.shape_mix import resting_values
from ..active import active_object, face_reason
from ..blender_classes import Panel
from ..blender_types import Context, UILayout
from ..sidebar import MeshSidebar
from .ops import (
    RISORIUS_OT_bake_again,
    RISORIUS_OT_bake_expression,
    RISORIUS_OT_bake_motion,
    RISORIUS_OT_bake_strips,
    RISORIUS_OT_clear,
)
from .settings import clip_name, stale_clips


class RISORIUS_PT_bake(MeshSidebar, Panel):
    """Timing, the two bakes, and what has been baked."""

    bl_label = "Bake"
    bl_parent_id = "RISORIUS_PT_main"

    def draw(self, context: Context) -> None:
        """When and with what, then the buttons, then what is there."""
        layout = self.layout
        layout.use_property_split, layout.use_property_decorate = True, False
        obj, chosen = active_object(context), active_object(context).risorius.bake
        clips = len(obj.risorius.timeline.clips)
        layout.row().prop(chosen, "clip", placeholder=clip_name(obj, motion=bool(clips)))
        if not clips:
            column = layout.column(align=True)
            for name in ("start", "onset", "apex", "offset"):
                column.prop(chosen, name)
        layout.prop(chosen, "creases")
        reason = face_reason(obj)
        if reason is not None:
            layout.label(text=reason.partition(": ")[2].partition(":")[0].capitalize(), icon="INFO")
        elif not has_points(obj):
            layout.label(text="The face is found first", icon="INFO")
        count = len(resting_values(obj.data))
        if count:
            layout.label(text=f"As it shows: {count} shape key{'s' * (count != 1)}", icon="SHAPEKEY_DATA")
        column = layout.column(align=True)
        column.scale_y = 1.3
        if clips:
            column.operator(RISORIUS_OT_bake_motion.bl_idname, text="Bake Motion", icon="PHYSICS")
            column.operator(RISORIUS_OT_bake_strips.bl_idname, icon="NLA")
        else:
            column.operator(RISORIUS_OT_bake_expression.bl_idname, icon="SHAPEKEY_DATA")
            column.operator(RISORIUS_OT_bake_motion.bl_idname, icon="PHYSICS")
        self._draw_baked(layout, context)

    def _draw_baked(self, layout: UILayout, context: Context) -> None:
        """The clips of this face, those out of date marked, each with a button that removes it."""
        clips = shape_keys.read_own(active_object(context).data).clips
        if not clips:
            return
        stale = stale_clips(active_object(context), context.scene)
        box = layout.box().column(align=True)
        for clip, keys in clips.items():
            row = box.row(align=True)
            row.label(text=clip, icon="ERROR" if clip in stale else "ACTION")
            row.label(text="out of date" if clip in stale else f"{len(keys)} key{'s' * (len(keys) != 1)}")
            row.operator(RISORIUS_OT_clear.bl_idname, text="", icon="X").clip = clip
        if stale:
            layout.operator(RISORIUS_OT_bake_again.bl_idname, icon="FILE_REFRESH")
        layout.operator(RISORIUS_OT_clear.bl_idname, text="Clear All Bakes", icon="TRASH").clip = ""
