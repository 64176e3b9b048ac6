"""Materials and worlds with nodes, made and looked into, the same in every Blender from 4.2 on."""

from __future__ import annotations

import bpy

from .blender_types import Material, Node, NodeTree, World

Colour = tuple[float, float, float]


def node_tree_of(owner: Material | World) -> NodeTree:
    """The nodes of a material or world; before Blender 5.0 a new one has none until it is told to use them."""
    if owner.node_tree is None:
        owner.use_nodes = True
    tree = owner.node_tree
    assert tree is not None
    return tree


def principled_of(material: Material) -> list[Node]:
    """The nodes of a material that shade a surface."""
    return [node for node in node_tree_of(material).nodes if node.type == "BSDF_PRINCIPLED"]


def new_material(name: str, colour: Colour, *, roughness: float | None = None, metallic: float = 0.0) -> Material:
    """A new material of one colour (linear RGB), for Workbench and for the engines that use nodes."""
    material: Material = bpy.data.materials.new(name)
    material.diffuse_color = (*colour, 1.0)
    if roughness is not None:
        material.roughness = roughness
    material.metallic = metallic
    for node in principled_of(material):
        node.inputs["Metallic"].default_value = metallic
        node.inputs["Base Color"].default_value = (*colour, 1.0)
        if roughness is not None:
            node.inputs["Roughness"].default_value = roughness
    return material
