"""The default head as a Blender object: one mesh with materials, parts and feature points."""

from __future__ import annotations

import bpy
import numpy as np
from mathutils import Vector

from ..arrays import Floats
from ..face.default_head import HeadMesh
from ..face.default_head import Material as HeadMaterial
from . import mesh as meshes
from .blender_types import Context, Material, Object
from .creases.marks import draw_in
from .materials import new_material
from .points.kept import Origin
from .points.stored import store_points

NAME = "Risorius Head"

#: The material that draws creases where the baked skin is squeezed.
SKIN = "skin"

#: Half of the room that a head takes, metres.
ROOM = 0.3


def add_default_head(context: Context | None = None, *, location: Floats | None = None) -> Object:
    """Add the default head to the scene, select it and make it active.

    Parameters
    ----------
    location : (3,) where to; by default the world's origin.

    Returns
    -------
    The new object.
    """
    from .. import api

    obj = head_object(api.build_default_head(), NAME)
    (context or bpy.context).collection.objects.link(obj)
    if location is not None:
        obj.location = location.tolist()
    select_only(obj, context)
    return obj


def free_place(context: Context, wanted: Floats) -> Floats:
    """(3,) a place for a head near `wanted`: to the right of any visible mesh that would hide it.

    A new file has a cube of two metres at the place where things are added; a head would vanish inside it.
    """
    place = np.array(wanted, dtype=np.float64)
    boxes = [
        np.array([obj.matrix_world @ Vector(corner) for corner in obj.bound_box])
        for obj in context.visible_objects
        if obj.type == "MESH"
    ]
    for box in sorted(boxes, key=lambda box: float(box[:, 0].min())):
        low, high = box.min(axis=0) - ROOM, box.max(axis=0) + ROOM
        if (low < place).all() and (place < high).all():
            place[0] = high[0]
    return place


def head_object(head: HeadMesh, name: str) -> Object:
    """An object for a built head, not yet linked to a scene."""
    corners, sizes = meshes.flatten_polygons(head.polygons)
    mesh = meshes.new_mesh(name, head.vertices, corners, sizes)
    for material in head.materials:
        mesh.materials.append(_material(material))
    meshes.set_materials(mesh, head.material_index)
    meshes.write_parts(mesh, np.asarray(head.parts))
    obj: Object = bpy.data.objects.new(name, mesh)
    store_points(obj, {n: _place(point) for n, point in head.points.items()}, origin=Origin.TOPOLOGY)
    return obj


def _place(point: int | Floats) -> int | tuple[float, float, float]:
    """A feature point as it is stored: a vertex index, or three plain numbers."""
    if isinstance(point, int | np.integer):
        return int(point)
    x, y, z = point
    return float(x), float(y), float(z)


def select_only(obj: Object, context: Context | None = None) -> None:
    """Select `obj` alone and make it active."""
    layer = (context or bpy.context).view_layer
    for other in layer.objects:
        other.select_set(False)
    obj.select_set(True)
    layer.objects.active = obj


def _material(material: HeadMaterial) -> Material:
    """The Blender material for one of the head's; one that is there already is used again."""
    name = f"Risorius {material.name}"
    found: Material | None = bpy.data.materials.get(name)
    if found is not None and found.library is None:
        return found
    made = new_material(name, material.colour, roughness=material.roughness, metallic=material.metallic)
    if material.name == SKIN:
        draw_in(made)
    return made
