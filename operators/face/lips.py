"""Lips and lids without an opening, mouths without an inside: the hint in the panel, and the buttons that mend them."""

from __future__ import annotations

from ...scene import refusals
from ...scene.cut.lining import line_mouth
from ...scene.cut.lips import cut_lips
from ...scene.points.kept import KeptPoints, has_points, mesh_counts
from ..active import active_object
from ..base import RisoriusOperator
from ..blender_classes import Operator
from ..blender_types import Context, Object, UILayout
from ..preview import live


class RISORIUS_OT_cut_lips(RisoriusOperator, Operator):
    """Cut lips that are sewn together open along their seam, and add a dark mouth behind them. Materials, UV maps, \
vertex groups and shape keys stay. Bake again afterwards"""

    bl_idname = "risorius.cut_lips"
    bl_label = "Cut Lips Open"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only where there are feature points, on a mesh that may be changed."""
        return _refusal(context)

    def run(self, context: Context) -> str:
        """Cut them."""
        obj = active_object(context)
        parted = cut_lips(obj)
        live.ask(obj)
        return f"{obj.name}: lips cut open along {parted} vertices; bake again to open the mouth"


class RISORIUS_OT_line_mouth(RisoriusOperator, Operator):
    """Add a dark mouth behind lips that have no inside, so that nothing shows through when they open. Materials, \
UV maps, vertex groups and shape keys stay. Bake again afterwards"""

    bl_idname = "risorius.line_mouth"
    bl_label = "Add Mouth Lining"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """As for lips that are cut."""
        return _refusal(context)

    def run(self, context: Context) -> str:
        """Add it."""
        obj = active_object(context)
        count = line_mouth(obj)
        live.ask(obj)
        return f"{obj.name}: mouth lined along {count} vertices; bake again to move it"


def _refusal(context: Context) -> str | None:
    """Why the mouth of the active object cannot be changed."""
    obj = context.object
    if obj is not None and not has_points(obj):
        return f"{obj.name}: has no feature points yet: find the face, click them, or import them"
    return refusals.reason(obj)


def draw_sewn(layout: UILayout, obj: Object, kept: KeptPoints) -> None:
    """What is sewn of a face, as long as its mesh is the one that its points were found on."""
    if not kept.sewn or kept.counts != mesh_counts(obj.data):
        return
    box = layout.box().column(align=True)
    if "mouth" in kept.sewn:
        box.label(text="The lips are sewn together", icon="INFO")
        box.operator(RISORIUS_OT_cut_lips.bl_idname, icon="MOD_EDGESPLIT")
    if kept.sewn - {"mouth"}:
        box.label(text="The eyelids stay shut", icon="INFO")
