"""The sphere nearest to some points: eyeballs are found and measured by it."""

from __future__ import annotations

import numpy as np

from ...arrays import Floats


def fit_sphere(points: Floats) -> tuple[Floats, float]:
    """Centre (3,) and radius of the sphere nearest to points (k, 3), refitted without the farthest fifth."""
    chosen = points
    for _ in range(3):
        matrix = np.column_stack([2.0 * chosen, np.ones(len(chosen))])
        solution, *_ = np.linalg.lstsq(matrix, (chosen**2).sum(axis=1), rcond=None)
        centre = solution[:3]
        radius = float(np.sqrt(max(solution[3] + centre @ centre, 1e-12)))
        off = np.abs(np.linalg.norm(points - centre, axis=1) - radius)
        chosen = points[off <= np.quantile(off, 0.8)]
    return centre, radius
