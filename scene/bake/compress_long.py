"""A long motion as few shapes times weights.

The shapes are made from some hundred of its frames; the weights of each frame are those that come nearest to it at
vertices that tell the shapes apart.

The whole motion is never in memory: five minutes are gigabytes.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from ...arrays import AnyFloats, Floats, Ints
from ...progress import Progress, Work, part_of
from .compress import TOLERANCE, Shapes, gathering, squeeze
from .gathered import squares

if TYPE_CHECKING:
    from ...face.long_motion import LongMotion

#: Frames, spread evenly, from which shapes are made beside those that were posed; and that see how far others are off.
SPREAD, CHECKED = 400, 100
#: Vertices that tell weights, for each shape.
TELLING = 3
#: Frames whose weights are found at once.
BLOCK = 500
#: Frames of which all vertices are looked at at once.
AT_ONCE = 16


def compress_long(
    motion: LongMotion, rest: Floats, *, tolerance: float = TOLERANCE, max_keys: int | None = None
) -> Work[Shapes]:
    """A long motion with as few shapes as keep every vertex within `tolerance` at the frames they are made from.

    Parameters
    ----------
    rest : (V, 3) of the face. tolerance : metres. max_keys : as for `compress`.

    Returns
    -------
    Shapes with weights for every frame; their `error` is the largest at frames between those, too.
    """
    steps = np.union1d(motion.posed, _spread(len(motion), SPREAD))
    gathered = gathering(len(rest), tolerance=tolerance, max_keys=max_keys)
    for first in range(0, len(steps), AT_ONCE):
        yield Progress(0.3 * first / len(steps), "Looking at the frames that differ")
        for positions in motion.positions(steps[first : first + AT_ONCE]):
            gathered.add(positions - rest)
    packed = yield from part_of(squeeze(gathered, tolerance=tolerance, max_keys=max_keys), 0.3, 0.5)
    shapes = packed.shapes
    weights = yield from part_of(_weights(motion, rest, shapes), 0.5, 0.9)
    peaks = np.abs(weights).max(axis=0)
    # Rounded as Blender will hold them.
    shapes = (shapes * peaks[:, None, None]).astype(np.float32).astype(np.float64)
    weights = (weights / peaks).astype(np.float32).astype(np.float64)
    off = yield from part_of(_farthest(gathered.frames, np.arange(len(steps)), weights[steps], shapes), 0.9, 0.95)

    def between(some: Ints) -> Floats:
        return (motion.positions(some) - rest).reshape(len(some), -1)

    others = np.setdiff1d(_spread(len(motion), CHECKED, between=True), steps)
    also = yield from part_of(_farthest(between, others, weights[others], shapes), 0.95, 1.0)
    return Shapes(shapes, weights, max(off + gathered.off, also), packed.is_limited)


def _weights(motion: LongMotion, rest: Floats, shapes: Floats) -> Work[Floats]:
    """(T, K) how much of each shape (K, V, 3) comes nearest to every frame, at the vertices that tell."""
    weights = np.zeros((len(motion), len(shapes)))
    if not len(shapes):
        return weights
    vertices = _telling(shapes)
    solve = np.linalg.pinv(shapes[:, vertices].reshape(len(shapes), -1).T)
    for first in range(0, len(motion), BLOCK):
        yield Progress(first / len(motion), "Finding the weights of all frames")
        some = np.arange(first, min(first + BLOCK, len(motion)))
        weights[some] = (motion.positions(some, vertices) - rest[vertices]).reshape(len(some), -1) @ solve.T
    weights[np.abs(np.nan_to_num(motion.frames)).max(axis=1) == 0.0] = 0.0
    return weights


def _farthest(frames: Callable[[Ints], AnyFloats], steps: Ints, weights: Floats, shapes: Floats) -> Work[float]:
    """The largest distance of any vertex at some steps from what weights, one row for each, make of shapes, metres.

    `frames` : steps (n,) -> (n, 3 V) displacements.
    """
    farthest, flat, weights32 = (
        0.0,
        shapes.reshape(len(shapes), 3 * shapes.shape[1]).astype(np.float32),
        weights.astype(np.float32),
    )
    for first in range(0, len(steps), AT_ONCE):
        yield Progress(first / len(steps), "Looking at frames between")
        some = slice(first, first + AT_ONCE)
        farthest = max(farthest, float(squares(frames(steps[some]) - weights32[some] @ flat).max(initial=0.0)))
    return float(np.sqrt(farthest))


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
