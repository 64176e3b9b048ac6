"""The mesh, parts and axes that a caller gives, checked once: every refusal names the thing and the remedy."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike

from ...arrays import LARGEST, Floats, Ints
from ...errors import ModelError
from ...polygons import PolygonTable
from .parts import Part, Told
from .points import FeaturePoints, PointSource
from .sealed_eyes import add_sealed_eyes
from .template import TEMPLATE_POINTS
from .told import parts_of_told


def checked_vertices(vertices: ArrayLike) -> Floats:
    """(V, 3) float64, finite, not empty."""
    array = np.array(vertices, dtype=np.float64)
    if array.ndim != 2 or array.shape[1] != 3:
        raise ModelError(f"vertices must have the shape (V, 3), but have {array.shape}")
    if len(array) == 0:
        raise ModelError("the mesh is empty: it has no vertices")
    wrong = np.flatnonzero(~(np.abs(array) <= LARGEST).all(axis=1))
    if len(wrong):
        what = "beyond any mesh" if np.isfinite(array[wrong]).all() else "NaN or infinite"
        raise ModelError(
            f"{len(wrong)} vertices are {what}, the first is vertex {wrong[0]}: repair the mesh or delete them"
        )
    return array


def checked_polygons(polygons: Sequence[Sequence[int]] | ArrayLike, vertex_count: int) -> PolygonTable:
    """Polygons, in range."""
    table = _table(polygons)
    if not len(table):
        raise ModelError("the mesh has no polygons: the face needs a surface")
    small = np.flatnonzero(table.sizes < 3)
    if len(small):
        raise ModelError(f"polygon {small[0]} needs at least three corners")
    outside = np.flatnonzero((table.loops < 0) | (table.loops >= vertex_count))
    if len(outside):
        number, vertex = table.owners[outside[0]], table.loops[outside[0]]
        raise ModelError(f"polygon {number} uses vertex {vertex}, but the mesh has {vertex_count} vertices")
    return table


def _table(polygons: Sequence[Sequence[int]] | ArrayLike) -> PolygonTable:
    """Polygons of any kind as a table; index sequences may be nested in anything that NumPy reads."""
    if isinstance(polygons, PolygonTable):
        return polygons
    rows = [np.asarray(polygon, dtype=np.int64) for polygon in polygons]  # type: ignore[union-attr]
    for number, polygon in enumerate(rows):
        if polygon.ndim != 1:
            raise ModelError(f"polygon {number} needs at least three corners")
    return PolygonTable.of(rows)


def with_pupils(points: Mapping[str, PointSource], vertices: Floats) -> dict[str, PointSource]:
    """Points with 3.5 and 3.6 placed, where they are missing, as the template's pupils lie between lids and corners."""
    complete = dict(points)
    for pupil, around in (("3.5", ("3.1", "3.3", "3.7", "3.11")), ("3.6", ("3.2", "3.4", "3.8", "3.12"))):
        if pupil in complete or any(name not in complete for name in around):
            continue
        places = [place for name in around if (place := _place(complete[name], vertices)) is not None]
        if len(places) < len(around):
            continue
        template = [TEMPLATE_POINTS[name] for name in around]
        weights, *_ = np.linalg.lstsq(
            np.vstack([np.transpose(template), 0.01 * np.ones(4)]), np.append(TEMPLATE_POINTS[pupil], 0.01), rcond=None
        )
        complete[pupil] = np.transpose(places) @ (weights / weights.sum())
    return complete


def _place(source: PointSource, vertices: Floats) -> Floats | None:
    """Position of a point source, or None where it names no place (binding reports it)."""
    if isinstance(source, int | np.integer):
        return vertices[int(source)] if 0 <= int(source) < len(vertices) else None
    place = np.asarray(source, dtype=np.float64)
    return place if place.shape == (3,) else None


def checked_parts(parts: ArrayLike | None, vertex_count: int) -> Ints:
    """(V,) numbers of `Part` and `Told`; without any, all are `Told.ANYTHING`."""
    if parts is None:
        return np.full(vertex_count, int(Told.ANYTHING), dtype=np.int64)
    array = np.array(parts, dtype=np.int64)
    if array.shape != (vertex_count,):
        raise ModelError(f"parts must have one number per vertex ({vertex_count}), but have the shape {array.shape}")
    if not np.isin(array, [int(p) for p in (*Part, *Told)]).all():
        raise ModelError(f"parts must be numbers of Part (0 to {max(Part)}) or Told ({min(Told)} to {max(Told)})")
    if not np.isin(array, (Part.SKIN, Told.ANYTHING)).any():
        raise ModelError("the face has no skin: parts marks no vertex as skin (0)")
    return array


def known_parts(
    told: Ints, head: Floats, polygons: PolygonTable, landmarks: Mapping[str, Floats], points: FeaturePoints
) -> Ints:
    """(V,) numbers of `Part`: those that are told, and those that the shape of the mesh tells."""
    nose = points["9.3"]
    if not nose.is_bound:
        raise ModelError("feature point 9.3 (nose tip) is not on the mesh: give a vertex or a point on the surface")
    if (told >= 0).all():
        return told
    parts = parts_of_told(told, head, polygons, landmarks, int(nose.vertices[0]))
    if not (parts == Part.SKIN).any():
        raise ModelError("the face has no skin: parts marks no vertex as skin (0)")
    sealed = parts.copy()
    add_sealed_eyes(sealed, head, polygons, points.nearest, landmarks)
    return np.where(told < 0, sealed, parts)


def checked_axes(axes: ArrayLike) -> Floats:
    """(3, 3) float64, a rotation: left, up and forward of a head."""
    array = np.array(axes, dtype=np.float64)
    if array.shape != (3, 3) or not np.allclose(array @ array.T, np.eye(3), atol=1e-6) or np.linalg.det(array) < 0.0:
        raise ModelError(
            "axes must be three perpendicular unit vectors: the subject's left, up, forward; "
            "left x up must point forward"
        )
    return array
