"""Materials that are looked through: corneas, tear films, lenses of glasses."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ...arrays import Bools
from ..blender_types import Material, Node, NodeSocket, Object

#: A surface that lets more than this through is looked through.
HALF = 0.5
#: Shaders that let light through.
CLEAR = {"BSDF_TRANSPARENT", "BSDF_REFRACTION", "BSDF_GLASS"}
#: Inputs of the usual shader: how much covers what is behind, and how much goes through.
COVERS, LETS = "Alpha", ("Transmission Weight", "Transmission")


def clear_slots(obj: Object, *, workbench: bool) -> Bools:
    """(n,) which material slots of an object are looked through; one slot at least.

    Workbench draws a material by its colour for the viewport, all others by its nodes.
    """
    told = [_is_clear(slot.material, workbench=workbench) for slot in obj.material_slots]
    return np.array(told or [False])


def _is_clear(material: Material | None, *, workbench: bool) -> bool:
    if material is None:
        return False
    if workbench or not material.use_nodes or material.node_tree is None:
        return material.diffuse_color[3] < HALF
    ends = [node for node in material.node_tree.nodes if node.type == "OUTPUT_MATERIAL" and node.is_active_output]
    return any(_lets_through(node) for end in ends for node in _before(end.inputs["Surface"]))


def _lets_through(node: Node) -> bool:
    """Whether a shader shows what is behind it. What a picture decides, as on cards of hair, is taken as solid."""
    if node.type in CLEAR:
        return True
    if node.type == "BSDF_PRINCIPLED":
        covers = _figure(node.inputs.get(COVERS), 1.0)
        lets = [_figure(node.inputs.get(name), 0.0) for name in LETS]
        return covers < HALF or max(lets) > HALF
    if node.type == "ADD_SHADER":
        return any(_lets_through(each) for socket in node.inputs for each in _before(socket))
    if node.type != "MIX_SHADER":
        return False
    share, first, second = list(node.inputs)
    if share.is_linked:
        by_picture = any(each.type == "TEX_IMAGE" for each in _before(share))
        return not by_picture and any(_lets_through(each) for socket in (first, second) for each in _before(socket))
    chosen = second if _figure(share, HALF) >= HALF else first
    return any(_lets_through(each) for each in _before(chosen))


def _figure(socket: NodeSocket | None, otherwise: float) -> float:
    """What an input is set to; `otherwise` where it has none, or something decides it place by place."""
    if socket is None or socket.is_linked or not isinstance(socket.default_value, int | float):
        return otherwise
    return float(socket.default_value)


def _before(socket: NodeSocket) -> Iterator[Node]:
    """The nodes that feed an input, through reroutes."""
    for link in socket.links:
        node = link.from_node
        if node.type == "REROUTE":
            yield from _before(node.inputs[0])
        else:
            yield node
