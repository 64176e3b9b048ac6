"""The default head as a Blender object: one mesh with materials, parts and feature points."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np
from mathutils import Vector

from ..arrays import Floats
from ..face.default_head import HeadMesh, Material
from . import mesh as meshes
from .creases.marks import draw_in
from .faces import store_points
from .points.kept import Origin

NAME = "Risorius Head"

#: The material that draws creases where the baked skin is squeezed.
SKIN = "skin"

#: Half of the room that a head takes, metres.
ROOM = 0.3


def add_default_head(context: Any | None = None, *, location: Floats | None = None) -> Any:
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
        obj.location = location
    select_only(obj, context)
    return obj


def free_place(context: Any, wanted: Floats) -> Floats:
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


def head_object(head: HeadMesh, name: str) -> Any:
    """An object for a built head, not yet linked to a scene."""
    corners, sizes = meshes.flatten_polygons(head.polygons)
    mesh = meshes.new_mesh(name, head.vertices, corners, sizes)
    for material in head.materials:
        mesh.materials.append(_material(material))
    meshes.set_materials(mesh, head.material_index)
    meshes.write_parts(mesh, np.asarray(head.parts))
    obj = bpy.data.objects.new(name, mesh)
    store_points(obj, {n: _place(point) for n, point in head.points.items()}, origin=Origin.TOPOLOGY)
    return obj


def _place(point: int | Floats) -> int | tuple[float, float, float]:
    """A feature point as it is stored: a vertex index, or three plain numbers."""
    if isinstance(point, int | np.integer):
        return int(point)
    x, y, z = point
    return float(x), float(y), float(z)


def select_only(obj: Any, context: Any | None = None) -> None:
    """Select `obj` alone and make it active."""
    layer = (context or bpy.context).view_layer
    for other in layer.objects:
        other.select_set(False)
    obj.select_set(True)
    layer.objects.active = obj


def _material(material: Material) -> Any:
    """The Blender material for one of the head's; one that is there already is used again."""
    name = f"Risorius {material.name}"
    found = bpy.data.materials.get(name)
    if found is not None and found.library is None:
        return found
    made = bpy.data.materials.new(name)
    if made.node_tree is None:
        made.use_nodes = True
    made.diffuse_color = (*material.colour, 1.0)
    made.roughness = material.roughness
    principled = next((node for node in made.node_tree.nodes if node.type == "BSDF_PRINCIPLED"), None)
    if principled is not None:
        principled.inputs["Base Color"].default_value = (*material.colour, 1.0)
        principled.inputs["Roughness"].default_value = material.roughness
        if material.name == SKIN:
            draw_in(made)
    return made
