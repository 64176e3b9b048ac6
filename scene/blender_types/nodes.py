"""Nodes, and what is made of them: materials and worlds; pictures."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from .animation import Datablock
from .collections import Items, Numbers


class NodeSocket(Protocol):
    """An input or output of a node."""

    name: str
    type: str
    identifier: str
    default_value: object
    is_linked: bool
    links: Items[NodeLink]


class Node(Protocol):
    """A node. From `node_tree` on: members of some kinds only."""

    name: str
    type: str
    bl_idname: str
    is_active_output: bool
    location: Numbers
    hide: bool
    inputs: Items[NodeSocket]
    outputs: Items[NodeSocket]
    node_tree: NodeTree | None
    image: Image | None
    extension: str
    uv_map: str
    data_type: str
    blend_type: str


class Nodes(Items[Node], Protocol):
    """Nodes of a tree."""

    active: Node | None

    def new(self, kind: str) -> Node: ...
    def remove(self, node: Node) -> None: ...


class NodeLink(Protocol):
    """A link between nodes."""

    from_node: Node
    to_node: Node
    to_socket: NodeSocket


class NodeLinks(Items[NodeLink], Protocol):
    """Links of a tree."""

    def new(self, one: NodeSocket, other: NodeSocket) -> NodeLink: ...


class NodeInterface(Protocol):
    """The sockets of a group."""

    def new_socket(self, name: str, *, in_out: str, socket_type: str) -> NodeSocket: ...


class NodeTree(Datablock, Protocol):
    """Nodes and their links."""

    bl_idname: str
    is_modifier: bool
    nodes: Nodes
    links: NodeLinks
    interface: NodeInterface


class Material(Datablock, Protocol):
    """A material."""

    use_nodes: bool
    diffuse_color: Numbers
    roughness: float
    metallic: float

    @property
    def node_tree(self) -> NodeTree | None: ...


class World(Datablock, Protocol):
    """A world."""

    use_nodes: bool
    color: Numbers

    @property
    def node_tree(self) -> NodeTree | None: ...


class Pixels(Protocol):
    """All figures of a picture, row by row from below, four a pixel."""

    def foreach_get(self, flat: NDArray[np.float32]) -> None: ...
    def foreach_set(self, flat: NDArray[np.float32]) -> None: ...


class Image(Datablock, Protocol):
    """A picture."""

    size: Sequence[int]
    pixels: Pixels
    filepath_raw: str
    file_format: str

    def scale(self, width: int, height: int) -> None: ...
    def update(self) -> None: ...
    def pack(self) -> None: ...
    def save(self) -> None: ...
