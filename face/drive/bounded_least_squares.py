"""Small bounded least-squares problems: min |A x - b|^2 with x between bounds."""

from __future__ import annotations

import numpy as np

from ...arrays import Floats
from ...errors import SolverError

#: Block exchanges that may fail to lessen what is wrong before entries are exchanged one by one.
PATIENCE = 3
ROUNDS = 2000

#: What counts as 0: share of an entry's own scale.
TOLERANCE = 1e-10


def bounded_least_squares(
    matrix: Floats, right: Floats, lower: Floats, upper: Floats, near: Floats | None = None
) -> Floats:
    """The x (k,) between `lower` and `upper` (k,) with the least |matrix @ x - right|^2.

    Block principal pivoting (Judice and Pires 1994): entries are free or held at a bound; all that are wrong (free
    beyond a bound, or held although they would gain by leaving it) change places at once, or only the last of them
    where that does not help, which always ends.

    Parameters
    ----------
    matrix : (m, k) with independent columns. right : (m,).
    near : (k,) the solution of a like problem, at whose bounds this one is first taken to be.

    Raises
    ------
    SolverError : dependent columns, or an active set that does not settle.
    """
    normal, wanted = matrix.T @ matrix, matrix.T @ right
    slope = TOLERANCE * np.sqrt(np.diagonal(normal)) * max(float(np.linalg.norm(right)), 1e-300)
    width = TOLERANCE * (upper - lower)
    held = np.full(len(lower), -1) if near is None else np.where(near <= lower, -1, np.where(near >= upper, 1, 0))
    solution: Floats = lower.astype(np.float64)
    least, patience = len(lower) + 1, PATIENCE
    for _ in range(ROUNDS):
        free = held == 0
        solution = np.where(held > 0, upper, lower)
        solution[free] = 0.0
        try:
            solution[free] = np.linalg.solve(normal[np.ix_(free, free)], (wanted - normal @ solution)[free])
        except np.linalg.LinAlgError as error:
            raise SolverError("the bounded least-squares problem has no single solution") from error
        gradient = normal @ solution - wanted
        low, high = free & (solution < lower - width), free & (solution > upper + width)
        loose = ((held < 0) & (gradient < -slope)) | ((held > 0) & (gradient > slope))
        wrong = np.flatnonzero(low | high | loose)
        if len(wrong) == 0:
            return np.clip(solution, lower, upper)
        if len(wrong) < least:
            least, patience = len(wrong), PATIENCE
        elif patience > 0:
            patience -= 1
        else:
            wrong = wrong[-1:]
        held[wrong] = np.where(low, -1, np.where(high, 1, 0))[wrong]
    raise SolverError("the bounded least-squares problem did not converge", step=ROUNDS)
