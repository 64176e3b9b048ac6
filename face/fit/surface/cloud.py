"""A surface as points spread evenly over it, so that its tessellation does not matter."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.spatial import cKDTree

from ....arrays import Bools, Floats, Ints
from ....physics.mesh import Polygons, triangulate, vertex_normals
from .shelves import Cells, Shelves

#: A normal with less than this length has no direction.
_TINY = 1e-30
#: So many triangles at a time fit a processor's cache.
_AT_ONCE = 1 << 15


@dataclass(frozen=True, eq=False)
class Surface:
    """A triangulated mesh.

    Attributes
    ----------
    vertices : (V, 3) in any unit.
    triangles : (T, 3) int64.
    normals : (V, 3) smooth unit normals, zero where a vertex lies in no triangle of any area.
    """

    vertices: Floats
    triangles: Ints
    normals: Floats

    @classmethod
    def from_polygons(cls, vertices: Floats, polygons: Polygons) -> Surface:
        """The surface of a mesh (V, 3) with polygons."""
        return cls(vertices, triangulate(polygons), vertex_normals(vertices, polygons))

    def cross(self) -> Floats:
        """(T, 3) normals of the triangles, twice as long as their areas."""
        a, b, c = (self.vertices[self.triangles[:, k]] for k in range(3))
        return np.asarray(np.cross(b - a, c - a), dtype=np.float64)

    @cached_property
    def twice_areas(self) -> Floats:
        """(T,) areas of the triangles, doubled."""
        areas = np.empty(len(self.triangles))
        for start in range(0, len(areas), _AT_ONCE):
            some = slice(start, start + _AT_ONCE)
            areas[some] = np.linalg.norm(Surface(self.vertices, self.triangles[some], self.normals).cross(), axis=1)
        return areas

    @cached_property
    def cells(self) -> Cells:
        """The triangles on shelves by place; worth it for many triangles."""
        return Cells.of(self.vertices, self.triangles, self.twice_areas / 2.0)

    def flipped(self) -> Surface:
        """The same surface, inside out."""
        flipped = Surface(self.vertices, self.triangles[:, ::-1], -self.normals)
        for name in ("twice_areas", "cells"):  # many guesses look at one dense mesh from behind
            if name in self.__dict__:
                flipped.__dict__[name] = self.__dict__[name]
        return flipped

    def part(self, chosen: Bools) -> Surface:
        """The surface of the chosen (T,) triangles, with the same vertices."""
        part = Surface(self.vertices, self.triangles[chosen], self.normals)
        part.__dict__["twice_areas"] = self.twice_areas[chosen]  # dozens of parts are taken of one dense mesh
        return part


@dataclass(frozen=True, eq=False)
class Cloud:
    """Points on a surface: positions (N, 3), unit normals (N, 3), and the triangle (N,) that each lies on."""

    positions: Floats
    normals: Floats
    triangles: Ints

    def __len__(self) -> int:
        return len(self.positions)

    def take(self, chosen: Ints | Bools) -> Cloud:
        """Some of the points."""
        return Cloud(self.positions[chosen], self.normals[chosen], self.triangles[chosen])


def nearest(tree: cKDTree, places: Floats, *, within: float = np.inf) -> tuple[Floats, Ints]:
    """Distance (N,) and index (N,) of the point of a tree nearest to each place; infinite where none is in reach."""
    distance, index = tree.query(places, distance_upper_bound=within)
    return np.asarray(distance, dtype=np.float64), np.asarray(index, dtype=np.int64)


def sample(surface: Surface, count: int, seed: int = 0) -> Cloud:
    """Points spread over a surface, as many per area everywhere; the same for the same seed.

    Returns an empty cloud where the surface has no area.
    """
    areas = surface.twice_areas
    total = float(areas.sum())
    if not total > 0.0:
        return Cloud(np.zeros((0, 3)), np.zeros((0, 3)), np.zeros(0, dtype=np.int64))
    random = np.random.default_rng(seed)
    places = (np.arange(count) + random.random(count)) * (total / count)
    chosen = np.minimum(np.searchsorted(np.cumsum(areas), places), len(areas) - 1)
    return _points_on(surface, chosen.astype(np.int64), random)


def sample_shelves(surface: Surface, shelves: Shelves, chosen: Bools, count: int, seed: int = 0) -> Cloud:
    """Points spread over what lies on some shelves (S,), as `sample` spreads them."""
    random = np.random.default_rng(seed)
    return _points_on(surface, shelves.drawn(chosen, count, random), random)


def _points_on(surface: Surface, chosen: Ints, random: np.random.Generator) -> Cloud:
    """A point anywhere on each of some triangles (N,)."""
    u, v = random.random(len(chosen)), random.random(len(chosen))
    outside = u + v > 1.0
    u, v = np.where(outside, 1.0 - u, u), np.where(outside, 1.0 - v, v)
    positions, normals = np.zeros((len(chosen), 3)), np.zeros((len(chosen), 3))
    for weight, corner in zip((1.0 - u - v, u, v), surface.triangles[chosen].T, strict=True):
        positions += weight[:, None] * surface.vertices[corner]
        normals += weight[:, None] * surface.normals[corner]
    normals /= np.maximum(np.linalg.norm(normals, axis=1), _TINY)[:, None]
    return Cloud(positions, normals, chosen)


def first_hits(depth: Floats, across: Floats, up: Floats, *, pixel: float, tolerance: float) -> Bools:
    """Which points (N,) are seen along a direction.

    Parameters
    ----------
    depth : (N,) distance along the line of sight, smaller is nearer.
    across, up : (N,) position in the picture.
    pixel : width of a pixel.
    tolerance : how far behind the nearest point of its pixel a point still counts as seen.
    """
    columns = np.floor((across - across.min()) / pixel).astype(np.int64)
    rows = np.floor((up - up.min()) / pixel).astype(np.int64)
    pixels = columns * (int(rows.max()) + 1) + rows
    nearest = np.full(int(pixels.max()) + 1, np.inf)
    np.minimum.at(nearest, pixels, depth)
    seen: Bools = depth <= nearest[pixels] + tolerance
    return seen
