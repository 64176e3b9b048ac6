"""Operators for the emotion."""

from typing import Any

import bpy

from ..base import RisoriusOperator
from .props import own_activation


class RISORIUS_OT_reset_activation(RisoriusOperator, bpy.types.Operator):
    """Reset the activation to the word's own value"""

    bl_idname = "risorius.reset_activation"
    bl_label = "Reset Activation"
    bl_options = {"REGISTER", "UNDO"}
    needs_scipy = False

    @classmethod
    def refusal(cls, context: Any) -> str | None:
        """Only where it differs."""
        if context.object is None:
            return "There is no active object"
        emotion = context.object.risorius.emotion
        same = abs(emotion.activation - own_activation(emotion.word)) < 1e-4
        return "The activation already has the word's own value" if same else None

    def run(self, context: Any) -> str:
        """Set it."""
        emotion = context.object.risorius.emotion
        emotion.activation = own_activation(emotion.word)
        return f"Activation {emotion.activation:.1f}"
