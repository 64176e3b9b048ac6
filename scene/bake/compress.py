"""A motion as few shapes times weights: a truncated singular value decomposition with a bound on every vertex."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arrays import Floats
from ...errors import ParameterError
from ...progress import Progress, Work, run

#: Every vertex of a life-size face stays within this of the simulated motion, metres; of others in proportion.
TOLERANCE = 1e-4

#: Figures of a motion that are worked through in one step, and what is said meanwhile.
BLOCK, TEXT = 2_000_000, "Compressing the motion to shape keys"


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
    return run(compress_steps(displacements, tolerance=tolerance))


def compress_steps(displacements: Floats, *, tolerance: float = TOLERANCE) -> Work[Shapes]:
    """As `compress`, bit by bit."""
    if not tolerance > 0.0:
        raise ParameterError("tolerance", "must be above zero", tolerance)
    if displacements.ndim != 3 or displacements.shape[2] != 3 or not np.isfinite(displacements).all():
        raise ParameterError("displacements", "must be finite (frames, vertices, 3)", displacements.shape)
    frame_count, vertex_count, _ = displacements.shape
    flat = displacements.reshape(frame_count, -1)
    left, scale = yield from _loadings(flat)
    rest = np.empty_like(flat)
    for part in _blocks(flat):
        yield Progress(0.0, TEXT)
        rest[:, part] = flat[:, part]
    largest = yield from _largest(rest)
    shapes: list[Floats] = []
    weights: list[Floats] = []
    while largest > tolerance and len(shapes) < len(left):
        loadings, size = left[len(shapes)], scale[len(shapes)]
        shape = (loadings / size**2) @ flat
        peak = loadings[np.argmax(np.abs(loadings))]
        # Rounded as Blender will hold them, so that the bound holds for what is written.
        weight = (loadings / peak).astype(np.float32).astype(np.float64)
        shaped = (shape * peak).astype(np.float32).astype(np.float64)
        for part in _blocks(flat):
            yield Progress(0.5, TEXT)
            rest[:, part] -= weight[:, None] * shaped[part]
        largest = yield from _largest(rest)
        shapes.append(shaped)
        weights.append(weight)
    return Shapes(
        np.array(shapes).reshape(-1, vertex_count, 3),
        np.array(weights).reshape(-1, frame_count).T.copy(),
        largest,
    )


def _blocks(flat: Floats) -> list[slice[int, int, None]]:
    """Columns of (T, 3V) block by block: whole vertices, and about so many figures as are soon worked through."""
    width = 3 * max(BLOCK // (3 * max(len(flat), 1)), 1)
    return [slice(first, first + width) for first in range(0, flat.shape[1], width)]


def _loadings(flat: Floats) -> Work[tuple[Floats, Floats]]:
    """Scaled left singular vectors (K, T), largest first, and singular values (K,), by the (T, T) eigenproblem."""
    gram = np.zeros((len(flat), len(flat)))
    for part in _blocks(flat):
        yield Progress(0.0, TEXT)
        gram += flat[:, part] @ flat[:, part].T
    values, vectors = np.linalg.eigh(gram)
    order = np.argsort(values)[::-1]
    kept = order[values[order] > 1e-14 * max(float(values[order[0]]), 1e-300)]
    scale = np.sqrt(values[kept])
    return (vectors[:, kept] * scale).T, scale


def _largest(flat: Floats) -> Work[float]:
    """Largest length of any of the (T, V) vectors in (T, 3V)."""
    largest = 0.0
    for part in _blocks(flat):
        yield Progress(0.5, TEXT)
        lengths = (flat[:, part].reshape(len(flat), -1, 3) ** 2).sum(axis=2)
        largest = max(largest, float(np.sqrt(lengths.max(initial=0.0))))
    return largest
