"""Operators for known topologies: save the points for every mesh like this one, and remove what was saved."""

from __future__ import annotations

from typing import Any

import bpy
from bpy.props import StringProperty

from ...scene.points.presets import preset_paths, remove_preset, save_preset
from ..annotated import Annotated
from ..base import RisoriusOperator
from .reasons import no_points_reason


class RISORIUS_OT_save_topology(RisoriusOperator, bpy.types.Operator):
    """Save these points for all meshes with the same polygons. Find Face then recognises such a mesh at once, in \
any file and shape. Correct the points first"""

    bl_idname = "risorius.save_topology"
    bl_label = "Save as Known Topology"
    bl_options = {"REGISTER"}
    needs_scipy = False

    called: Annotated[
        str,
        StringProperty(
            name="Name", description="Name for this kind of mesh. A topology with the same name is replaced"
        ),
    ]

    @classmethod
    def refusal(cls, context: Any) -> str | None:
        """Only where there are points."""
        return no_points_reason(context.object)

    def invoke(self, context: Any, event: Any) -> Any:
        """Ask for the name."""
        self.called = self.called or context.object.data.name
        return context.window_manager.invoke_props_dialog(self)

    def run(self, context: Any) -> str:
        """Save them."""
        path = save_preset(context.object, self.called)
        return f"Find Face now recognises meshes like {context.object.name} ({path})"


class RISORIUS_OT_remove_topology(RisoriusOperator, bpy.types.Operator):
    """Remove this saved topology. Meshes whose points were found with it keep their points"""

    bl_idname = "risorius.remove_topology"
    bl_label = "Remove Known Topology"
    bl_options = {"REGISTER"}
    needs_scipy = False

    file: Annotated[str, StringProperty(name="File", description="File name without extension", options={"SKIP_SAVE"})]

    @classmethod
    def refusal(cls, context: Any) -> str | None:
        """Only where some were saved."""
        return None if preset_paths() else "No topology has been saved yet"

    def invoke(self, context: Any, event: Any) -> Any:
        """Ask first: this cannot be undone."""
        return context.window_manager.invoke_confirm(self, event)

    def run(self, context: Any) -> str:
        """Remove it."""
        remove_preset(self.file)
        return f"Removed the known topology {self.file}"
