"""A face shown as it would be, on top of whatever the mesh is, and taken away again without a trace.

The shown positions are an attribute of the mesh that a modifier, first in the stack, puts in place of the vertices:
shape keys and animation stay as they are, and later modifiers go on working. Renders do not show it.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import bpy

from ...arrays import Floats
from ..attributes import remove_attribute, write_vectors
from ..blender_types import Modifier, NodeTree, Object
from ..modifiers import add_first, take_away
from ..node_graph import NodeGraph

NAME = "Risorius Preview"
ATTRIBUTE = "risorius_preview"


def show(obj: Object, positions: Floats) -> None:
    """Show positions (V, 3) in the mesh's own coordinates."""
    mesh = obj.data
    write_vectors(mesh, ATTRIBUTE, positions)
    modifier = _modifier(obj)
    if modifier is None:
        modifier = add_first(obj, NAME, _group())
        modifier.show_render = modifier.show_in_editmode = modifier.show_expanded = False
    modifier.show_viewport = True
    mesh.update_tag()


def rest(objects: Sequence[Object]) -> None:
    """Let objects show themselves again, ready for the next `show`."""
    for obj in objects:
        modifier = _modifier(obj)
        if modifier is not None and modifier.show_viewport:
            modifier.show_viewport = False


def is_shown(obj: Object) -> bool:
    """Whether `obj` shows a preview now."""
    modifier = _modifier(obj)
    return modifier is not None and bool(modifier.show_viewport)


def has_preview(obj: Object) -> bool:
    """Whether anything of a preview is on `obj`."""
    return obj.type == "MESH" and (_modifier(obj) is not None or ATTRIBUTE in obj.data.attributes)


def remove_all() -> None:
    """Take every preview out of the file, wherever it may have been left."""
    for obj in bpy.data.objects:
        if obj.type == "MESH" and obj.library is None:
            modifier = _modifier(obj)
            if modifier is not None:
                take_away(obj, modifier)
    remove_unused()


def remove_unused() -> None:
    """Take away what no object shows any more: places on meshes, and the modifier's group."""
    shown = {obj.data for obj in bpy.data.objects if obj.type == "MESH" and _modifier(obj) is not None}
    for mesh in bpy.data.meshes:
        if mesh.library is None and mesh not in shown and not mesh.is_editmode:
            remove_attribute(mesh, ATTRIBUTE)
    for tree in [tree for tree in bpy.data.node_groups if _is_ours(tree)]:
        if tree.users - tree.use_fake_user == 0:
            bpy.data.node_groups.remove(tree)


def _modifier(obj: Object) -> Modifier | None:
    """Our modifier on an object."""
    return next((m for m in obj.modifiers if m.type == "NODES" and _is_ours(m.node_group)), None)


def _is_ours(tree: NodeTree | None) -> bool:
    """Whether a node tree is our group, or a copy of it."""
    return tree is not None and tree.bl_idname == "GeometryNodeTree" and tree.name.startswith(NAME)


def _group() -> NodeTree:
    """The geometry node group that puts vertices where the attribute says."""
    groups: Iterable[NodeTree] = bpy.data.node_groups
    for tree in groups:
        if _is_ours(tree) and tree.library is None:
            return tree
    graph = NodeGraph(NAME, "GeometryNodeTree")
    graph.tree.is_modifier = True
    geometry = graph.takes("Geometry", "NodeSocketGeometry")
    place = graph.node("GeometryNodeInputNamedAttribute", settings={"data_type": "FLOAT_VECTOR"}, Name=ATTRIBUTE)
    there = place.outputs["Attribute"]
    moved = graph.node(
        "GeometryNodeSetPosition", Geometry=geometry, Position=there, Selection=place.outputs["Exists"]
    ).outputs[0]
    graph.gives(Geometry=moved)
    return graph.arranged()
