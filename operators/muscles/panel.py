"""The panel of muscles: a slider each."""

from __future__ import annotations

import textwrap

from ..active import active_object, ready_reason
from ..blender_classes import Panel, UIList
from ..blender_types import Context, UILayout
from ..requirements import has_scipy
from ..sidebar import LINE, MeshSidebar
from .ops import RISORIUS_OT_reset_muscles
from .props import RISORIUS_PG_muscle_list, RISORIUS_PG_muscle_name, by_hand_of, list_muscles_soon

#: Rows of the list; a muscle that does less than this does nothing.
ROWS, BUSY = 8, 0.005


class RISORIUS_UL_muscles(UIList):
    """Muscles of the active face: how far each is contracted, and whether by hand."""

    def draw_item(
        self,
        context: Context,
        layout: UILayout,
        data: RISORIUS_PG_muscle_list,
        item: RISORIUS_PG_muscle_name,
        icon: int,
        active_data: object,
        active_property: str,
    ) -> None:
        """One muscle."""
        obj = active_object(context)
        by_hand = item.name in by_hand_of(obj)
        row = layout.row(align=True)
        row.prop(item, "contraction", text=label(item.name, obj.risorius.muscles.linked), slider=True)
        back = row.row(align=True)
        back.enabled = by_hand
        icon_name = "LOOP_BACK" if by_hand else "BLANK1"
        back.operator(RISORIUS_OT_reset_muscles.bl_idname, text="", icon=icon_name, emboss=False).muscle = item.name

    def filter_items(
        self, context: Context, data: RISORIUS_PG_muscle_list, property: str
    ) -> tuple[list[int], list[int]]:
        """What is asked for; one of each pair where the sides are linked."""
        from ...face.contractible import contractibles

        obj, wanted = active_object(context), self.filter_name.casefold()
        linked, by_hand = obj.risorius.muscles.linked, by_hand_of(obj)
        flags = []
        for item in data.names:
            entry = contractibles()[item.name]
            shown = not (linked and item.name.endswith("_r") and item.name != entry.mirror)
            if data.busy_only and item.contraction < BUSY and item.name not in by_hand:
                shown = False
            words = f"{item.name} {entry.title} {entry.group} AU{entry.action_unit}".casefold()
            flags.append(self.bitflag_filter_item if shown and wanted in words else 0)
        return flags, []


def label(name: str, linked: bool) -> str:
    """A muscle's name for people."""
    base, side = (name[:-2], name[-2:]) if name[-2:] in ("_l", "_r") else (name, "")
    words = base.replace("_", " ").capitalize()
    return words if linked or not side else f"{words} {side[1].upper()}"


class RISORIUS_PT_muscles(MeshSidebar, Panel):
    """Which muscles make the face, and how far."""

    bl_label = "Muscles"
    bl_parent_id = "RISORIUS_PT_main"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: Context) -> None:
        """The list, the marked muscle in words, and the way back."""
        layout, obj = self.layout, active_object(context)
        reason = ready_reason(obj)
        if reason is not None or not has_scipy():
            layout.label(text="Needs a face with feature points", icon="INFO")
            return
        from ...face.contractible import contractibles

        window = context.window_manager.risorius
        row = layout.row(align=True)
        for name in ("muscles", "strain", "paths"):
            each = row.row(align=True)
            each.enabled = name == "strain" or window.preview.show
            each.prop(window.show, name, toggle=True)
        state = window.muscles
        if len(state.names) != len(contractibles()):
            list_muscles_soon()
            return
        row = layout.row(align=True)
        row.prop(obj.risorius.muscles, "linked", icon="MOD_MIRROR", toggle=True)
        row.prop(state, "busy_only", text="", icon="FILTER", toggle=True)
        layout.template_list("RISORIUS_UL_muscles", "", state, "names", state, "active", rows=ROWS)
        if state.active < len(state.names):
            entry = contractibles()[state.names[state.active].name]
            unit = f" (AU {entry.action_unit})" if entry.action_unit else ""
            column = layout.column(align=True)
            for line in textwrap.wrap(f"{entry.title[0].upper()}{entry.title[1:]}{unit}", LINE):
                column.label(text=line)
        count = len(by_hand_of(obj))
        layout.operator(
            RISORIUS_OT_reset_muscles.bl_idname,
            text=f"Reset {count} Set by Hand" if count else "Reset All",
            icon="LOOP_BACK",
        ).muscle = ""
