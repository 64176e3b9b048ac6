"""Meshes whose connectivity is known: their feature points are stored as vertices, nothing needs to be searched.

A table (`presets/topologies/*.toml`) holds how many vertices the known part has (the mesh's first ones), how many edges
join them, a digest of these edges, and the points. So a mesh of another person, pose, unit or size is recognised, and
parts that come after the known one (clothes, eyes, teeth) do not matter. Tables that users save are read the same way.
"""

from __future__ import annotations

import hashlib
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from ...arrays import Floats, Ints
from ...errors import FormatError, ModelError
from ...files import write_whole
from ...mpeg4 import FEATURE_POINTS
from ...physics.mesh import Polygons, unique_edges
from ...resources import PRESETS

#: The tables that come with Risorius.
FOLDER = PRESETS / "topologies"


@dataclass(frozen=True)
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
    """The known topology of a mesh, the largest where there are several; None where it is unknown."""
    edges = unique_edges(polygons)
    for topology in sorted(topologies, key=lambda known: -known.vertices):
        if topology.vertices <= vertex_count:
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
    """
    path = Path(path)
    try:
        table = tomllib.loads(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise FormatError(path, f"is no readable table ({error})") from error
    for key, kind in (
        ("name", str),
        ("source", str),
        ("vertices", int),
        ("edges", int),
        ("sha1", str),
        ("points", dict),
    ):
        if not isinstance(table.get(key), kind):
            raise FormatError(path, f"needs an entry of type {kind.__name__}", key=key)
    points = {name: _read_point(path, name, place, table["vertices"]) for name, place in table["points"].items()}
    return Topology(table["name"], table["source"], table["vertices"], table["edges"], table["sha1"], points)


def _read_point(path: Path, name: str, place: Any, vertex_count: int) -> TopologyPoint:
    """A vertex, or [[vertices], [weights]]."""
    key = f'points."{name}"'
    if name not in FEATURE_POINTS:
        raise FormatError(path, "is no feature point; the standard names them 2.1 to 11.6", key=key)
    indices, weights = place if isinstance(place, list) and len(place) == 2 else ([place], [1.0])
    try:
        point = TopologyPoint(np.array(indices, dtype=np.int64), np.array(weights, dtype=np.float64))
    except (TypeError, ValueError) as error:
        raise FormatError(path, "must be a vertex, or [[vertices], [weights]]", key=key) from error
    if point.vertices.ndim != 1 or point.vertices.shape != point.weights.shape or len(point.vertices) == 0:
        raise FormatError(path, "needs as many weights as vertices", key=key)
    if point.vertices.min() < 0 or point.vertices.max() >= vertex_count:
        raise FormatError(path, f"names a vertex outside 0..{vertex_count - 1}", key=key)
    if abs(point.weights.sum() - 1.0) > 1e-6:
        raise FormatError(path, "must have weights that add up to 1", key=key)
    return point


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
        f"name = {_quoted(topology.name)}",
        f"source = {_quoted(topology.source)}",
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


def _quoted(text: str) -> str:
    """A TOML string."""
    escaped = text.replace("\\", "\\\\").replace('"', '\\"').replace("\n", " ")
    return f'"{escaped}"'
