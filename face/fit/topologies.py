"""Meshes whose connectivity is known: their feature points are stored as vertices, nothing needs to be searched.

A table (`presets/topologies/*.toml`) holds how many vertices the known part has (the mesh's first ones), how many edges
join them, a digest of these edges, and the points. So a mesh of another person, pose, unit or size is recognised, and
parts that come after the known one (clothes, eyes, teeth) do not matter. Tables that users save are read the same way.
"""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np

from ...arrays import Floats, Ints
from ...errors import ModelError
from ...files import write_whole
from ...mpeg4 import FEATURE_POINTS
from ...physics.mesh import Polygons, unique_edges
from ...resources import PRESETS
from ...tables import TomlTable, read_toml, toml_text

#: The tables that come with Risorius.
FOLDER = PRESETS / "topologies"


@dataclass(frozen=True, eq=False)
class TopologyPoint:
    """A feature point as a mean of vertices: indices (k,), weights (k,) that add up to 1."""

    vertices: Ints
    weights: Floats


@dataclass(frozen=True)
class Topology:
    """One known connectivity.

    Attributes
    ----------
    name : for people.
    source : where the mesh comes from, and its licence.
    vertices : how many of a mesh's first vertices belong to it.
    edges : how many edges join these.
    digest : SHA-1 of these edges as sorted little-endian int32 pairs, in hexadecimal.
    points : feature point -> vertices and weights.
    """

    name: str
    source: str
    vertices: int
    edges: int
    digest: str
    points: Mapping[str, TopologyPoint]

    def places(self, vertices: Floats) -> dict[str, Floats]:
        """Feature point -> position (3,) on a mesh (V, 3) of this topology."""
        return {name: point.weights @ vertices[point.vertices] for name, point in self.points.items()}


def recognise_topology(vertex_count: int, polygons: Polygons, topologies: Sequence[Topology]) -> Topology | None:
    """The known topology of a mesh, the largest where there are several; None where it is unknown.

    Examples
    --------
    >>> _ = api.save_topology("mine.toml", api.default_face(), name="my heads")
    >>> face = api.default_face()
    >>> api.recognise_topology(len(face.vertices), face.polygons, api.load_topologies(".")).name
    'Risorius, default head'
    """
    possible = [topology for topology in topologies if topology.vertices <= vertex_count]
    edges = unique_edges(polygons, below=max((topology.vertices for topology in possible), default=0))
    for topology in sorted(possible, key=lambda known: -known.vertices):
        known = edges[(edges < topology.vertices).all(axis=1)]
        if len(known) == topology.edges and edge_digest(known) == topology.digest:
            return topology
    return None


def edge_digest(edges: Ints) -> str:
    """SHA-1 of edges (E, 2), smaller index first and sorted, as little-endian int32."""
    return hashlib.sha1(np.ascontiguousarray(edges, dtype="<i4").tobytes(), usedforsecurity=False).hexdigest()


def load_topologies(*folders: str | Path) -> tuple[Topology, ...]:
    """The tables of some folders, after those of Risorius itself.

    Raises
    ------
    FormatError : a table with a missing or wrong entry.

    Examples
    --------
    >>> _ = api.save_topology("mine.toml", api.default_face(), name="my heads")
    >>> api.load_topologies(".")[-1].name
    'my heads'
    """
    found = list(_shipped())
    for folder in folders:
        found += [read_topology(path) for path in sorted(Path(folder).glob("*.toml"))]
    return tuple(found)


@lru_cache(maxsize=1)
def _shipped() -> tuple[Topology, ...]:
    return tuple(read_topology(path) for path in sorted(FOLDER.glob("*.toml")))


def read_topology(path: str | Path) -> Topology:
    """Read one table.

    Raises
    ------
    FormatError : says which entry is missing or wrong.

    Examples
    --------
    >>> _ = api.save_topology("mine.toml", api.default_face(), name="my heads")
    >>> "8.3" in api.read_topology("mine.toml").points
    True
    """
    table = read_toml(path)
    count, points = table.integer("vertices", least=1), table.table("points")
    return Topology(
        name=table.text("name"),
        source=table.text("source", ""),
        vertices=count,
        edges=table.integer("edges", least=0),
        digest=table.text("sha1"),
        points={name: _read_point(points, name, count) for name in points},
    )


def _read_point(points: TomlTable, name: str, vertex_count: int) -> TopologyPoint:
    """A vertex, or [[vertices], [weights]]."""
    if name not in FEATURE_POINTS:
        raise points.refuse("is not a feature point; the standard uses 2.1 to 11.6", name)
    if not isinstance(points.cells[name], list):
        vertex = points.integer(name, least=0, most=vertex_count - 1)
        return TopologyPoint(np.array([vertex], dtype=np.int64), np.ones(1))
    if len(points.cells[name]) != 2:
        raise points.refuse("must be a vertex, or [[vertices], [weights]]", name)
    place = points.entries(name)
    vertices, weights = place.numbers("0"), place.numbers("1")
    if len(vertices) == 0 or len(vertices) != len(weights):
        raise points.refuse("needs as many weights as vertices", name)
    if (vertices != np.rint(vertices)).any() or vertices.min() < 0 or vertices.max() >= vertex_count:
        raise points.refuse(f"names a vertex outside 0..{vertex_count - 1}", name)
    if abs(weights.sum() - 1.0) > 1e-6:
        raise points.refuse("must have weights that add up to 1", name)
    return TopologyPoint(vertices.astype(np.int64), weights)


def topology_of(
    name: str, source: str, vertex_count: int, polygons: Polygons, points: Mapping[str, TopologyPoint]
) -> Topology:
    """The topology of a mesh with its feature points, to be saved.

    Raises
    ------
    ModelError : without points.
    """
    if not points:
        raise ModelError("a topology needs feature points: find or set them first")
    edges = unique_edges(polygons)
    edges = edges[(edges < vertex_count).all(axis=1)]
    return Topology(name, source, vertex_count, len(edges), edge_digest(edges), dict(points))


def write_topology(path: str | Path, topology: Topology) -> None:
    """Write a table that `read_topology` reads.

    Raises
    ------
    FormatError : the file cannot be written.
    """
    lines = [
        f"name = {toml_text(topology.name)}",
        f"source = {toml_text(topology.source)}",
        f"vertices = {topology.vertices}",
        f"edges = {topology.edges}",
        f'sha1 = "{topology.digest}"',
        "",
        "[points]",
    ]
    for name, point in topology.points.items():
        if len(point.vertices) == 1:
            lines.append(f'"{name}" = {point.vertices[0]}')
        else:
            lines.append(f'"{name}" = [{point.vertices.tolist()}, {[round(w, 12) for w in point.weights.tolist()]}]')
    write_whole(path, "\n".join(lines) + "\n")
