"""Meshes and their shape keys."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from .animation import Datablock, DriverCurve
from .collections import Growing, Items, Numbers
from .nodes import Material


class VertexGroup(Protocol):
    """A named group of an object's vertices, or a vertex's share in one."""

    name: str
    index: int
    group: int
    weight: float

    def add(self, vertices: Sequence[int], weight: float, how: str) -> None: ...


class MeshVertex(Protocol):
    """One vertex."""

    co: Numbers
    index: int
    groups: Sequence[VertexGroup]


class MeshPolygon(Protocol):
    """One polygon."""

    vertices: Sequence[int]


class Attribute(Protocol):
    """A layer of figures over a mesh's vertices, edges, corners or faces."""

    name: str
    domain: str
    data_type: str
    data: Items[object]


class Attributes(Items[Attribute], Protocol):
    """A mesh's attributes."""

    def new(self, name: str, type: str, domain: str) -> Attribute: ...
    def remove(self, attribute: Attribute) -> None: ...


class UVLayer(Protocol):
    """Coordinates on pictures, per corner."""

    name: str
    active_render: bool
    data: Items[object]


class UVLayers(Items[UVLayer], Protocol):
    """A mesh's layers of coordinates."""

    active: UVLayer | None

    def new(self, *, name: str) -> UVLayer | None: ...


class Materials(Items["Material | None"], Protocol):
    """Materials of a mesh or a curve, in their slots."""

    def append(self, material: Material | None) -> None: ...


class Mesh(Datablock, Protocol):
    """A mesh; and of the data of other objects, what is used of it."""

    pose_position: str  # of an armature

    @property
    def vertices(self) -> Growing[MeshVertex]: ...
    @property
    def edges(self) -> Growing[object]: ...
    @property
    def loops(self) -> Growing[object]: ...
    @property
    def polygons(self) -> Growing[MeshPolygon]: ...
    @property
    def loop_triangles(self) -> Items[object]: ...
    @property
    def corner_normals(self) -> Items[object]: ...
    @property
    def attributes(self) -> Attributes: ...
    @property
    def uv_layers(self) -> UVLayers: ...
    @property
    def materials(self) -> Materials: ...
    @property
    def shape_keys(self) -> Key | None: ...
    @property
    def is_editmode(self) -> bool: ...
    @property
    def points(self) -> Items[object]: ...  # of a lattice
    def update(self, *, calc_edges: bool = False) -> None: ...
    def validate(self) -> bool: ...
    def calc_loop_triangles(self) -> None: ...


class ShapeKey(Protocol):
    """One shape key."""

    name: str
    value: float
    slider_min: float
    slider_max: float
    mute: bool
    vertex_group: str
    relative_key: ShapeKey
    data: Items[object]

    def driver_add(self, path: str) -> DriverCurve: ...


class Key(Datablock, Protocol):
    """The shape keys of a mesh."""

    use_relative: bool
    key_blocks: Items[ShapeKey]
    reference_key: ShapeKey
