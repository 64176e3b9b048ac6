"""The rotations nearest to many matrices."""

from __future__ import annotations

import numpy as np

from ...arrays import Floats

#: Newton's iteration ends where no entry changes more than this; it converges quadratically.
_SETTLED, _ROUNDS = 1e-9, 20


def nearest_rotations(moments: Floats) -> Floats:
    """(r, 3, 3) rotations R with the largest trace(R' M), for matrices M (r, 3, 3).

    The orthogonal part of a matrix that does not mirror, by Newton's iteration (Higham 1986, Computing the polar
    decomposition, SIAM J. Sci. Stat. Comput. 7); of one that mirrors, or is nearly singular, by singular values.
    """
    turned = np.ascontiguousarray(moments.transpose(1, 2, 0))
    size = np.sqrt((turned**2).sum(axis=(0, 1)))
    turned = turned / np.where(size > 0.0, size, 1.0)
    plain = _determinant(turned, _cofactors(turned)) > _SETTLED
    way = turned[:, :, plain]
    for _ in range(_ROUNDS if plain.any() else 0):
        cofactors = _cofactors(way)
        inverse = cofactors / _determinant(way, cofactors)
        scale = np.sqrt(np.sqrt((inverse**2).sum(axis=(0, 1)) / (way**2).sum(axis=(0, 1))))
        after = 0.5 * (scale * way + inverse / scale)
        change, way = float(np.abs(after - way).max()), after
        if change < _SETTLED:
            break
    rotations = np.empty_like(moments)
    rotations[plain] = way.transpose(2, 0, 1)
    rotations[~plain] = _by_singular_values(moments[~plain])
    return rotations


def _cofactors(matrices: Floats) -> Floats:
    """(3, 3, r) cofactors of matrices (3, 3, r): the transposed inverse times the determinant."""
    first, second, third = matrices
    return np.stack([_across(second, third), _across(third, first), _across(first, second)])


def _across(one: Floats, other: Floats) -> Floats:
    """(3, r) vector products of (3, r) and (3, r)."""
    (x, y, z), (u, v, w) = one, other
    return np.stack([y * w - z * v, z * u - x * w, x * v - y * u])


def _determinant(matrices: Floats, cofactors: Floats) -> Floats:
    """(r,) determinants."""
    return np.asarray((matrices[0] * cofactors[0]).sum(axis=0))


def _by_singular_values(moments: Floats) -> Floats:
    """As `nearest_rotations`, of any matrices."""
    left, _, right = np.linalg.svd(moments)
    mirrored = np.linalg.det(left @ right) < 0.0
    left[mirrored, :, 2] *= -1.0
    return np.asarray(left @ right)
