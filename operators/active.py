"""The face that the panel and the operators are about: the active object, with its parts."""

from __future__ import annotations

import bpy

from ..errors import SceneError
from ..scene import refusals
from ..scene.bake.target import Target
from ..scene.blender_types import Items
from ..scene.fingerprint import uid_of
from ..scene.points.kept import has_points
from .blender_types import Context, Object, Scene
from .followers.rows import companions_of, left_behind, unlisted


def active_object(context: Context) -> Object:
    """The active object, for those who have been told by a poll that there is one.

    Raises
    ------
    SceneError : there is none.
    """
    obj = context.object
    if obj is None:
        raise SceneError(*refusals.NO_OBJECT)
    return obj


def all_objects() -> Items[Object]:
    """All objects of the file."""
    objects: Items[Object] = bpy.data.objects
    return objects


def object_of(uid: int) -> Object | None:
    """The object of a number (`uid_of`), whatever it is called by now; None where it is gone."""
    return next((obj for obj in all_objects() if uid_of(obj) == uid), None)


def target_of(obj: Object, scene: Scene | None = None) -> Target:
    """Where the operators bake. With a scene, what stays behind in it is named, too."""
    behind = left_behind(obj)
    if scene is not None:
        behind += tuple(
            f"{name} (is not in the list Follows the Face: press Refresh there)" for name in unlisted(obj, scene)
        )
    return Target(obj, companions_of(obj), make_single_user=obj.risorius.face.make_single_user, left_behind=behind)


def face_reason(obj: Object | None) -> str | None:
    """Why the active object cannot be baked on, or None. Feature points that are missing are found by the bake."""
    return refusals.reason(obj, make_single_user=obj is not None and obj.risorius.face.make_single_user)


def ready_reason(obj: Object | None) -> str | None:
    """Why the active object cannot be shown or moved at once, or None: it needs its feature points, too."""
    return face_reason(obj) or _missing_points_reason(obj)


def reading_reason(obj: Object | None) -> str | None:
    """Why the active object cannot be read as a face, or None. What is linked or shared may be read, too."""
    return refusals.reason(obj, writing=False) or _missing_points_reason(obj)


def _missing_points_reason(obj: Object | None) -> str | None:
    """That a face has no feature points yet, or None."""
    if obj is None or has_points(obj):
        return None
    return f"{obj.name}: has no feature points yet: find the face, click them, or import them"
