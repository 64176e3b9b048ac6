"""Operators that leave muscles to the emotion again."""

from __future__ import annotations

from typing import Any

import bpy
from bpy.props import StringProperty

from ..annotated import Annotated
from ..base import RisoriusOperator
from ..changes import changed
from .props import by_hand_of, set_by_hand


class RISORIUS_OT_reset_muscles(RisoriusOperator, bpy.types.Operator):
    """Let the emotion control a muscle, or all muscles, again. Contractions set by hand are removed"""

    bl_idname = "risorius.reset_muscles"
    bl_label = "Reset Muscles"
    bl_options = {"REGISTER", "UNDO"}

    muscle: Annotated[
        str, StringProperty(name="Muscle", description="Muscle to reset. Empty: all muscles", options={"SKIP_SAVE"})
    ]

    @classmethod
    def refusal(cls, context: Any) -> str | None:
        """Only where something is set by hand."""
        if context.object is None:
            return "There is no active object"
        return None if by_hand_of(context.object) else "No muscle is set by hand"

    def run(self, context: Any) -> str:
        """Forget them."""
        obj = context.object
        before = len(by_hand_of(obj))
        if self.muscle:
            set_by_hand(obj, self.muscle, None)
        else:
            obj.risorius.muscles.by_hand.clear()
        changed(obj.risorius.muscles, context)
        count = before - len(by_hand_of(obj))
        return f"{obj.name}: {count} muscle{'s' * (count != 1)} controlled by the emotion again"
