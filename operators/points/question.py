"""Is this the face? Asked where what was found is unlike most faces, and open until it is answered."""

from __future__ import annotations

from dataclasses import replace

import bpy

from ...face.fit.doubt import DOUBTFUL_SCORE
from ...scene.points.kept import KeptPoints, read_kept, write_kept
from ..active import active_object
from ..base import RisoriusOperator
from ..blender_classes import Menu, Operator
from ..blender_types import Context, UILayout
from ..face.ops import RISORIUS_OT_forget_points
from .reasons import no_points_reason

#: By its name: clicking ends in this question.
CLICK_POINTS = "risorius.click_points"


class RISORIUS_OT_accept_points(RisoriusOperator, Operator):
    """Keep these points. Single points can still be dragged"""

    bl_idname = "risorius.accept_points"
    bl_label = "Yes, Keep Points"
    bl_options = {"REGISTER", "UNDO"}
    needs_scipy = False

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only where it is asked."""
        reason = no_points_reason(context.object)
        if reason is None and not read_kept(active_object(context)).is_questioned:
            return "These points are not doubtful"
        return reason

    def run(self, context: Context) -> str:
        """Ask no more."""
        obj = active_object(context)
        write_kept(obj, replace(read_kept(obj), score=0.0))
        return f"{obj.name}: points kept; now bake an expression"


class RISORIUS_MT_is_this_the_face(Menu):
    """The question, beside the mouse."""

    bl_idname = "RISORIUS_MT_is_this_the_face"
    bl_label = "Is this the face?"

    def draw(self, context: Context) -> None:
        """Why it is asked, and the answers."""
        draw_question(self.layout, read_kept(active_object(context)))


def draw_question(layout: UILayout, kept: KeptPoints) -> None:
    """Why it is asked, and the answers: in the menu and in the panel."""
    layout.label(text="Check eyes, nose and lips", icon="QUESTION")
    layout.label(text="It is unlike most faces:", icon="BLANK1")
    layout.label(text=f"score {kept.score:.2f} (most: up to {DOUBTFUL_SCORE:g})", icon="BLANK1")
    layout.operator_context = "INVOKE_DEFAULT"
    layout.operator(RISORIUS_OT_accept_points.bl_idname, icon="CHECKMARK")
    layout.operator(CLICK_POINTS, text="Click Six Points", icon="RESTRICT_SELECT_OFF")
    layout.operator(RISORIUS_OT_forget_points.bl_idname, text="No, Clear Points", icon="X")


def ask_whether_right(context: Context, kept: KeptPoints) -> None:
    """Open the question beside the mouse where there is doubt and a window; the panel goes on asking."""
    if kept.is_questioned and not bpy.app.background and context.window is not None:
        bpy.ops.wm.call_menu(name=RISORIUS_MT_is_this_the_face.bl_idname)
