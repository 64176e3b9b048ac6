"""What a rig shows beyond the sum of what its controls do one by one: bones turn on arcs, drivers stop at their limits.

It is seen at some frames and taken to change evenly between them. What is left of a motion without it is what controls
that add up have to show; solving for that again and again is Gauss and Newton's method with the slopes at rest.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...arrays import Floats
from .normal import Wishes


@dataclass(frozen=True, eq=False)
class Beyond:
    """What a rig shows beyond the sum, of each of T frames.

    Attributes
    ----------
    skin : (T, K) inner products of its skin with that of each control. points : (T, m) its points.
    along : (T,) inner product of its skin with the motion's. size : (T,) squared length of its skin.
    """

    skin: Floats
    points: Floats
    along: Floats
    size: Floats

    def left_of(self, asked: Wishes) -> Wishes:
        """A motion without it."""
        size = np.maximum(asked.size - 2.0 * self.along + self.size, 0.0)
        return Wishes(asked.skin - self.skin, asked.points - self.points, size)


def between(frames: Sequence[int], count: int, some: Beyond) -> Beyond:
    """What is seen at some `frames`, as that of `count` frames."""

    def spread(rows: Floats) -> Floats:
        columns = rows.reshape(len(frames), -1)
        wide = np.array([np.interp(np.arange(count), frames, column) for column in columns.T]).T
        return np.asarray(wide.reshape(count, *rows.shape[1:]))

    return Beyond(spread(some.skin), spread(some.points), spread(some.along), spread(some.size))
