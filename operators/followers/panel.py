"""The list *Follows the Face* in the sidebar."""

from __future__ import annotations

from ...scene import refusals
from ...scene.following.kinds import Follows
from ...scene.points.kept import has_points
from ..active import active_object
from ..blender_classes import Panel, UIList
from ..blender_types import Context, UILayout
from ..sidebar import MeshSidebar
from .ops import RISORIUS_OT_add_followers, RISORIUS_OT_find_followers, RISORIUS_OT_remove_follower
from .props import WAYS, RISORIUS_PG_follower

#: Rows of the list.
ROWS = 5


class RISORIUS_UL_followers(UIList):
    """Objects beside the active face: what each is called, and how it follows."""

    def draw_item(
        self,
        context: Context,
        layout: UILayout,
        data: object,
        item: RISORIUS_PG_follower,
        icon: int,
        active_data: object,
        active_property: str,
    ) -> None:
        """One object."""
        row = layout.row(align=True)
        if item.object is None:
            row.label(text=f"{item.name} (deleted)", icon="ERROR")
            return
        row.label(text=item.object.name, icon=WAYS[Follows[item.follows]][2])
        if item.object.type == "MESH":
            row.prop(item, "follows", text="", emboss=False)
        else:
            row.label(text="Not a mesh")


class RISORIUS_PT_followers(MeshSidebar, Panel):
    """Which objects follow the active face, and how."""

    bl_label = "Follows the Face"
    bl_parent_id = "RISORIUS_PT_main"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: Context) -> None:
        """The list; how to fill and correct it."""
        layout, obj = self.layout, active_object(context)
        face = obj.risorius.face
        row = layout.row()
        row.template_list("RISORIUS_UL_followers", "", face, "followers", face, "follower", rows=ROWS)
        column = row.column(align=True)
        column.operator(RISORIUS_OT_add_followers.bl_idname, text="", icon="ADD")
        column.operator(RISORIUS_OT_remove_follower.bl_idname, text="", icon="REMOVE")
        column.operator(RISORIUS_OT_find_followers.bl_idname, text="", icon="FILE_REFRESH")
        if not face.followers:
            known = has_points(obj)
            layout.label(text="No other objects found" if known else "Filled when the face is found", icon="INFO")
        if obj.data.users > 1 or refusals.reason(obj) is not None or any(_is_shared(row) for row in face.followers):
            layout.prop(face, "make_single_user")


def _is_shared(row: RISORIUS_PG_follower) -> bool:
    """Whether other objects use the mesh of a row."""
    return row.object is not None and row.object.type == "MESH" and row.object.data.users > 1
