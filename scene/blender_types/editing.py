"""Meshes as Blender edits them: vertices, edges, faces and their corners (bmesh)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Protocol

from .collections import Items, Numbers
from .meshes import Mesh


class EditVertex(Protocol):
    """A vertex; what layers hold of it, by layer."""

    co: Numbers
    index: int

    @property
    def link_edges(self) -> Sequence[EditEdge]: ...
    @property
    def link_loops(self) -> Sequence[EditCorner]: ...
    def __getitem__(self, layer: object) -> Numbers: ...
    def __setitem__(self, layer: object, value: Sequence[float]) -> None: ...


class EditCorner(Protocol):
    """A corner of a face."""

    @property
    def vert(self) -> EditVertex: ...
    @property
    def face(self) -> EditFace: ...
    def copy_from(self, other: EditCorner) -> None: ...


class EditEdge(Protocol):
    """An edge."""

    @property
    def verts(self) -> Sequence[EditVertex]: ...
    @property
    def link_faces(self) -> Sequence[EditFace]: ...
    @property
    def link_loops(self) -> Sequence[EditCorner]: ...
    def other_vert(self, vertex: EditVertex) -> EditVertex | None: ...


class EditFace(Protocol):
    """A face."""

    material_index: int

    @property
    def verts(self) -> Sequence[EditVertex]: ...
    @property
    def loops(self) -> Sequence[EditCorner]: ...


class EditLayers(Protocol):
    """What a mesh holds of its vertices."""

    @property
    def shape(self) -> Items[object]: ...


class EditVertices(Protocol):
    """All vertices."""

    @property
    def layers(self) -> EditLayers: ...
    def __iter__(self) -> Iterator[EditVertex]: ...
    def new(self, co: Sequence[float], example: EditVertex) -> EditVertex: ...
    def index_update(self) -> None: ...


class EditEdges(Protocol):
    """All edges."""

    def __iter__(self) -> Iterator[EditEdge]: ...


class EditFaces(Protocol):
    """All faces."""

    def __iter__(self) -> Iterator[EditFace]: ...
    def new(self, vertices: Sequence[EditVertex], example: EditFace) -> EditFace: ...


class EditMesh(Protocol):
    """A mesh that is being edited."""

    @property
    def verts(self) -> EditVertices: ...
    @property
    def edges(self) -> EditEdges: ...
    @property
    def faces(self) -> EditFaces: ...
    def from_mesh(self, mesh: Mesh) -> None: ...
    def to_mesh(self, mesh: Mesh) -> None: ...
    def free(self) -> None: ...
