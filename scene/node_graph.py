"""Building node groups in a few words, the same in every Blender from 4.2 on."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeAlias

import bpy

from .blender_types import Node, NodeSocket, NodeTree

#: A node's socket, or what an input is set to: a figure, or a name.
Value: TypeAlias = NodeSocket | float | str


class NodeGraph:
    """A node group under construction."""

    def __init__(self, name: str, kind: str) -> None:
        """A new group: kind "GeometryNodeTree" or "ShaderNodeTree"."""
        self.tree: NodeTree = bpy.data.node_groups.new(name, kind)
        self._inputs: Node | None = None

    def takes(self, name: str, kind: str, default: float | None = None) -> NodeSocket:
        """A new input of the group, such as "NodeSocketFloat"; returns what flows from it."""
        socket = self.tree.interface.new_socket(name, in_out="INPUT", socket_type=kind)
        if default is not None:
            socket.default_value = default
        if self._inputs is None:
            self._inputs = self.tree.nodes.new("NodeGroupInput")
        return self._inputs.outputs[name]

    def gives(self, **values: NodeSocket) -> None:
        """The group's outputs, all at once; the kind of each is that of its value's socket."""
        kinds = {"GEOMETRY": "NodeSocketGeometry", "VECTOR": "NodeSocketVector", "VALUE": "NodeSocketFloat"}
        for name, value in values.items():
            self.tree.interface.new_socket(name, in_out="OUTPUT", socket_type=kinds[value.type])
        outputs = self.tree.nodes.new("NodeGroupOutput")
        for name, value in values.items():
            self.tree.links.new(value, outputs.inputs[name])

    def node(self, kind: str, *, settings: Mapping[str, object] | None = None, **inputs: Value) -> Node:
        """A node; `settings` are its properties, the rest its inputs by name, underscores for blanks."""
        node = self.tree.nodes.new(kind)
        for name, value in (settings or {}).items():
            setattr(node, name, value)
        for name, value in inputs.items():
            self._feed(node.inputs[name.replace("_", " ")], value)
        return node

    def math(self, operation: str, *values: Value) -> NodeSocket:
        """The result of a Math node."""
        node = self.node("ShaderNodeMath", settings={"operation": operation})
        for socket, value in zip(node.inputs, values, strict=False):
            self._feed(socket, value)
        return node.outputs[0]

    def vector(self, operation: str, *vectors: Value) -> Node:
        """A Vector Math node."""
        node = self.node("ShaderNodeVectorMath", settings={"operation": operation})
        for socket, value in zip(node.inputs, vectors, strict=False):
            self._feed(socket, value)
        return node

    def group(self, tree: NodeTree, **inputs: Value) -> Node:
        """A node that is another group."""
        kind = "GeometryNodeGroup" if self.tree.bl_idname == "GeometryNodeTree" else "ShaderNodeGroup"
        return self.node(kind, settings={"node_tree": tree}, **inputs)

    def separate(self, vector: Value) -> tuple[NodeSocket, NodeSocket, NodeSocket]:
        """The three figures of a vector."""
        x, y, z = self.node("ShaderNodeSeparateXYZ", Vector=vector).outputs
        return x, y, z

    def combine(self, x: Value, y: Value, z: Value) -> NodeSocket:
        """A vector of three figures."""
        return self.node("ShaderNodeCombineXYZ", X=x, Y=y, Z=z).outputs[0]

    def arranged(self) -> NodeTree:
        """The finished group, its nodes in columns by how many others they wait for."""
        depth: dict[str, int] = {}
        nodes = list(self.tree.nodes)
        for _ in nodes:
            before = dict(depth)
            for link in self.tree.links:
                after = depth.get(link.from_node.name, 0) + 1
                depth[link.to_node.name] = max(depth.get(link.to_node.name, 0), after)
            if depth == before:
                break
        rows: dict[int, int] = {}
        for node in nodes:
            column = depth.get(node.name, 0)
            row = rows[column] = rows.get(column, -1) + 1
            node.location = (220.0 * column, -220.0 * row)
            node.hide = node.bl_idname in {"ShaderNodeMath", "ShaderNodeVectorMath"}
        return self.tree

    def _feed(self, socket: NodeSocket, value: Value) -> None:
        """Link a socket to an input, or set a figure on it."""
        if isinstance(value, bpy.types.NodeSocket):
            self.tree.links.new(value, socket)
        else:
            socket.default_value = value
