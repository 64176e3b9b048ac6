"""The operator that makes shape keys with the names that engines know."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...progress import Work
from ...scene.points.found import Finding
from ..active import active_object, face_reason, target_of
from ..base import WorkOperator
from ..blender_classes import Operator
from ..blender_types import Context
from ..points.first import with_points
from ..points.show import show_finding

if TYPE_CHECKING:
    from ...scene.blendshape_keys import WrittenKeys


class RISORIUS_OT_make_shapes(WorkOperator["WrittenKeys | Finding"], Operator):
    """Add shape keys with the names that engines and trackers use, each posed by the muscles. Later bakes do not \
change them"""

    bl_idname = "risorius.make_shapes"
    bl_label = "Add Engine Shape Keys"
    bl_options = {"REGISTER", "UNDO"}
    title = "Adding shape keys"

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only on a face that can be written to."""
        return face_reason(context.object)

    def work(self, context: Context) -> Work[WrittenKeys | Finding]:
        """Find the face if need be, then pose and write."""
        from ...scene.blendshape_keys import write_blendshapes

        obj, chosen = active_object(context), context.scene.risorius.shapes

        def making() -> Work[WrittenKeys]:
            return write_blendshapes(target_of(obj, context.scene), chosen.names, replace=chosen.replace)

        return with_points(obj, making, scene=context.scene)

    def finish(self, context: Context, result: WrittenKeys | Finding) -> str:
        """Say how many, and which were replaced."""
        if isinstance(result, Finding):
            return show_finding(self, context, result)
        for remark in result.remarks:
            self.report({"WARNING"}, remark)
        replaced = f", {len(result.replaced)} replaced" if result.replaced else ""
        return f"{active_object(context).name}: {len(result.keys)} shape keys added{replaced}"
