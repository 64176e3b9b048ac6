"""Operators for known topologies: save the points for every mesh like this one, and remove what was saved."""

from __future__ import annotations

from bpy.props import StringProperty

from ...scene.blender_types import Event
from ...scene.points.presets import preset_paths, remove_preset, save_preset
from ..active import active_object
from ..annotated import Annotated
from ..base import RisoriusOperator
from ..blender_classes import Operator
from ..blender_types import Context
from .reasons import no_points_reason


class RISORIUS_OT_save_topology(RisoriusOperator, Operator):
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
    def refusal(cls, context: Context) -> str | None:
        """Only where there are points."""
        return no_points_reason(context.object)

    def invoke(self, context: Context, event: Event) -> set[str]:
        """Ask for the name."""
        self.called = self.called or active_object(context).data.name
        return context.window_manager.invoke_props_dialog(self)

    def run(self, context: Context) -> str:
        """Save them."""
        path = save_preset(active_object(context), self.called)
        return f"Find Face now recognises meshes like {active_object(context).name} ({path})"


class RISORIUS_OT_remove_topology(RisoriusOperator, Operator):
    """Remove this saved topology. Meshes whose points were found with it keep their points"""

    bl_idname = "risorius.remove_topology"
    bl_label = "Remove Known Topology"
    bl_options = {"REGISTER"}
    needs_scipy = False

    file: Annotated[str, StringProperty(name="File", description="File name without extension", options={"SKIP_SAVE"})]

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only where some were saved."""
        return None if preset_paths() else "No topology has been saved yet"

    def invoke(self, context: Context, event: Event) -> set[str]:
        """Ask first: this cannot be undone."""
        return context.window_manager.invoke_confirm(self, event)

    def run(self, context: Context) -> str:
        """Remove it."""
        remove_preset(self.file)
        return f"Removed the known topology {self.file}"
