"""Risorius's own shape keys on a mesh: written, replaced and removed by name; the user's are never touched.

Which keys are our own is recorded, per clip, as JSON in a property of the mesh's shape key datablock. A key that
the user renames drops out of the record and is the user's from then on.
"""

from __future__ import annotations

import json
import uuid
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

import bpy

from ...arrays import Floats
from ..blender_types import Key, Mesh, Object, ShapeKey
from ..mesh import key_vertices, keys_of, write_key_vertices
from ..shape_mix import RECORD, OwnKeys, own_keys

#: Blender keeps this many bytes of a shape key's name, in UTF-8; a Japanese letter takes three.
NAME_BYTES = 63


def read_own(mesh: Mesh) -> OwnKeys:
    """The record of `mesh`, without keys that no longer exist. Empty where there is none."""
    return own_keys(mesh.shape_keys)


def own_names_of(keys: Key | None) -> tuple[str, ...]:
    """Names of the own keys of a shape key datablock."""
    return own_keys(keys).names


def _write_own(keys: Key, own: OwnKeys) -> None:
    """Store the record with a mesh's shape keys."""
    stored = {"face": own.face, "added_basis": own.added_basis, "clips": {c: list(n) for c, n in own.clips.items()}}
    keys[RECORD] = json.dumps(stored)


def fitting(name: str, suffix: str = "") -> str:
    """A name and its suffix as Blender can keep them: the name is cut where they are too long together."""
    room = NAME_BYTES - len(suffix.encode())
    return name.encode()[:room].decode(errors="ignore") + suffix


def shortened(name: str) -> tuple[str, ...]:
    """A remark where a name is longer than Blender can keep."""
    short = fitting(name)
    return () if short == name else (f"the name is longer than Blender keeps: the shape key is called {short}",)


def free_names(wanted: Sequence[str], meshes: Iterable[Mesh], clip: str) -> tuple[str, ...]:
    """`wanted` key names as Blender can keep them, numbered where a mesh already has a key that is not `clip`'s own."""
    taken: set[str] = set()
    for mesh in meshes:
        if mesh.shape_keys is not None:
            ours = set(read_own(mesh).clips.get(clip, ()))
            taken |= {block.name for block in mesh.shape_keys.key_blocks} - ours
    chosen: list[str] = []
    for name in wanted:
        candidate, number = fitting(name), 1
        while candidate in taken:
            candidate, number = fitting(name, f".{number:03d}"), number + 1
        taken.add(candidate)
        chosen.append(candidate)
    return tuple(chosen)


def write_keys(
    obj: Object, clip: str, shapes: Mapping[str, Floats], *, slider_min: float = 0.0, face: str = ""
) -> OwnKeys:
    """Write the shape keys of one clip, in place of those it had before.

    Parameters
    ----------
    obj : a mesh object that `refusals.refuse_unwritable` has let pass.
    clip : which clip the keys belong to.
    shapes : free key name (see `free_names`) -> (V, 3) positions in the mesh's own coordinates.
    slider_min : lowest value of the keys; the highest is 1.
    face : name of the face that this mesh is part of; by default its own.

    Returns
    -------
    The new record of the mesh.
    """
    own = replace(read_own(obj.data), added_basis=True) if obj.data.shape_keys is None else read_own(obj.data)
    keys = keys_of(obj)
    _remove_blocks(obj, keys, [name for name in own.clips.get(clip, ()) if name not in shapes])
    for name, positions in shapes.items():
        block = keys.key_blocks.get(name) or obj.shape_key_add(name=name, from_mix=False)
        block.slider_min, block.slider_max = slider_min, 1.0
        write_shape(keys, block, positions)
    own = replace(own, face=face or own.face or uuid.uuid4().hex, clips={**own.clips, clip: tuple(shapes)})
    _write_own(keys, own)
    obj.data.update_tag()
    return own


def write_shape(keys: Key, block: ShapeKey, positions: Floats) -> None:
    """Give a shape key positions (V, 3) that show at value 1, and value 0.

    What it was relative to, limited to or muted by counts no longer. Keys relative to it go on adding what they added.
    """
    before = key_vertices(block)
    for other in keys.key_blocks:
        if other != block and other.relative_key == block:
            write_key_vertices(other, key_vertices(other) + positions - before)
    block.relative_key, block.vertex_group, block.mute = keys.reference_key, "", False
    block.value = 0.0
    write_key_vertices(block, positions)


def remove_keys(obj: Object, clips: Iterable[str] | None = None) -> tuple[str, ...]:
    """Remove the shape keys of `clips` (default: all clips), and the Basis where it was ours and nothing is left.

    Returns
    -------
    Names of the removed keys.
    """
    keys = obj.data.shape_keys
    if keys is None:
        return ()
    own = read_own(obj.data)
    going = set(own.clips) if clips is None else set(clips)
    removed = tuple(name for clip, names in own.clips.items() if clip in going for name in names)
    _remove_blocks(obj, keys, removed)
    left = {clip: names for clip, names in own.clips.items() if clip not in going}
    if not left and own.added_basis and len(keys.key_blocks) == 1:
        obj.shape_key_clear()
        return removed
    if left:
        _write_own(keys, replace(own, clips=left))
    elif RECORD in keys:
        del keys[RECORD]
    obj.data.update_tag()
    return removed


def _remove_blocks(obj: Object, keys: Key, names: Iterable[str]) -> None:
    """Remove the named keys that exist; the one that the user works on stays active."""
    active = "" if obj.active_shape_key is None else obj.active_shape_key.name
    for name in names:
        block = keys.key_blocks.get(name)
        if block is not None:
            obj.shape_key_remove(block)
    if active in keys.key_blocks:
        obj.active_shape_key_index = keys.key_blocks.find(active)


def own_face(mesh: Mesh) -> str:
    """The name of the face that `mesh` is part of, or "" where nothing is baked on it."""
    return read_own(mesh).face


def has_own(obj: Object | None) -> bool:
    """Whether Risorius has baked anything onto `obj`."""
    return obj is not None and obj.type == "MESH" and bool(read_own(obj.data).clips)


def settle_face(members: Sequence[Mesh]) -> tuple[str, str]:
    """The name of the face that these meshes are, and the name it had before.

    They differ where another mesh carries the old name too, which happens when a user duplicates a baked face: the
    copy becomes a face of its own. Both are "" where nothing has been baked yet.
    """
    old = next((own_face(mesh) for mesh in members if own_face(mesh)), "")
    strangers = [mesh for mesh in bpy.data.meshes if old and mesh not in members and own_face(mesh) == old]
    return (uuid.uuid4().hex if strangers else old), old
