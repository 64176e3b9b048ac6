"""Binding feature points to a mesh, and where they are after the mesh has been changed.

A point holds on to the polygon that it lies on. As long as the mesh has the same polygons it moves with its vertices;
once it has others, the point goes to the nearest place of the new surface, or is lost where there is none.
"""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np
from mathutils import Vector
from mathutils.bvhtree import BVHTree
from mathutils.interpolate import poly_3d_calc

from ...arrays import Floats, Ints
from ...face.mesh.point_files import PointTable
from ...polygons import PolygonTable
from .. import mesh as meshes
from ..blender_types import Mesh, SearchTree
from ..shape_mix import resting_values
from .kept import KeptPoint, KeptPoints, Origin, mesh_counts, triple

#: A place farther from the surface than this share of the diagonal of all points lies off it, as a pupil does.
OFF_SURFACE = 5e-3
#: A point farther from a changed surface than this share of that diagonal is lost.
LOST = 1e-2
#: Shares below this are none.
SMALLEST_SHARE = 1e-6

#: Vertices, and their shares in a place.
Held: TypeAlias = tuple[tuple[int, ...], tuple[float, ...]]


@dataclass(frozen=True, eq=False)
class Surface:
    """The resting surface of a mesh, to look up places on."""

    vertices: Floats
    triangles: Ints
    counts: tuple[int, int, int]
    digest: str
    tree: SearchTree

    @classmethod
    def of(cls, mesh: Mesh) -> Surface:
        """Read a mesh's resting surface; the last one is kept, as one piece of work asks for it several times."""
        vertices, digest = meshes.rest_vertices(mesh), mesh_digest(mesh)
        for last in _last:
            if last.digest == digest and np.array_equal(last.vertices, vertices):
                return last
        from ...physics.mesh import triangulate

        triangles = triangulate(PolygonTable(*meshes.polygon_arrays(mesh)))
        tree = BVHTree.FromPolygons(vertices.tolist(), triangles.tolist(), all_triangles=True)
        _last[:] = [cls(vertices, triangles, mesh_counts(mesh), digest, tree)]
        return _last[0]

    def nearest(self, place: Floats) -> tuple[Floats, int, float] | None:
        """The nearest place (3,), its triangle and its distance."""
        found, _, triangle, distance = self.tree.find_nearest(Vector(place))
        return None if found is None else (np.array(found, dtype=np.float64), int(triangle), float(distance))

    def bound(self, place: Floats, reach: float) -> Held | None:
        """Vertices and shares of the place of the surface nearest to `place`; None beyond `reach`."""
        near = self.nearest(place)
        if near is None or near[2] > reach:
            return None
        return shares(self.triangles[near[1]].tolist(), self.vertices, near[0])

    def kept(self, held: Held | None, place: Floats, confidence: float, origin: Origin) -> KeptPoint:
        """A point at a place, held by vertices of this surface or by none."""
        if held is None:
            return KeptPoint(triple(place), confidence=confidence, origin=origin)
        on = triple(_place(*held, self.vertices))
        return KeptPoint(triple(place), *held, on, confidence, origin)


#: The surface that was read last.
_last: list[Surface] = []


@dataclass(frozen=True)
class Followed:
    """Points as they are on the mesh now.

    Attributes
    ----------
    kept : bound to the mesh as it is.
    moved_on : whether the mesh has other polygons than when they were stored.
    lost : names of the points that the mesh has no place for any more.
    """

    kept: KeptPoints
    moved_on: bool
    lost: tuple[str, ...]


def shares(corners: Sequence[int], vertices: Floats, place: Floats) -> Held:
    """Vertices of a polygon, and their shares in a place on it."""
    weights = np.array(poly_3d_calc([Vector(vertices[v]) for v in corners], Vector(place)), dtype=np.float64)
    held = weights > SMALLEST_SHARE
    kept = weights[held] / weights[held].sum()
    return tuple(int(v) for v in np.array(corners)[held]), tuple(float(w) for w in kept)


def mesh_digest(mesh: Mesh) -> str:
    """A name for exactly these polygons."""
    digest = hashlib.blake2b(digest_size=12)
    for array in meshes.polygon_arrays(mesh):
        digest.update(array.tobytes())
    return digest.hexdigest()


def bind(
    mesh: Mesh,
    points: PointTable,
    *,
    origins: Mapping[str, Origin] | Origin = Origin.FILE,
    confidence: Mapping[str, float] | None = None,
) -> KeptPoints:
    """Points of a table bound to a mesh.

    Parameters
    ----------
    points : name -> vertex index, or position (3,) in the mesh's own coordinates.
    origins : where they come from, each or all.
    confidence : name -> 0 .. 1; 1 where nothing is said.
    """
    surface = Surface.of(mesh)
    places = {n: surface.vertices[p] if isinstance(p, int) else np.asarray(p, float) for n, p in points.items()}
    reach = OFF_SURFACE * _extent(places)
    kept = {}
    for name, point in points.items():
        held = ((point,), (1.0,)) if isinstance(point, int) else surface.bound(places[name], reach)
        origin = origins if isinstance(origins, Origin) else origins.get(name, Origin.FILE)
        sure = 1.0 if confidence is None else float(np.clip(confidence.get(name, 1.0), 0.0, 1.0))
        kept[name] = surface.kept(held, places[name], sure, origin)
    return KeptPoints(surface.counts, surface.digest, kept, resting=resting_values(mesh))


def moved(kept: KeptPoints, name: str, place: Floats, surface: Surface, origin: Origin) -> KeptPoints:
    """The same points, one of them put to another place of the surface by hand."""
    near = surface.nearest(place)
    at = place if near is None else near[0]
    put = surface.kept(surface.bound(at, np.inf), at, 1.0, origin)
    return replace(kept, points={**kept.points, name: put})


def fits(kept: KeptPoints, mesh: Mesh) -> bool:
    """Whether a mesh has the polygons that the points are bound to."""
    return kept.counts == mesh_counts(mesh) and kept.digest == mesh_digest(mesh)


def followed(kept: KeptPoints, mesh: Mesh) -> Followed:
    """Points on a mesh as it is now: the same polygons carry them along; on others they go to the nearest place."""
    if fits(kept, mesh):
        return Followed(kept, False, ())
    surface = Surface.of(mesh)
    reach = LOST * _extent({name: np.array(point.at) for name, point in kept.points.items()})
    points, lost = {}, []
    for name, point in kept.points.items():
        held = surface.bound(np.array(point.at), reach) if point.is_bound else None
        if point.is_bound and held is None:
            lost.append(name)
        else:
            points[name] = surface.kept(held, np.array(point.at), point.confidence, point.origin)
    return Followed(replace(kept, counts=surface.counts, digest=surface.digest, points=points), True, tuple(lost))


def places(kept: KeptPoints, vertices: Floats) -> dict[str, Floats]:
    """Name -> (3,) where points are, when the vertices (V, 3) of their mesh lie where they are given.

    Bound points have moved as their vertices have. Points off the surface move as the bound ones do on the whole: by
    the affine motion that fits these best.
    """
    given = {name: np.array(point.at) for name, point in kept.points.items()}
    bound = {name: point for name, point in kept.points.items() if point.is_bound}
    was = np.array([point.on for point in bound.values()])
    shift = np.array([_place(point.vertices, point.weights, vertices) for point in bound.values()]) - was
    if not bound or np.abs(shift).max() <= SMALLEST_SHARE * _extent(given):
        return given
    turn = np.linalg.lstsq(was - was.mean(axis=0), shift - shift.mean(axis=0), rcond=1e-6)[0]
    whole = {n: at + shift.mean(axis=0) + (at - was.mean(axis=0)) @ turn for n, at in given.items()}
    own = zip(bound, was + shift, was, strict=True)
    return whole | {n: now + (given[n] - then) @ (np.eye(3) + turn) for n, now, then in own}


def table_of(kept: KeptPoints, vertices: Floats) -> dict[str, int | tuple[float, float, float]]:
    """Points as a table: name -> vertex index, or position in the mesh's own coordinates."""
    now = places(kept, vertices)
    return {
        name: point.vertices[0] if len(point.vertices) == 1 else triple(now[name])
        for name, point in kept.points.items()
    }


def _extent(given: Mapping[str, Floats]) -> float:
    """The diagonal of all points together; of one alone, no bound at all."""
    extent = float(np.linalg.norm(np.ptp(np.array(list(given.values())), axis=0))) if given else 0.0
    return extent if extent > 0.0 else np.inf


def _place(vertices: tuple[int, ...], weights: tuple[float, ...], positions: Floats) -> Floats:
    """(3,) the weighted mean of some vertices."""
    place: Floats = np.array(weights) @ positions[list(vertices)]
    return place
