"""Catmull-Clark subdivision of a quad mesh, its limit, and the cage whose limit passes through given points.

Everything is a sparse matrix acting on vertex positions, so that weights authored on the cage can be carried to the
finished mesh by the same matrix. Source of the masks: E. Catmull, J. Clark, "Recursively generated B-spline surfaces
on arbitrary topological meshes", 1978; limit masks after M. Halstead, M. Kass, T. DeRose, "Efficient, fair
interpolation using Catmull-Clark surfaces", 1993, and the cubic B-spline curve at open borders.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import sparse

from ...arrays import Bools, Floats, Ints
from ...errors import SolverError


@dataclass(frozen=True, eq=False)
class QuadEdges:
    """The edges of a quad mesh.

    Attributes
    ----------
    ends : (E, 2) int64, vertex indices, ascending in each row.
    of_quad : (F, 4) int64, edge between corner k and k + 1 of each quad.
    border : (E,) bool, edges with one quad only.
    """

    ends: Ints
    of_quad: Ints
    border: Bools


@dataclass(frozen=True, eq=False)
class Subdivision:
    """One Catmull-Clark step.

    Attributes
    ----------
    matrix : (V + E + F, V) sparse; new positions are `matrix @ positions`, old vertices first, then edges, then faces.
    quads : (4 F, 4) int64; the children of quad f are rows 4 f ... 4 f + 3.
    edges : the edges of the mesh that was divided.
    """

    matrix: sparse.csr_matrix
    quads: Ints
    edges: QuadEdges


def quad_edges(quads: Ints) -> QuadEdges:
    """Edges of a quad mesh; `quads` (F, 4) int64."""
    pairs = np.sort(np.stack([quads, np.roll(quads, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
    ends, inverse, count = np.unique(pairs, axis=0, return_inverse=True, return_counts=True)
    return QuadEdges(ends.astype(np.int64), inverse.reshape(quads.shape).astype(np.int64), count == 1)


def subdivide(vertex_count: int, quads: Ints) -> Subdivision:
    """One Catmull-Clark step on a quad mesh of `vertex_count` vertices, `quads` (F, 4) int64."""
    edges = quad_edges(quads)
    edge_count, face_count = len(edges.ends), len(quads)
    faces = _matrix(np.repeat(np.arange(face_count), 4), quads.ravel(), 0.25, (face_count, vertex_count))
    midpoints = _matrix(np.repeat(np.arange(edge_count), 2), edges.ends.ravel(), 0.5, (edge_count, vertex_count))
    edge_faces = _matrix(edges.of_quad.ravel(), np.repeat(np.arange(face_count), 4), 1.0, (edge_count, face_count))
    inner = _diagonal((~edges.border).astype(np.float64))
    border = _diagonal(edges.border.astype(np.float64))
    edge_points = border @ midpoints + inner @ (0.5 * midpoints + 0.25 * edge_faces @ faces)

    valence, is_border = _valence(vertex_count, edges)
    vertex_faces = _matrix(quads.ravel(), np.repeat(np.arange(face_count), 4), 1.0, (vertex_count, face_count))
    vertex_edges = _matrix(edges.ends.ravel(), np.repeat(np.arange(edge_count), 2), 1.0, (vertex_count, edge_count))
    m = np.where(is_border, 1.0, valence)
    around = vertex_faces @ faces + 2.0 * vertex_edges @ midpoints
    smooth = _diagonal(np.where(is_border, 0.0, 1.0 / m**2)) @ around
    smooth = smooth + _diagonal(np.where(is_border, 0.0, (m - 3.0) / m))
    curve = 0.25 * _diagonal(is_border.astype(np.float64)) @ (vertex_edges @ border @ midpoints)
    curve = curve + _diagonal(np.where(is_border, 0.5, 0.0))

    e = edges.of_quad + vertex_count
    f = np.arange(face_count)[:, None] + vertex_count + edge_count
    children = np.stack([quads, e, np.broadcast_to(f, quads.shape), np.roll(e, 1, axis=1)], axis=2)
    matrix = sparse.csr_matrix(sparse.vstack([smooth + curve, edge_points, faces]))
    return Subdivision(matrix, children.reshape(-1, 4).astype(np.int64), edges)


def limit_matrix(vertex_count: int, quads: Ints) -> sparse.csr_matrix:
    """(V, V) sparse matrix that takes the vertices of a quad mesh to their Catmull-Clark limit points.

    Inside, for valence m: (m^2 v + 4 sum of edge neighbours + sum of opposite corners) / (m (m + 5));
    on an open border: (4 v + both border neighbours) / 6.
    """
    edges = quad_edges(quads)
    valence, is_border = _valence(vertex_count, edges)
    shape = (vertex_count, vertex_count)
    both = np.concatenate([edges.ends, edges.ends[:, ::-1]])
    neighbours = _matrix(both[:, 0], both[:, 1], 1.0, shape)
    rim = np.concatenate([edges.ends[edges.border], edges.ends[edges.border][:, ::-1]])
    rim_neighbours = _matrix(rim[:, 0], rim[:, 1], 1.0, shape)
    opposite = _matrix(quads.ravel(), np.roll(quads, 2, axis=1).ravel(), 1.0, shape)
    inner = _diagonal(np.where(is_border, 0.0, 1.0 / (valence * (valence + 5.0))))
    surface = inner @ (_diagonal(valence**2) + 4.0 * neighbours + opposite)
    curve = _diagonal(is_border / 6.0) @ (4.0 * sparse.identity(vertex_count) + rim_neighbours)
    return sparse.csr_matrix(surface + curve)


def cage_through(targets: Floats, quads: Ints, *, rounds: int = 60, tolerance: float = 1e-5) -> Floats:
    """Cage whose limit surface passes through `targets`, one point per cage vertex.

    Fixed-point iteration C += T - limit(C); it converges because the limit matrix is close to the identity.

    Parameters
    ----------
    targets : (V, 3) float64, any unit.
    quads : (F, 4) int64.
    rounds : number of iterations.
    tolerance : largest distance allowed to remain, in the unit of `targets`.

    Raises
    ------
    SolverError : when the limit is still farther from a target than `tolerance`; residual is that distance.
    """
    limit = limit_matrix(len(targets), quads)
    cage = targets.copy()
    for _ in range(rounds):
        cage += targets - limit @ cage
    residual = float(np.linalg.norm(targets - limit @ cage, axis=1).max())
    if not residual <= tolerance:
        raise SolverError("the head's cage does not reach its figures: a figure is out of order", residual=residual)
    return cage


def _matrix(rows: Ints, columns: Ints, value: float, shape: tuple[int, int]) -> sparse.csr_matrix:
    """Sparse matrix with one value at every (row, column)."""
    return sparse.csr_matrix((np.full(len(rows), value), (rows, columns)), shape=shape)


def _diagonal(values: Floats) -> sparse.csr_matrix:
    """Sparse diagonal matrix."""
    n = len(values)
    return sparse.csr_matrix((values, np.arange(n), np.arange(n + 1)), shape=(n, n))


def _valence(vertex_count: int, edges: QuadEdges) -> tuple[Floats, Bools]:
    """Number of edges at each vertex, and whether it lies on an open border."""
    valence = np.bincount(edges.ends.ravel(), minlength=vertex_count).astype(np.float64)
    is_border = np.zeros(vertex_count, dtype=bool)
    is_border[edges.ends[edges.border].ravel()] = True
    return valence, is_border
