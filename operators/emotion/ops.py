"""Operators for the emotion."""

from __future__ import annotations

from ..active import active_object
from ..base import RisoriusOperator
from ..blender_classes import Operator
from ..blender_types import Context
from .props import own_activation


class RISORIUS_OT_reset_activation(RisoriusOperator, Operator):
    """Reset the activation to the word's own value"""

    bl_idname = "risorius.reset_activation"
    bl_label = "Reset Activation"
    bl_options = {"REGISTER", "UNDO"}
    needs_scipy = False

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only where it differs."""
        if context.object is None:
            return "There is no active object"
        emotion = context.object.risorius.emotion
        same = abs(emotion.activation - own_activation(emotion.word)) < 1e-4
        return "The activation already has the word's own value" if same else None

    def run(self, context: Context) -> str:
        """Set it."""
        emotion = active_object(context).risorius.emotion
        emotion.activation = own_activation(emotion.word)
        return f"Activation {emotion.activation:.1f}"
