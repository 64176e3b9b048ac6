"""Small bounded least-squares problems: min |A x - b|^2 with x between bounds."""

from __future__ import annotations

import numpy as np
from scipy.optimize import nnls

from ..arrays import Floats
from ..errors import SolverError

#: Rounds in which amounts beyond their upper bound are pinned to it.
PIN_ROUNDS = 6


def bounded_least_squares(matrix: Floats, right: Floats, lower: Floats, upper: Floats) -> Floats:
    """The x (k,) between `lower` and `upper` (k,) with the least |matrix @ x - right|^2.

    Active set on the normal equations (scipy's nnls); the few amounts that exceed their upper bound are pinned to it
    one round after another.

    Raises
    ------
    SolverError : when the active set does not settle.
    """
    pinned = np.zeros(len(lower), dtype=bool)
    solution = lower.copy()
    for _ in range(PIN_ROUNDS):
        free = ~pinned
        fixed = np.where(pinned, upper, lower)
        try:
            above, _ = nnls(matrix[:, free], right - matrix @ fixed)
        except RuntimeError as error:
            raise SolverError(f"the bounded least-squares problem did not settle: {error}") from error
        solution = fixed.copy()
        solution[free] += above
        over = free & (solution > upper)
        if not over.any():
            return solution
        pinned |= over
    return np.minimum(solution, upper)
