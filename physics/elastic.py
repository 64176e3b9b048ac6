"""The linear elastic skin: an area-consistent Laplacian, membrane + bending + anchors, and its factorisation.

One scalar matrix serves the three components of a displacement v (V, 3):

    K = membrane * L + L M^-1 diag(bending) L + diag(anchor) M,        M = vertex areas,

where u' L u is the integral of |grad u|^2 over the surface. L comes from the very springs of `springs.py`: a spring
on each side and diagonal of a polygon of area A with n of them has the stiffness 2 A / (n |e|^2), which sums to
|grad u|^2 A for a linear u over regular polygons. K is symmetric, and positive definite when anything is anchored.
"""

from __future__ import annotations

from copy import copy
from enum import StrEnum
from functools import cached_property

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import SuperLU, splu

from ..arrays import Bools, Floats, Ints
from ..errors import ParameterError, SolverError
from .mesh import Polygons, by_size, face_pairs, pair_keys, polygon_areas, within
from .mesh import Sparse as Sparse  # re-exported: whoever assembles K needs its type

_SHORTEST = 1e-2
"""A side shorter than this fraction of sqrt(polygon area) counts as this long: slivers must not freeze the skin."""


class LaplacianForm(StrEnum):
    """How the Laplacian is discretised."""

    SPRINGS = "springs"
    """Springs on sides and diagonals: never negative weights, the same network as the nonlinear skin."""
    COTANGENT = "cotangent"
    """Linear finite elements (a quad is the mean of its two splits): exact for linear fields on any triangles."""


def dirichlet_springs(vertices: Floats, polygons: Polygons) -> tuple[Ints, Floats]:
    """Springs whose energy is the Dirichlet integral of a displacement.

    Parameters
    ----------
    vertices : (V, 3) m.
    polygons : see `mesh`.

    Returns
    -------
    pairs : (S, 2) int64, sides and diagonals, each once, smaller index first, sorted.
    weights : (S,) dimensionless, sum over the polygons of 2 A / (n |e|^2); times a membrane stiffness in N/m they
        are spring constants in N/m. Sliver sides are lengthened to a hundredth of the polygon's size.
    """
    pairs, faces, counts = face_pairs(polygons)
    areas = polygon_areas(vertices, polygons)[faces]
    squared = ((vertices[pairs[:, 0]] - vertices[pairs[:, 1]]) ** 2).sum(axis=1)
    floor = np.maximum(squared, _SHORTEST**2 * areas)
    weights = np.divide(2 * areas, counts * floor, out=np.zeros_like(areas), where=areas > 0)
    keys, inverse = np.unique(pair_keys(np.sort(pairs, axis=1)), return_inverse=True)
    summed = np.bincount(inverse.ravel(), weights, minlength=len(keys)).astype(np.float64)
    return np.stack([keys >> 32, keys & 0xFFFFFFFF], axis=1), summed


def laplacian(
    vertices: Floats,
    polygons: Polygons,
    mask: Bools | None = None,
    *,
    form: LaplacianForm | str = LaplacianForm.SPRINGS,
) -> Sparse:
    """Area-consistent Laplacian: u' L u is the integral of |grad u|^2 over the surface.

    Parameters
    ----------
    vertices : (V, 3) m.
    polygons : see `mesh`.
    mask : (V,) bool; only polygons with all corners in it take part. None: all.
    form : springs (default) or cotangents.

    Returns
    -------
    (V, V) sparse, dimensionless, symmetric, positive semidefinite; constants are in its null space. Vertices in no
    polygon have empty rows.

    Raises
    ------
    ParameterError : unknown form, indices out of range.
    """
    vertices = np.asarray(vertices, dtype=np.float64)
    if mask is not None:
        polygons = within(polygons, np.asarray(mask, dtype=bool))
    if form == LaplacianForm.SPRINGS:
        pairs, weights = dirichlet_springs(vertices, polygons)
    elif form == LaplacianForm.COTANGENT:
        pairs, weights = _cotangents(vertices, polygons)
    else:
        raise ParameterError("form", f"must be one of {[str(f) for f in LaplacianForm]}", form)
    return pair_laplacian(pairs, weights, len(vertices))


def pair_laplacian(pairs: Ints, weights: Floats, vertex_count: int) -> Sparse:
    """Graph Laplacian (V, V) with sum over pairs of w (u_i - u_j)^2 = u' L u; repeated pairs add up."""
    i, j = pairs.T
    rows = np.concatenate([i, j, i, j]).astype(np.int32)  # half the traffic of int64 in every product
    columns = np.concatenate([j, i, i, j]).astype(np.int32)
    values = np.concatenate([-weights, -weights, weights, weights])
    return sparse.coo_array((values, (rows, columns)), shape=(vertex_count, vertex_count)).tocsr()


def elastic_matrix(
    laplacian: Sparse,
    areas: Floats,
    bending: Floats | float,
    anchor: Floats | float,
    membrane: float = 1.0,
) -> Sparse:
    """The matrix K of the module, per unit of membrane stiffness.

    Parameters
    ----------
    laplacian : (V, V) of `laplacian`, dimensionless.
    areas : (V,) m^2 of `mesh.vertex_areas`.
    bending : (V,) or one value, m^2: the square of the length below which displacement is smoothed.
    anchor : (V,) or one value, 1/m^2: the inverse square of the length over which a displacement dies away.
    membrane : weight of the first term; K scales with the true stiffness in N/m.

    Returns
    -------
    (V, V) sparse, symmetric; with any anchor > 0 on each connected piece it is positive definite. A vertex without
    area gets the mean diagonal, so that it stays where it is and the matrix can be factored.

    Raises
    ------
    ParameterError : a negative or non-finite parameter, or a shape that does not fit.
    """
    count = laplacian.shape[0]
    areas = _per_vertex("areas", areas, count)
    stiffness = membrane * laplacian + bending_matrix(laplacian, areas, bending)
    diagonal = _per_vertex("anchor", anchor, count) * areas
    empty = areas <= 0
    if empty.any() and not empty.all():
        diagonal[empty] = (stiffness.diagonal() + diagonal)[~empty].mean()
    return (stiffness + diagonal_matrix(diagonal)).tocsr()


def bending_matrix(laplacian: Sparse, areas: Floats, bending: Floats | float) -> Sparse:
    """L M^-1 diag(bending) L, (V, V): the integral of bending * (div grad u)^2; bending in m^2 per vertex."""
    count = laplacian.shape[0]
    areas = _per_vertex("areas", areas, count)
    weight = np.divide(_per_vertex("bending", bending, count), areas, out=np.zeros(count), where=areas > 0)
    half = diagonal_matrix(np.sqrt(weight)) @ laplacian
    return (half.T @ half).tocsr()


def diagonal_matrix(values: Floats) -> Sparse:
    """The values (n,) on the diagonal of an (n, n) sparse matrix."""
    index = np.arange(len(values), dtype=np.int32)
    return sparse.csr_array((values, (index, index)), shape=(len(values), len(values)))


class Factor:
    """A symmetric positive definite sparse matrix, factored once, for any number of solves.

    Parameters
    ----------
    matrix : (n, n) sparse, symmetric positive definite.
    least : no eigenvalue is below this, where that is known; far enough above 0 it spares looking at the pivots, for
        which the factors are copied.

    Raises
    ------
    SolverError : the matrix is not positive definite (a piece of skin without anchor).
    """

    _SMALLEST_PIVOT = 1e-12
    """Least pivot relative to its own diagonal entry; rounding alone leaves about 1e-15 of a singular one."""

    _TOGETHER = 24
    """So many columns are solved at once: more would not stay in the processor's cache, and take half as long again."""

    def __init__(self, matrix: Sparse, *, least: float = 0.0) -> None:
        self.shape: tuple[int, int] = (int(matrix.shape[0]), int(matrix.shape[1]))
        self._matrix = sparse.csc_array(matrix)
        self._scale = 1.0
        factor, diagonal = self._factor, matrix.diagonal()
        if least > self._SMALLEST_PIVOT * diagonal.max(initial=0.0):
            return  # no pivot is below the least eigenvalue
        pivots = factor.U.diagonal() / diagonal[np.argsort(factor.perm_c)]
        if not pivots.min() > self._SMALLEST_PIVOT:
            raise SolverError(
                "the elastic matrix is not positive definite; anchor every piece of the skin",
                residual=float(pivots.min()),
            )

    @cached_property
    def _factor(self) -> SuperLU:
        """The factors, which a factor that is kept and read again works out when it is first used."""
        try:
            return splu(
                self._matrix,
                permc_spec="MMD_AT_PLUS_A",
                relax=1,  # no padding of supernodes: a fifth less to run through in every solve
                panel_size=6,  # columns that are worked out together: a tenth faster than what is usual
                diag_pivot_thresh=0.0,
                options={"SymmetricMode": True},
            )
        except RuntimeError as error:
            raise SolverError("the elastic matrix is singular; anchor every piece of the skin") from error

    def times(self, scale: float) -> Factor:
        """The factor of the matrix times a number above 0, without factoring it again."""
        scaled = copy(self)
        scaled._scale = self._scale * scale
        return scaled

    def solve(self, right: Floats) -> Floats:
        """The solution x of matrix @ x = right, for `right` (n,) or (n, k)."""
        right = np.asarray(right, dtype=np.float64)
        if right.ndim == 1 or right.shape[1] <= self._TOGETHER:
            solution = np.asarray(self._factor.solve(right))
        else:
            solution = np.empty(right.shape, order="F")
            for first in range(0, right.shape[1], self._TOGETHER):
                some = np.s_[:, first : first + self._TOGETHER]
                solution[some] = self._factor.solve(np.asfortranarray(right[some]))
        return solution if self._scale == 1.0 else solution / self._scale


def _cotangents(vertices: Floats, polygons: Polygons) -> tuple[Ints, Floats]:
    """Pairs (N, 2) and half cotangent weights, repeated per triangle; a quad is the mean of its two splits."""
    pairs, weights = [], []
    for _, index in by_size(polygons, len(vertices)):
        size = index.shape[1]
        starts = range(size if size > 3 else 1)
        for start in starts:
            fan = np.roll(index, -start, axis=1)
            for k in range(1, size - 1):
                triangle = fan[:, [0, k, k + 1]]
                for corner in range(3):
                    apex, a, b = np.roll(triangle, -corner, axis=1).T
                    u, v = vertices[a] - vertices[apex], vertices[b] - vertices[apex]
                    twice = np.linalg.norm(np.cross(u, v), axis=1)
                    cotangent = np.divide((u * v).sum(axis=1), twice, out=np.zeros(len(u)), where=twice > 0)
                    pairs.append(np.stack([a, b], axis=1))
                    weights.append(cotangent / (2 * len(starts)))
    if not pairs:
        return np.empty((0, 2), dtype=np.int64), np.empty(0)
    return np.concatenate(pairs), np.concatenate(weights)


def _per_vertex(name: str, value: Floats | float, count: int) -> Floats:
    """The value as a fresh (count,) array, checked finite and not negative."""
    array = np.array(np.broadcast_to(np.asarray(value, dtype=np.float64), (count,)))
    if not np.isfinite(array).all() or (array < 0).any():
        wrong = array[~(np.isfinite(array) & (array >= 0))][0]
        raise ParameterError(name, "must be finite and not negative at every vertex", float(wrong))
    return array
