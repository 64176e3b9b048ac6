"""Two margins that may meet."""

from __future__ import annotations

import numpy as np
from risorius.face.bodies.margins import crossing


def test_many_moments_are_read_as_each_alone() -> None:
    """Margins whose vertices overtake one another, at moments far apart, and places beyond the partner's ends."""
    some = np.random.default_rng(4)
    line = np.column_stack([np.linspace(-0.02, 0.02, 12), np.zeros((12, 2))])
    positions = np.concatenate([line, 1.3 * line]) + 2e-3 * some.standard_normal((5, 24, 3))
    positions[:, :, 0] += np.array([0.0, 0.01, -0.03, 0.2, -0.2])[:, None]
    arcs = np.arange(12), np.arange(12, 24)
    for arc, partner in (arcs, arcs[::-1]):
        together = crossing(positions, arc, partner)
        alone = np.array([crossing(each, arc, partner) for each in positions])
        np.testing.assert_allclose(together, alone, atol=1e-12)
        by_numpy = []
        for each in positions:
            rising = partner[np.argsort(each[partner, 0])]
            by_numpy.append(each[arc, 1] - np.interp(each[arc, 0], each[rising, 0], each[rising, 1]))
        np.testing.assert_allclose(together, by_numpy, atol=1e-12)
