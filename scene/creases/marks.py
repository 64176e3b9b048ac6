"""Creases on a Blender mesh: attributes that say where they lie, and a modifier that says how full they are.

Everything is the object's own and saved with it. The user's attributes, modifiers and materials stay as they are.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING
from weakref import WeakKeyDictionary

import numpy as np

from ..as_read import is_there
from ..attributes import remove_attribute, write_vectors
from ..blender_types import Material, Modifier, Node, NodeSocket, NodeTree, Object
from ..faces import FaceSource, Piece, face_of
from ..materials import node_tree_of, principled_of
from ..modifiers import add_first, take_away
from . import nodes

if TYPE_CHECKING:
    from ...api import Face
    from ...face.products.creases import Creases

MODIFIER = "Risorius Creases"

#: On an object of a file from before 0.2, whose resting positions are handed to its modifiers because of us.
RESTING = "risorius_creases"

#: On an object whose creases rest while it is rendered without them.
UNMEASURED = "risorius_unmeasured"

#: By what the depth of a full crease multiplies the skin's colour: light that has gone through skin comes out red.
DEPTH = (0.72, 0.54, 0.5)

#: The creases of faces, which take most of a second to place and depend on nothing else.
_placed: WeakKeyDictionary[Face, Creases] = WeakKeyDictionary()


def prepare(source: FaceSource, wanted: bool | None) -> Creases | None:
    """The creases to `settle` on a face.

    Parameters
    ----------
    wanted : None: where a material of the head draws them, or they are there already.
    """
    from ...face.products.creases import Creases

    if wanted is None:
        wanted = has(source.head) or shown_by(source.head)
    if not wanted:
        return None
    face = face_of(source)
    if face not in _placed:
        _placed[face] = Creases(face)
    return _placed[face]


def settle(source: FaceSource, creases: Creases | None) -> None:
    """Give the head these creases in place of those it had; None: take them away."""
    obj = source.head
    if creases is None:
        remove(obj)
        return
    _clear(obj)
    _write_places(source.pieces[0], creases)
    add_first(obj, MODIFIER, nodes.measuring_group(creases.rounds))
    nodes.drawing_group().use_fake_user = not shown_by(obj)


def remove(obj: Object) -> None:
    """Take away all that `settle` has put on an object, and the node groups that nothing uses then."""
    if has(obj):
        _clear(obj)
        nodes.forget_unused()


def has(obj: Object) -> bool:
    """Whether an object has creases."""
    return any(_is_ours(modifier) for modifier in obj.modifiers)


def shown_by(obj: Object) -> bool:
    """Whether a material of the object draws creases: then they are worth having without being asked for."""
    return any(
        nodes.is_drawing(getattr(node, "node_tree", None))
        for material in obj.data.materials
        if material is not None and material.node_tree is not None
        for node in material.node_tree.nodes
    )


def draw_in(material: Material) -> None:
    """Let a material of ours draw creases: as a bump, and a little darker and redder in their depth.

    The skin's colour stays a plain factor, which exporters understand.
    """
    graph, surface = node_tree_of(material), principled_of(material)[0]
    x, y = surface.location
    group = graph.nodes.new("ShaderNodeGroup")
    group.node_tree = nodes.drawing_group()
    group.location = (x - 660.0, y - 200.0)
    graph.links.new(group.outputs["Normal"], surface.inputs["Normal"])
    tint = _mix(graph, "MIX", (1.0, 1.0, 1.0, 1.0), (*DEPTH, 1.0))
    tint.location = (x - 440.0, y)
    graph.links.new(group.outputs["Shade"], _socket(tint.inputs, "Factor_Float"))
    colour = _mix(graph, "MULTIPLY", surface.inputs["Base Color"].default_value, (1.0, 1.0, 1.0, 1.0))
    colour.location = (x - 220.0, y)
    _socket(colour.inputs, "Factor_Float").default_value = 1.0
    graph.links.new(_socket(tint.outputs, "Result_Color"), _socket(colour.inputs, "B_Color"))
    graph.links.new(_socket(colour.outputs, "Result_Color"), surface.inputs["Base Color"])


def _mix(graph: NodeTree, how: str, a: object, b: object) -> Node:
    """A node that mixes two colours."""
    node = graph.nodes.new("ShaderNodeMix")
    node.data_type, node.blend_type = "RGBA", how
    _socket(node.inputs, "A_Color").default_value = a
    _socket(node.inputs, "B_Color").default_value = b
    return node


def _socket(sockets: Iterable[NodeSocket], identifier: str) -> NodeSocket:
    """A socket by its identifier: several bear the same name."""
    return next(socket for socket in sockets if socket.identifier == identifier)


def _write_places(head: Piece, creases: Creases) -> None:
    """The attributes that stay as they are in every pose."""
    vectors = {nodes.REST: head.mix, nodes.HEAD: creases.head_positions[head.slice]}
    for name, crease in creases.creases.items():
        places = crease.places[head.slice]
        vectors[nodes.PLACE + name] = np.column_stack([places, np.zeros(len(places))])
    for name, values in vectors.items():
        write_vectors(head.obj.data, name, values)


@contextmanager
def unmeasured(objects: Iterable[Object]) -> Iterator[None]:
    """Renders that would not show creases, without measuring them: the modifiers rest, and are as they were after."""
    resting = [obj for obj in objects if any(_is_ours(m) and m.show_render for m in obj.modifiers)]
    for obj in resting:
        obj[UNMEASURED] = True
        _set_shown(obj, False)
    try:
        yield
    finally:
        measure_again(obj for obj in resting if is_there(obj))


def measure_again(objects: Iterable[Object]) -> None:
    """Let the modifiers of those act that `unmeasured` has at rest, also where a save or an undo has kept them so."""
    for obj in objects:
        if UNMEASURED in obj:
            del obj[UNMEASURED]
            _set_shown(obj, True)


def _set_shown(obj: Object, shown: bool) -> None:
    """Whether renders show the creases of an object."""
    for modifier in obj.modifiers:
        if _is_ours(modifier):
            modifier.show_render = shown


def _clear(obj: Object) -> None:
    """Remove modifier and attributes."""
    for modifier in [modifier for modifier in obj.modifiers if _is_ours(modifier)]:
        take_away(obj, modifier)
    ours = [a.name for a in obj.data.attributes if a.name in (nodes.REST, nodes.HEAD) or a.name.startswith(nodes.PLACE)]
    for name in ours:
        remove_attribute(obj.data, name)
    if RESTING in obj:
        obj.add_rest_position_attribute = False
        del obj[RESTING]


def _is_ours(modifier: Modifier) -> bool:
    """Whether a modifier is that of `settle`."""
    return modifier.type == "NODES" and nodes.is_measuring(modifier.node_group)
