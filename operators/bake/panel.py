"""The panel that bakes."""

from __future__ import annotations

from ...scene.points.kept import has_points
from ...scene.rig.destinations import BakeTo
from ...scene.shape_mix import resting_values
from ..active import active_object
from ..blender_classes import Panel
from ..blender_types import Context, Object, UILayout
from ..sidebar import LINE, MeshSidebar
from .baked import draw_baked
from .destination import bake_reason, destination_of, may_have_controls, user_keys
from .ops import RISORIUS_OT_bake_expression, RISORIUS_OT_bake_motion, RISORIUS_OT_bake_strips
from .settings import clip_name

#: The operator that imports recordings, by name: it knows the bakes, and not the other way round.
IMPORT = "risorius.import_fap"


class RISORIUS_PT_bake(MeshSidebar, Panel):
    """Timing, the bakes, and what has been baked."""

    bl_label = "Bake"
    bl_parent_id = "RISORIUS_PT_main"

    def draw(self, context: Context) -> None:
        """When and to what, then the buttons, then what is there."""
        layout = self.layout
        layout.use_property_split, layout.use_property_decorate = True, False
        obj, chosen = active_object(context), active_object(context).risorius.bake
        clips = len(obj.risorius.timeline.clips)
        layout.row().prop(chosen, "clip", placeholder=clip_name(obj, motion=bool(clips)))
        self._draw_destination(layout, context)
        if not clips:
            column = layout.column(align=True)
            for name in ("start", "onset", "apex", "offset"):
                column.prop(chosen, name)
        if destination_of(obj).to is BakeTo.NEW:
            layout.prop(chosen, "max_keys")
            layout.prop(chosen, "creases")
        self._draw_state(layout, obj)
        column = layout.column(align=True)
        column.scale_y = 1.3
        if clips:
            column.operator(RISORIUS_OT_bake_motion.bl_idname, text="Bake Motion", icon="PHYSICS")
            column.operator(RISORIUS_OT_bake_strips.bl_idname, icon="NLA")
        else:
            column.operator(RISORIUS_OT_bake_expression.bl_idname, icon="SHAPEKEY_DATA")
            column.operator(RISORIUS_OT_bake_motion.bl_idname, icon="PHYSICS")
        layout.operator(IMPORT, text="Import Recording...", icon="IMPORT").filepath = ""
        draw_baked(layout, context)

    def _draw_destination(self, layout: UILayout, context: Context) -> None:
        """What is keyed, and onto a rig, how."""
        obj, chosen = active_object(context), active_object(context).risorius.bake
        layout.prop(chosen, "onto")
        if may_have_controls(obj):
            layout.label(text=f"Has {user_keys(obj)} shape keys: try My Keys", icon="INFO")
        if destination_of(obj).to is BakeTo.NEW:
            return
        column = layout.column(align=True)
        for name in ("above", "symmetric", "smooth"):
            column.prop(chosen, name)
        if context.window_manager.risorius.preview.show:
            layout.label(text="The preview shows the muscles", icon="INFO")

    def _draw_state(self, layout: UILayout, obj: Object) -> None:
        """What keeps it from being baked, or what is done first; what it rests on."""
        reason = bake_reason(obj)
        if reason is not None:
            said = reason.partition(": ")[2].partition(":")[0]
            layout.label(text=(said[:1].upper() + said[1:])[:LINE], icon="INFO")
        elif not has_points(obj):
            layout.label(text="The face is found first", icon="INFO")
        count = len(resting_values(obj.data))
        if count:
            layout.label(text=f"As it shows: {count} shape key{'s' * (count != 1)}", icon="SHAPEKEY_DATA")
