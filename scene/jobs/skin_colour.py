"""Another colour for a face's skin."""

from __future__ import annotations

import numpy as np

from ...errors import SceneError
from ...face.mesh.parts import Part
from .. import mesh as meshes
from ..attributes import read_ints
from ..blender_types import Material, NodeSocket, Object
from ..materials import Colour, principled_of


def colour_skin(obj: Object, colour: Colour) -> None:
    """Give the skin of a head a colour (linear RGB), in all engines.

    Raises
    ------
    SceneError : the skin has no material, or a picture for its colour; nothing has been changed then.
    """
    material = _skin_material(obj)
    surfaces = principled_of(material)
    sockets = [_colour_socket(obj, node.inputs["Base Color"]) for node in surfaces]
    for socket in sockets:
        socket.default_value = (*colour, 1.0)
    material.diffuse_color = (*colour, 1.0)


def _skin_material(obj: Object) -> Material:
    """The material that most of the skin has."""
    materials = obj.data.materials
    slots = read_ints(obj.data.polygons, "material_index")
    parts = meshes.read_parts(obj.data)
    if parts is not None:
        corners, sizes = meshes.polygon_arrays(obj.data)
        first = corners[np.cumsum(sizes) - sizes]
        slots = slots[parts[first] == int(Part.SKIN)]
    used = np.bincount(slots, minlength=1)
    number = int(used.argmax())
    material = materials[number] if number < len(materials) else None
    if material is None:
        raise SceneError(obj.name, "its skin has no material: give it one, or leave the colour of the skin as it is")
    return material


def _colour_socket(obj: Object, socket: NodeSocket) -> NodeSocket:
    """Where a surface gets its colour: its own socket, or that of the node which draws creases in it."""
    if not socket.is_linked:
        return socket
    before = socket.links[0].from_node
    if getattr(before, "blend_type", "") == "MULTIPLY":
        own = next(each for each in before.inputs if each.identifier == "A_Color")
        if not own.is_linked:
            return own
    raise SceneError(obj.name, "its skin has a picture for its colour: leave the colour of the skin as it is")
