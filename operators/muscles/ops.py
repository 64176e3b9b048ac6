"""Operators that leave muscles to the emotion again."""

from __future__ import annotations

from bpy.props import StringProperty

from ..active import active_object
from ..annotated import Annotated
from ..base import RisoriusOperator
from ..blender_classes import Operator
from ..blender_types import Context
from ..changes import changed
from .props import by_hand_of, set_by_hand


class RISORIUS_OT_reset_muscles(RisoriusOperator, Operator):
    """Let the emotion control a muscle, or all muscles, again. Contractions set by hand are removed"""

    bl_idname = "risorius.reset_muscles"
    bl_label = "Reset Muscles"
    bl_options = {"REGISTER", "UNDO"}

    muscle: Annotated[
        str, StringProperty(name="Muscle", description="Muscle to reset. Empty: all muscles", options={"SKIP_SAVE"})
    ]

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only where something is set by hand."""
        if context.object is None:
            return "There is no active object"
        return None if by_hand_of(context.object) else "No muscle is set by hand"

    def run(self, context: Context) -> str:
        """Forget them."""
        obj = active_object(context)
        before = len(by_hand_of(obj))
        if self.muscle:
            set_by_hand(obj, self.muscle, None)
        else:
            obj.risorius.muscles.by_hand.clear()
        changed(obj.risorius.muscles, context)
        count = before - len(by_hand_of(obj))
        return f"{obj.name}: {count} muscle{'s' * (count != 1)} controlled by the emotion again"
