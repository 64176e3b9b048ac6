"""Array aliases, in one place. Shapes and units stand in each docstring."""

from __future__ import annotations

from typing import TypeAlias, TypeVar

import numpy as np
from numpy.typing import NDArray

Floats: TypeAlias = NDArray[np.float64]
Ints: TypeAlias = NDArray[np.int64]
Bools: TypeAlias = NDArray[np.bool_]
#: Single precision, for what is large and needs no more.
Singles: TypeAlias = NDArray[np.float32]
#: Either precision, the same in and out.
AnyFloats = TypeVar("AnyFloats", Floats, Singles)

#: Coordinates beyond this, in whatever unit, are damage: their cubes would leave no digit of a face.
LARGEST = 1e12
