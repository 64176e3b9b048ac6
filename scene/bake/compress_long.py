"""A long motion as few shapes times weights.

The shapes are made from some hundred of its frames; the weights of each frame are those that come nearest to it at
vertices that tell the shapes apart.

The whole motion is never in memory: five minutes are gigabytes.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ...arrays import Floats, Ints
from ...progress import Progress, Work, part_of
from .compress import TOLERANCE, Shapes

if TYPE_CHECKING:
    from ...face.long_motion import LongMotion

#: Frames, spread evenly, from which shapes are made beside those that were posed; and that see how far others are off.
SPREAD, CHECKED = 400, 100
#: Vertices that tell weights, for each shape.
TELLING = 3
#: Frames whose weights are found at once.
BLOCK = 500
#: Figures of each frame that are compared at once, and what share of the largest is nothing.
COLUMNS, LEAST = 3000, 1e-12


def compress_long(motion: LongMotion, rest: Floats, *, tolerance: float = TOLERANCE) -> Work[Shapes]:
    """A long motion with as few shapes as keep every vertex within `tolerance` at the frames they are made from.

    Parameters
    ----------
    rest : (V, 3) of the face. tolerance : metres.

    Returns
    -------
    Shapes with weights for every frame; their `error` is the largest at frames between those, too.
    """
    steps = np.union1d(motion.posed, _spread(len(motion), SPREAD))
    yield Progress(0.0, "Looking at the frames that differ")
    moved = motion.positions(steps) - rest
    shapes = yield from part_of(_few_shapes(moved, tolerance), 0.1, 0.5)
    if len(shapes) == 0:
        return Shapes(shapes, np.zeros((len(motion), 0)), float(np.linalg.norm(moved, axis=2).max()))
    vertices = _telling(shapes)
    solve = np.linalg.pinv(shapes[:, vertices].reshape(len(shapes), -1).T)
    weights = np.empty((len(motion), len(shapes)))
    for first in range(0, len(motion), BLOCK):
        yield Progress(0.5 + 0.4 * first / len(motion), "Finding the weights of all frames")
        some = np.arange(first, min(first + BLOCK, len(motion)))
        weights[some] = (motion.positions(some, vertices) - rest[vertices]).reshape(len(some), -1) @ solve.T
    weights[np.abs(np.nan_to_num(motion.frames)).max(axis=1) == 0.0] = 0.0
    peaks = np.abs(weights).max(axis=0)
    # Rounded as Blender will hold them.
    shapes = (shapes * peaks[:, None, None]).astype(np.float32).astype(np.float64)
    weights = (weights / peaks).astype(np.float32).astype(np.float64)
    yield Progress(0.9, "Looking at frames between")
    between = _spread(len(motion), CHECKED, between=True)
    off = _farthest(moved, weights[steps], shapes)
    off_between = _farthest(motion.positions(between) - rest, weights[between], shapes)
    return Shapes(shapes, weights, max(off, off_between))


def _few_shapes(moved: Floats, tolerance: float) -> Work[Floats]:
    """(K, V, 3) shapes whose sums come within `tolerance` of every vertex of displacements (n, V, 3), as few as do."""
    flat = moved.reshape(len(moved), -1)
    gram = np.zeros((len(flat), len(flat)))
    for first in range(0, flat.shape[1], COLUMNS):
        yield Progress(0.5 * first / flat.shape[1], "Comparing the frames that differ")
        part = flat[:, first : first + COLUMNS]
        gram += part @ part.T
    values, vectors = np.linalg.eigh(gram)
    kept = np.flatnonzero(values[::-1] > LEAST * max(float(values[-1]), 1e-300))
    loadings = vectors[:, ::-1][:, kept]
    shapes = (loadings.T @ flat).reshape(len(kept), *moved.shape[1:])
    few, many = 0, len(kept)
    while few < many:
        yield Progress(0.5 + 0.5 * (1.0 - (many - few) / len(kept)), "Compressing the motion to shape keys")
        middle = (few + many) // 2
        if _farthest(moved, loadings[:, :middle], shapes[:middle]) > tolerance:
            few = middle + 1
        else:
            many = middle
    return shapes[:few]


def _farthest(moved: Floats, weights: Floats, shapes: Floats) -> float:
    """The largest distance of any vertex of displacements (n, V, 3) from what weights (n, K) of shapes make."""
    shown = weights.astype(np.float32) @ shapes.reshape(len(shapes), moved[0].size).astype(np.float32)
    apart = moved - shown.reshape(moved.shape)
    return float(np.sqrt((apart**2).sum(axis=2).max(initial=0.0)))


def _spread(count: int, wanted: int, *, between: bool = False) -> Ints:
    """Frames spread evenly over a motion; `between` : half way from one to the next."""
    ends = np.linspace(0, count - 1, wanted + 1)
    return np.unique(((ends[1:] + ends[:-1]) / 2.0 if between else ends).round().astype(np.int64))


def _telling(shapes: Floats) -> Ints:
    """Vertices at which shapes (K, V, 3) are told apart best."""
    from scipy.linalg import qr

    flat = shapes.reshape(len(shapes), -1)
    _, order = qr(flat, mode="r", pivoting=True)
    first = np.unique(order[: TELLING * len(shapes)] // 3)
    return np.asarray(first, dtype=np.int64)
