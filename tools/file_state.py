"""All that a Blender file holds, as plain values, so that two states can be compared; without what is Risorius' own.

Everything that Blender's own description of its types (RNA) names is read: datablocks, animation, modifiers, materials,
view layers, custom properties, every vertex. What is computed from it, and what tells of the session, is left out.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from typing import Any

import bpy
import numpy as np
from risorius.scene.bake.shape_keys import own_names_of
from risorius.scene.bake.tracks import FACE_TAG, is_own

#: A place in the file, and its value.
State = dict[str, object]

#: Datablocks of the session's windows.
SESSION = {"window_managers", "screens", "workspaces"}
#: Properties that are computed, name the same again, or tell of the session.
LEFT_OUT = {
    *("rna_type", "id_data", "risorius", "preview", "original", "users", "tag", "session_uid", "is_evaluated"),
    *("depsgraph", "bound_box", "dimensions", "loop_triangles", "loop_triangle_polygons", "corner_normals"),
    *("vertex_normals", "polygon_normals", "normal", "normals", "points", "total_vert_sel", "total_edge_sel"),
    *("total_face_sel", "action_suitable_slots", "vertex_colors", "color_attributes", "uv_layers", "texco_mesh"),
    *("is_updated", "is_updated_data", "path_resolve", "tangent", "bitangent", "area", "center", "angle"),
}
#: Collections with more items than this are read at once.
MANY = 200
DEEP = 14


def file_state() -> State:
    """Place -> value of everything in the open file that is not Risorius' own."""
    state: State = {}
    for prop in bpy.data.bl_rna.properties:
        if prop.type == "COLLECTION" and prop.identifier not in SESSION:
            for datablock in getattr(bpy.data, prop.identifier):
                if not _is_own(datablock):
                    place = f"{prop.identifier}[{datablock.name_full}]"
                    state |= dict(_values(datablock, place, {datablock.as_pointer()}, 0))
    return state


def differences(before: State, after: State) -> list[str]:
    """What of a state has changed or is gone; what is new is no difference, nor that a place that was empty is taken.

    A mesh without shape keys gets some, a datablock without animation an action, and one with creases the attribute of
    its resting places: these are Risorius' own.
    """
    filled = {place for place, value in before.items() if not value and place.rpartition(".")[2] in TAKEN}
    found = [
        f"{place}: {value!r} is now {after.get(place, 'gone')!r}"
        for place, value in before.items()
        if after.get(place, "gone") != value and place not in filled
    ]
    return sorted(found)


#: Places that Risorius may take where they are empty.
TAKEN = {"shape_keys", "animation_data", "action", "action_slot", "active_shape_key"}


def _is_own(item: Any) -> bool:
    """Whether an item of a collection is Risorius' own."""
    name = str(getattr(item, "name", ""))
    if isinstance(item, bpy.types.ShapeKey):
        return name in own_names_of(item.id_data)
    if isinstance(item, bpy.types.NlaTrack):
        return is_own(item)
    if isinstance(item, bpy.types.Action):
        return FACE_TAG in item
    return name.startswith(("Risorius Creases", "Risorius Preview", "risorius"))


def _values(item: Any, place: str, above: set[int], depth: int) -> Iterator[tuple[str, object]]:
    """Places in an item and their values."""
    if isinstance(item, bpy.types.ID):
        for name, value in item.items():
            if not name.startswith("risorius"):
                yield f'{place}["{name}"]', str(value.to_dict() if hasattr(value, "to_dict") else value)
    for prop in item.bl_rna.properties:
        name = prop.identifier
        if name in LEFT_OUT or (name.startswith("is_") and prop.is_readonly):
            continue
        try:
            value = getattr(item, name)
        except (AttributeError, RuntimeError, UnicodeDecodeError):
            continue
        inner = f"{place}.{name}"
        if prop.type == "COLLECTION":
            yield from _items(value, inner, above, depth)
        elif prop.type == "POINTER":
            yield from _pointed(value, inner, above, depth)
        elif getattr(prop, "is_array", False):
            yield inner, np.array(value).tolist()
        else:
            yield inner, sorted(value) if isinstance(value, set) else value


def _pointed(value: Any, place: str, above: set[int], depth: int) -> Iterator[tuple[str, object]]:
    """What a property points to: the name of a datablock, or the values of what belongs to this one."""
    if value is None:
        yield place, None
    elif isinstance(value, bpy.types.ID) and not value.is_embedded_data:
        yield place, f"{type(value).__name__} {value.name_full}"
    elif value.as_pointer() in above or depth >= DEEP or place.rpartition(".")[2] in ("relative_key", "reference_key"):
        yield place, str(getattr(value, "name", type(value).__name__))
    else:
        yield from _values(value, place, above | {value.as_pointer()}, depth + 1)


def _items(collection: Any, place: str, above: set[int], depth: int) -> Iterator[tuple[str, object]]:
    """The items of a collection, large ones as sums of their numbers."""
    if len(collection) > MANY:
        yield from _sums(collection, place)
        return
    items = [item for item in collection if item is not None and not _is_own(item)]
    yield f"{place}.length", len(items)
    if isinstance(collection, bpy.types.AttributeGroupMesh if hasattr(bpy.types, "AttributeGroupMesh") else ()):
        active = collection.active
        yield f"{place}.active", "" if active is None else active.name
    for number, item in enumerate(items):
        if isinstance(item, bpy.types.ID) and not item.is_embedded_data:
            yield f"{place}[{number}]", f"{type(item).__name__} {item.name_full}"
        elif item.as_pointer() not in above and depth < DEEP:
            yield from _values(item, f"{place}[{number}]", above | {item.as_pointer()}, depth + 1)


def _sums(collection: Any, place: str) -> Iterator[tuple[str, object]]:
    """A digest of each number that all items of a large collection have."""
    yield f"{place}.length", len(collection)
    for prop in collection[0].bl_rna.properties:
        if prop.type not in ("FLOAT", "INT", "BOOLEAN") or prop.identifier in (*LEFT_OUT, "index"):
            continue
        size = len(collection) * max(1, prop.array_length)
        kind = {"FLOAT": np.float32, "INT": np.int32, "BOOLEAN": bool}[prop.type]
        values = np.zeros(size, dtype=kind)
        try:
            collection.foreach_get(prop.identifier, values)
        except (RuntimeError, TypeError, AttributeError):
            continue
        yield f"{place}.{prop.identifier}", hashlib.sha1(values.tobytes()).hexdigest()
    if isinstance(collection[0], bpy.types.MeshVertex):
        weights = [(group.group, group.weight) for vertex in collection for group in vertex.groups]
        yield f"{place}.groups", hashlib.sha1(repr(weights).encode()).hexdigest()
