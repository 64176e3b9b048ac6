"""The rotations nearest to many matrices."""

from __future__ import annotations

import numpy as np

from ...arrays import Floats

#: Newton's iteration ends where no entry changes more than this: it converges quadratically, so what is left is its
#: square. Matrices whose determinant is no more than the second are not left to it.
_SETTLED, _SINGULAR, _ROUNDS = 3e-5, 1e-9, 20

#: Entries of a matrix (row by row) whose products make each of its cofactors: first times second less third times last.
_MINORS = (
    (4, 8, 5, 7), (5, 6, 3, 8), (3, 7, 4, 6),
    (2, 7, 1, 8), (0, 8, 2, 6), (1, 6, 0, 7),
    (1, 5, 2, 4), (2, 3, 0, 5), (0, 4, 1, 3),
)  # fmt: skip


def nearest_rotations(moments: Floats) -> Floats:
    """(r, 3, 3) rotations R with the largest trace(R' M), for matrices M (r, 3, 3).

    The orthogonal part of a matrix that does not mirror, by Newton's iteration (Higham 1986, Computing the polar
    decomposition, SIAM J. Sci. Stat. Comput. 7); of one that mirrors, or is nearly singular, by singular values.
    """
    way = np.ascontiguousarray(moments.reshape(-1, 9).T)
    way /= np.maximum(np.sqrt(_squares(way)), np.finfo(np.float64).tiny)
    plain = _determinants(way, _cofactors(way)) > _SINGULAR
    way = way if plain.all() else way[:, plain]
    for _ in range(_ROUNDS if plain.any() else 0):
        inverse = _cofactors(way)
        inverse /= _determinants(way, inverse)
        scale = np.sqrt(np.sqrt(_squares(inverse) / _squares(way)))
        after = way * (0.5 * scale)
        inverse *= 0.5 / scale
        after += inverse
        change, way = float(np.abs(after - way).max()), after
        if change < _SETTLED:
            break
    rotations = np.empty_like(moments)
    rotations[plain] = way.T.reshape(-1, 3, 3)
    if not plain.all():
        rotations[~plain] = _by_singular_values(moments[~plain])
    return rotations


def _cofactors(matrices: Floats) -> Floats:
    """(9, r) cofactors of matrices (9, r): the transposed inverse times the determinant."""
    cofactors, other = np.empty_like(matrices), np.empty(matrices.shape[1])
    for each, (first, second, third, last) in zip(cofactors, _MINORS, strict=True):
        np.multiply(matrices[first], matrices[second], out=each)
        each -= np.multiply(matrices[third], matrices[last], out=other)
    return cofactors


def _determinants(matrices: Floats, cofactors: Floats) -> Floats:
    """(r,) determinants of matrices (9, r) with their cofactors."""
    return np.asarray(np.einsum("ir,ir->r", matrices[:3], cofactors[:3]))


def _squares(matrices: Floats) -> Floats:
    """(r,) sums of the squares of what matrices (9, r) hold."""
    return np.asarray(np.einsum("ir,ir->r", matrices, matrices))


def _by_singular_values(moments: Floats) -> Floats:
    """As `nearest_rotations`, of any matrices."""
    left, _, right = np.linalg.svd(moments)
    mirrored = np.linalg.det(left @ right) < 0.0
    left[mirrored, :, 2] *= -1.0
    return np.asarray(left @ right)
