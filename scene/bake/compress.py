"""A motion as few shapes times weights, with a bound on every vertex of every frame."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ...arrays import Floats
from ...errors import ParameterError
from ...progress import Work, part_of, run
from .fewest import Search
from .gathered import Gathered, squares
from .local import turning, with_zeros

#: Every vertex of a life-size face stays within this of the simulated motion, metres; of others in proportion.
TOLERANCE = 1e-4

#: Shares of the tolerance: what is not even gathered of a motion, and what the fewest shapes may be off.
#: The rest is left for zeros where shapes are small.
GATHERED, SHAPED = 0.05, 0.92


@dataclass(frozen=True, eq=False)
class Shapes:
    """A motion as ``displacement[t] = sum_k weights[t, k] * shapes[k]``.

    Attributes
    ----------
    shapes : (K, V, 3) displacements, metres; exactly zero where a shape moves nothing worth while.
    weights : (T, K) in [-1, 1]; the largest of each shape is 1.
    error : the motion that it stands for is nowhere farther off than this, in any frame, metres.
    is_limited : there are as many shapes as were allowed, and not as many as the tolerance would have.
    """

    shapes: Floats
    weights: Floats
    error: float
    is_limited: bool = False

    def displacement(self) -> Floats:
        """(T, V, 3) the motion that the shapes and weights make, metres."""
        return np.asarray(np.tensordot(self.weights, self.shapes, axes=1), dtype=np.float64)


def compress(displacements: Floats, *, tolerance: float = TOLERANCE, max_keys: int | None = None) -> Shapes:
    """Write a motion with as few shapes as keep every vertex of every frame within `tolerance`.

    A frame without displacement gets weights of exactly zero, so a rest stays a rest.

    Parameters
    ----------
    displacements : (T, V, 3) from the resting face, metres.
    tolerance : the bound, metres.
    max_keys : no more shapes than these, the best ones, even where the motion is then farther off.

    Raises
    ------
    ParameterError : a tolerance that is not above zero, no shapes allowed, or displacements of another shape or not
        finite.
    """
    if displacements.ndim != 3 or displacements.shape[2] != 3 or not np.isfinite(displacements).all():
        raise ParameterError("displacements", "must be finite (frames, vertices, 3)", displacements.shape)
    motion = gathering(displacements.shape[1], tolerance=tolerance, max_keys=max_keys)
    run(motion.add_all(displacements))
    packed = run(squeeze(motion, tolerance=tolerance, max_keys=max_keys))
    apart = (packed.displacement() - displacements).reshape(len(displacements), -1)
    return replace(packed, error=float(np.sqrt(squares(apart).max(initial=0.0))))


def gathering(vertex_count: int, *, tolerance: float = TOLERANCE, max_keys: int | None = None) -> Gathered:
    """Where the frames of a motion go that is squeezed to this tolerance, metres, in the end.

    Raises
    ------
    ParameterError : a tolerance that is not above zero, or no shapes allowed.
    """
    if not tolerance > 0.0:
        raise ParameterError("tolerance", "must be above zero", tolerance)
    if max_keys is not None and max_keys < 1:
        raise ParameterError("max_keys", "must be 1 or more", max_keys)
    return Gathered(vertex_count, within=GATHERED * tolerance)


def squeeze(motion: Gathered, *, tolerance: float, max_keys: int | None = None) -> Work[Shapes]:
    """As few shapes as keep all frames that were gathered within a tolerance, metres, bit by bit."""
    frame_count, vertex_count = len(motion), motion.fields.shape[1] // 3
    if not motion.loadings.size:
        return Shapes(np.zeros((0, vertex_count, 3)), np.zeros((frame_count, 0)), motion.within)
    few, off = yield from part_of(Search(motion).fewest(SHAPED * tolerance, most=max_keys), 0.0, 0.8)
    few = few.turned(turning(few.parts, motion.fields)).scaled()
    # Rounded as Blender will hold them.
    weights = few.weights.astype(np.float32).astype(np.float64)
    room = np.maximum((1.0 - GATHERED) * tolerance, off.max(initial=0.0)) - off
    shapes, moved = yield from part_of(with_zeros(few.parts, motion.fields, room), 0.8, 1.0)
    error = float((off + moved).max(initial=0.0)) + motion.within
    return Shapes(shapes.astype(np.float64), weights, error, error > tolerance)
