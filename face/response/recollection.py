"""What stiffening springs add to the low-strain response, recalled from the balances that were found before.

A hand that drags a slider asks for one balance after the other, each near some that are known. What springs add is
small and smooth over the muscles' amounts, so that it is foretold from those: by regression with a Gaussian process,
which also says how doubtful it is (Rasmussen and Williams 2006, Gaussian Processes for Machine Learning, chapter 2).
Each new balance is held against what was foretold of it, and from that the process learns how far to be trusted.
"""

from __future__ import annotations

import numpy as np

from ...arrays import Floats

#: Amounts that differ by this count as near each other, metres: a fifth of what a strong expression asks.
NEAR = 0.02

#: Rounding of the kernel, which keeps it positive definite.
ROUNDING = 1e-9

#: So many balances are kept; the oldest goes.
KEPT = 48

#: What one surprise has taught is forgotten by this share with each balance found thereafter.
CALMING = 0.8

#: Before anything is known, springs are taken to add as much as this, metres.
UNKNOWN = 2e-3


class Recollection:
    """The balances found so far of one face's skin."""

    def __init__(self) -> None:
        self.latest: Floats | float = 0.0
        """(n, 3) what the springs of the elastic sheet added in the balance found last, metres: where to begin."""
        self._amounts: Floats = np.empty((0, 0))
        self._added: list[Floats] = []
        self._factor: Floats = np.empty((0, 0))
        self._surprise = UNKNOWN

    def foretold(self, amounts: Floats) -> tuple[Floats | float, float]:
        """What springs add (n, 3) to the displacement by muscles (k,), and how far off that may be, both in metres."""
        weights, doubt = self._weights(amounts)
        return self._mixed(weights), doubt

    def learn(self, amounts: Floats, added: Floats) -> None:
        """A balance was found: what springs add (n, 3) for amounts (k,), metres."""
        weights, doubt = self._weights(amounts)
        off = float(np.linalg.norm(added - self._mixed(weights), axis=1).max())
        spread = max(doubt / self._surprise, np.sqrt(ROUNDING))
        self._surprise = max(off / spread, CALMING * self._surprise)
        self._added = [*self._added, added][-KEPT:]
        told = np.vstack([self._amounts[1:].reshape(-1, len(amounts)), amounts])[-KEPT:]
        # Where no muscle pulls, springs add nothing: that is known from the beginning, and has no share.
        self._amounts = np.vstack([np.zeros(len(amounts)), told])
        near = _nearness(self._amounts, self._amounts)
        self._factor = np.asarray(np.linalg.inv(near + ROUNDING * np.eye(len(near))))

    def _weights(self, amounts: Floats) -> tuple[Floats, float]:
        """(m,) shares of the known balances, and the doubt that they leave, metres."""
        if not self._added:
            return np.empty(0), self._surprise
        near = _nearness(amounts[None], self._amounts)[0]
        weights = self._factor @ near
        left = max(1.0 + ROUNDING - float(near @ weights), 0.0)
        return weights[1:], self._surprise * float(np.sqrt(left))

    def _mixed(self, weights: Floats) -> Floats | float:
        """(n, 3) the known balances by their shares."""
        mixed: Floats | float = 0.0
        for weight, added in zip(weights, self._added, strict=True):
            mixed = mixed + weight * added
        return mixed


def _nearness(one: Floats, other: Floats) -> Floats:
    """(a, b) how far amounts (a, k) and (b, k) tell of each other, 0..1: Matern's kernel of order 5/2."""
    away = np.sqrt(5.0) / NEAR * np.linalg.norm(one[:, None] - other[None], axis=2)
    return np.asarray((1.0 + away + away**2 / 3.0) * np.exp(-away))
