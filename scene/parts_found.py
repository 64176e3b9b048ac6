"""Parts of a face's mesh (skin, eyeballs, teeth, tongue, other): told by the face, corrected by vertex groups."""

from __future__ import annotations

import numpy as np

from ..arrays import Bools, Ints
from ..errors import SceneError
from ..face.mesh.parts import Part
from . import mesh as meshes
from .blender_types import Object
from .faces import face_of, read_face
from .points.kept import refuse_foreign_mesh


def find_parts(obj: Object) -> Ints:
    """(V,) parts of the mesh of `obj` as its shape and its feature points tell them; stored with the mesh.

    Raises
    ------
    SceneError, ModelError : see `faces.read_face` and `faces.face_of`; a mesh of another file.
    """
    refuse_foreign_mesh(obj)
    before = meshes.read_parts(obj.data)
    meshes.remove_parts(obj.data)
    try:
        parts = np.asarray(face_of(read_face(obj)).parts, dtype=np.int64)
    except Exception:
        if before is not None:
            meshes.write_parts(obj.data, before)
        raise
    meshes.write_parts(obj.data, parts)
    return parts


def set_part(obj: Object, group: str, part: Part) -> int:
    """Store `part` for the vertices of a vertex group; returns how many. What is untold the face tells.

    Raises
    ------
    SceneError : no such group, nothing in it, or a mesh of another file.
    """
    refuse_foreign_mesh(obj)
    member = in_group(obj, group)
    if not member.any():
        raise SceneError(obj.name, f"has no vertices in its vertex group {group}: assign some in Edit Mode")
    parts = meshes.read_parts(obj.data)
    if parts is None:
        parts = np.full(len(obj.data.vertices), -1, dtype=np.int64)
    parts[member] = int(part)
    meshes.write_parts(obj.data, parts)
    return int(member.sum())


def forget_parts(obj: Object) -> None:
    """Remove stored parts: the face tells them again."""
    meshes.remove_parts(obj.data)


def in_group(obj: Object, name: str) -> Bools:
    """(V,) which vertices are more in a vertex group than out of it.

    Raises
    ------
    SceneError : no such group.
    """
    group = obj.vertex_groups.get(name)
    if group is None:
        raise SceneError(obj.name, f"has no vertex group {name!r}: choose one of its own")
    member = np.zeros(len(obj.data.vertices), dtype=bool)
    for vertex in obj.data.vertices:
        member[vertex.index] = any(entry.group == group.index and entry.weight >= 0.5 for entry in vertex.groups)
    return member
