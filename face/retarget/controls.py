"""What the controls of a rig do to a face, and within which limits."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...arrays import Bools, Floats
from ...errors import ParameterError

#: A control that moves no vertex of a life-size face by more than this in its whole range does nothing, metres.
STILL = 1e-5


@dataclass(frozen=True, eq=False)
class Controls:
    """The controls of a rig: shape keys, sliders, channels of bones.

    Attributes
    ----------
    names : of the K controls, each once.
    effects : (K, V, 3) displacement of the face's vertices by a control's value 1, in the face's coordinates.
    low, high : (K,) the least and the greatest value; 0 is the rest, so low <= 0 <= high.

    Raises
    ------
    ParameterError : arrays of other shapes or not finite, a name twice, limits the wrong way round.
    """

    names: Sequence[str]
    effects: Floats
    low: Floats
    high: Floats

    def __post_init__(self) -> None:
        count = len(self.names)
        if self.effects.ndim != 3 or self.effects.shape[::2] != (count, 3) or not np.isfinite(self.effects).all():
            raise ParameterError("effects", f"must be finite ({count}, vertices, 3)", self.effects.shape)
        if len(set(self.names)) != count:
            twice = next(name for name in self.names if list(self.names).count(name) > 1)
            raise ParameterError("names", "must name each control once", twice)
        if self.low.shape != (count,) or self.high.shape != (count,):
            raise ParameterError("low and high", f"must be ({count},)", (self.low.shape, self.high.shape))
        wrong = ~((self.low <= 0.0) & (self.high >= 0.0))
        if wrong.any():
            first = int(np.flatnonzero(wrong)[0])
            limits = (float(self.low[first]), float(self.high[first]))
            raise ParameterError(f"limits of {self.names[first]}", "must lie on both sides of 0, its rest", limits)

    def __len__(self) -> int:
        return len(self.names)

    def still(self, scale: float = 1.0) -> Bools:
        """(K,) whether a control does nothing to a face of a scale."""
        reach = np.maximum(np.abs(self.low), np.abs(self.high))
        most = self.effects.max(axis=(1, 2), initial=0.0), -self.effects.min(axis=(1, 2), initial=0.0)
        return np.asarray(reach * np.maximum(*most) <= STILL * scale)

    def select(self, chosen: Bools) -> Controls:
        """Some of them, in the same order."""
        if chosen.all():
            return self
        names = tuple(name for name, taken in zip(self.names, chosen, strict=True) if taken)
        return Controls(names, self.effects[chosen], self.low[chosen], self.high[chosen])

    def displacement(self, values: Floats) -> Floats:
        """(V, 3), or (T, V, 3), displacement by values (K,), or (T, K)."""
        return np.asarray(np.tensordot(values, self.effects, axes=1), dtype=np.float64)
