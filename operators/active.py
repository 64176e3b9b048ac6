"""The face that the panel and the operators are about: the active object, with its parts."""

from __future__ import annotations

import bpy

from ..errors import SceneError
from ..face.mesh.parts import Part, Told
from ..scene import refusals
from ..scene.bake.target import Target
from ..scene.blender_types import Items
from ..scene.companions import Companion
from ..scene.points.kept import has_points
from .blender_types import Context, Object


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


#: What an object holds that is named as both of two parts.
_BOTH = {
    frozenset((Part.EYEBALL_L, Part.EYEBALL_R)): Told.EYES,
    frozenset((Part.TEETH_UPPER, Part.TEETH_LOWER)): Told.TEETH,
}


def companions_of(obj: Object) -> tuple[Companion, ...]:
    """Objects that the user has named as eyes, teeth and tongue of `obj`; one that is named twice holds both."""
    named = obj.risorius.face
    found: dict[Object, list[Part]] = {}
    for part, other in (
        (Part.EYEBALL_L, named.eyeball_l),
        (Part.EYEBALL_R, named.eyeball_r),
        (Part.TEETH_UPPER, named.teeth_upper),
        (Part.TEETH_LOWER, named.teeth_lower),
        (Part.TONGUE, named.tongue),
    ):
        if other is not None:
            found.setdefault(other, []).append(part)
    return tuple(
        Companion(other, parts[0] if len(parts) == 1 else _BOTH.get(frozenset(parts), Told.ANYTHING))
        for other, parts in found.items()
    )


def target_of(obj: Object) -> Target:
    """Where the operators bake."""
    return Target(obj, companions_of(obj), make_single_user=obj.risorius.face.make_single_user)


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
