"""What Risorius refuses to touch, and what to do about it: every refusal names the object and the remedy."""

from __future__ import annotations

import bpy
import numpy as np

from ..errors import SceneError
from .blender_types import Object
from .mesh import rest_vertices

#: An object that was found to share its mesh with the active one; believed only as long as it does.
_last_sharer = ""

#: What is refused, and the remedy, where no object is active.
NO_OBJECT = "No active object", "select the mesh of a face, or add the default head"
#: Modes in which Blender holds a copy of the mesh that would overwrite ours.
BUSY_MODES = {"EDIT": "Edit Mode", "SCULPT": "Sculpt Mode"}


def refuse_unreadable(obj: Object | None) -> None:
    """Refuse what cannot be read as a face. Cheap enough for a button's poll.

    Raises
    ------
    SceneError : no object, not a mesh, no polygons, or the object is being edited.
    """
    if obj is None:
        raise SceneError(*NO_OBJECT)
    if obj.type != "MESH":
        raise SceneError(obj.name, f"is a {obj.type.lower()}, not a mesh: select the mesh of a face")
    if obj.mode in BUSY_MODES or obj.data.is_editmode:
        raise SceneError(obj.name, f"is in {BUSY_MODES.get(obj.mode, 'Edit Mode')}: go to Object Mode (Tab) first")
    if len(obj.data.polygons) == 0:
        raise SceneError(obj.name, "has no polygons: select the mesh of a face")


def refuse_unwritable(obj: Object | None, *, make_single_user: bool = False) -> None:
    """Refuse what cannot be baked onto without harming something else. Cheap enough for a button's poll.

    Parameters
    ----------
    make_single_user : the caller will give the object its own copy of a shared mesh (`own_mesh`).

    Raises
    ------
    SceneError : as `refuse_unreadable`; linked or overridden data; a mesh that several objects share; absolute
        shape keys; the non-linear animation editor's tweak mode.
    """
    refuse_unreadable(obj)
    assert obj is not None
    if obj.library is not None or obj.data.library is not None:
        raise SceneError(
            obj.name, "is linked from another file: make it local (Object > Relations > Make Local > All) first"
        )
    if obj.override_library is not None or obj.data.override_library is not None:
        raise SceneError(obj.name, "is a library override: make it local (Object > Relations > Make Local > All) first")
    sharer = None if make_single_user else sharer_of(obj)
    if sharer is not None:
        raise SceneError(
            obj.name,
            f"shares its mesh with {sharer}, which would get the shape keys too: "
            "make it single user (Object > Relations > Make Single User > Object & Data) "
            "or turn on Make Single User in the panel",
        )
    keys = obj.data.shape_keys
    if keys is None:
        return
    if not keys.use_relative:
        raise SceneError(obj.name, "has absolute shape keys: turn on Relative in the Shape Keys panel")
    if keys.animation_data is not None and keys.animation_data.use_tweak_mode:
        raise SceneError(obj.name, "is in NLA tweak mode: leave it first (Tab in the NLA editor)")


def refuse_broken_vertices(obj: Object) -> None:
    """Refuse resting vertices that are not finite. Reads the whole mesh.

    Raises
    ------
    SceneError : with the first bad vertex.
    """
    bad = np.flatnonzero(~np.isfinite(rest_vertices(obj.data)).all(axis=1))
    if len(bad):
        raise SceneError(
            obj.name,
            f"vertex {bad[0]} has a coordinate that is not a number ({len(bad)} such vertices): "
            "move or delete it in Edit Mode, then bake again",
        )


def own_mesh(obj: Object) -> None:
    """Give `obj` its own copy of a mesh that other objects share."""
    if sharer_of(obj) is not None:
        obj.data = obj.data.copy()


def sharer_of(obj: Object) -> str | None:
    """Name of another object with the same mesh.

    A file may have thousands of objects, and every button asks this at every redraw. So the mesh is asked first
    whether it has other users at all, then the object that was found last time, and all of them only then.
    """
    global _last_sharer
    mesh = obj.data
    if mesh.users - mesh.use_fake_user < 2:
        return None
    last = bpy.data.objects.get(_last_sharer)
    others = (last,) if last is not None and last.data == mesh and last != obj else bpy.data.objects
    _last_sharer = next((str(other.name) for other in others if other.data == mesh and other != obj), "")
    return _last_sharer or None


def reason(obj: Object | None, *, writing: bool = True, make_single_user: bool = False) -> str | None:
    """Why the object cannot be used, as a sentence for a greyed button; None where it can."""
    try:
        if writing:
            refuse_unwritable(obj, make_single_user=make_single_user)
        else:
            refuse_unreadable(obj)
    except SceneError as refusal:
        return str(refusal)
    return None
