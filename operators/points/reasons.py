"""Why a button for feature points is grey."""

from __future__ import annotations

from ...errors import SceneError
from ...scene import refusals
from ...scene.points.kept import has_points, refuse_foreign_mesh
from ..blender_types import Object


def points_reason(obj: Object | None) -> str | None:
    """Why no points can be kept with the active object, or None."""
    reason = refusals.reason(obj, writing=False)
    if reason is None and obj is not None:
        try:
            refuse_foreign_mesh(obj)
        except SceneError as refusal:
            return str(refusal)
    return reason


def no_points_reason(obj: Object | None) -> str | None:
    """Why the active object has no points to work with, or None."""
    reason = points_reason(obj)
    if reason is None and obj is not None and not has_points(obj):
        return f"{obj.name}: has no feature points yet: find, click or import them"
    return reason
