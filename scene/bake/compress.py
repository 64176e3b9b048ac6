"""A motion as few shapes times weights: a truncated singular value decomposition with a bound on every vertex."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arrays import Floats
from ...errors import ParameterError

#: Every vertex of a life-size face stays within this of the simulated motion, metres; of others in proportion.
TOLERANCE = 1e-4


@dataclass(frozen=True, eq=False)
class Shapes:
    """A motion as ``displacement[t] = sum_k weights[t, k] * shapes[k]``.

    Attributes
    ----------
    shapes : (K, V, 3) displacements, metres.
    weights : (T, K) in [-1, 1]; the largest of each shape is 1.
    error : the largest distance of any vertex in any frame from the motion it stands for, metres.
    """

    shapes: Floats
    weights: Floats
    error: float

    def displacement(self) -> Floats:
        """(T, V, 3) the motion that the shapes and weights make, metres."""
        return np.asarray(np.tensordot(self.weights, self.shapes, axes=1), dtype=np.float64)


def compress(displacements: Floats, *, tolerance: float = TOLERANCE) -> Shapes:
    """Write a motion with as few shapes as keep every vertex of every frame within `tolerance`.

    The singular vectors of the (T, 3V) matrix of displacements, largest first, are taken until the bound holds. A
    frame without displacement gets weights of exactly zero, so a rest stays a rest.

    Parameters
    ----------
    displacements : (T, V, 3) from the resting face, metres.
    tolerance : the bound, metres.

    Raises
    ------
    ParameterError : a tolerance that is not above zero, or displacements of another shape or not finite.
    """
    if not tolerance > 0.0:
        raise ParameterError("tolerance", "must be above zero", tolerance)
    if displacements.ndim != 3 or displacements.shape[2] != 3 or not np.isfinite(displacements).all():
        raise ParameterError("displacements", "must be finite (frames, vertices, 3)", displacements.shape)
    frame_count, vertex_count, _ = displacements.shape
    flat = displacements.reshape(frame_count, -1)
    residual = flat.copy()
    left, right = _singular_vectors(flat)
    shapes, weights = [], []
    for loadings, shape in zip(left, right, strict=True):
        if _largest(residual) <= tolerance:
            break
        peak = loadings[np.argmax(np.abs(loadings))]
        # Rounded as Blender will hold them, so that the bound holds for what is written.
        weight = (loadings / peak).astype(np.float32).astype(np.float64)
        shaped = (shape * peak).astype(np.float32).astype(np.float64)
        residual -= weight[:, None] * shaped
        shapes.append(shaped)
        weights.append(weight)
    return Shapes(
        np.array(shapes).reshape(-1, vertex_count, 3),
        np.array(weights).reshape(-1, frame_count).T.copy(),
        _largest(residual),
    )


def _singular_vectors(flat: Floats) -> tuple[Floats, Floats]:
    """Scaled left vectors (K, T) and right vectors (K, 3V), largest first, by the small (T, T) eigenproblem."""
    values, vectors = np.linalg.eigh(flat @ flat.T)
    order = np.argsort(values)[::-1]
    kept = order[values[order] > 1e-14 * max(float(values[order[0]]), 1e-300)]
    scale = np.sqrt(values[kept])
    left: Floats = (vectors[:, kept] * scale).T
    right: Floats = (vectors[:, kept] / scale).T @ flat
    return left, right


def _largest(flat: Floats) -> float:
    """Largest length of any of the (T, V) vectors in (T, 3V)."""
    if flat.size == 0:
        return 0.0
    return float(np.sqrt((flat.reshape(-1, 3) ** 2).sum(axis=1).max()))
