"""What stiffening springs add to the low-strain response, recalled from the balances that were found before.

A hand that drags a slider asks for one balance after the other, each near some that are known. What springs add is
small and smooth over the muscles' amounts, so that it is foretold from those: by regression with a Gaussian process,
which also says how doubtful it is (Rasmussen and Williams 2006, Gaussian Processes for Machine Learning, chapter 2).
Each new balance is held against what was foretold of it, and from that the process learns how far to be trusted.
"""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from ...arrays import Floats

#: Half the memory to run through for each sketch; far finer than what is foretold is trusted.
Single: TypeAlias = NDArray[np.float32]

#: Amounts that differ by this count as near each other, metres: a fifth of what a strong expression asks.
NEAR = 0.02

#: Rounding of the kernel, which keeps it positive definite.
ROUNDING = 1e-9

#: So many balances are kept; the oldest goes.
KEPT = 48

#: What one surprise has taught is forgotten by this share with each balance found thereafter.
CALMING = 0.8

#: Nothing is known yet.
NOTHING: Single = np.empty((0, 0, 3), dtype=np.float32)

#: Before anything is known, springs are taken to add as much as this, metres.
UNKNOWN = 2e-3


class Recollection:
    """The balances found so far of one face's skin."""

    def __init__(self) -> None:
        self._amounts: Floats = np.empty((0, 0))
        self._added, self._on_sheet = NOTHING, NOTHING
        self._factor: Floats = np.empty((0, 0))
        self._surprise = UNKNOWN

    def foretold(self, amounts: Floats) -> tuple[Floats | float, float]:
        """What springs add (n, 3) to the displacement by muscles (k,), and how far off that may be, both in metres."""
        weights, doubt = self._weights(amounts)
        return _mixed(weights, self._added), doubt

    def doubt(self, amounts: Floats) -> float:
        """How far off what is foretold for muscles (k,) may be, metres."""
        return self._weights(amounts)[1]

    def on_sheet(self, amounts: Floats) -> Floats | float:
        """As `foretold`, what springs add on the elastic sheet (n, 3), before sliding and bulging: where to begin."""
        return _mixed(self._weights(amounts)[0], self._on_sheet)

    def learn(self, amounts: Floats, added: Floats, on_sheet: Floats) -> None:
        """A balance was found: what springs add (n, 3) for amounts (k,), as it shows and on the sheet, metres."""
        weights, doubt = self._weights(amounts)
        off = float(np.linalg.norm(added - _mixed(weights, self._added), axis=1).max())
        spread = max(doubt / self._surprise, np.sqrt(ROUNDING))
        self._surprise = max(off / spread, CALMING * self._surprise)
        self._added, self._on_sheet = _with(self._added, added), _with(self._on_sheet, on_sheet)
        told = np.vstack([self._amounts[1:].reshape(-1, len(amounts)), amounts])[-KEPT:]
        # Where no muscle pulls, springs add nothing: that is known from the beginning, and has no share.
        self._amounts = np.vstack([np.zeros(len(amounts)), told])
        near = _nearness(self._amounts, self._amounts)
        self._factor = np.asarray(np.linalg.inv(near + ROUNDING * np.eye(len(near))))

    def _weights(self, amounts: Floats) -> tuple[Floats, float]:
        """(m,) shares of the known balances, and the doubt that they leave, metres."""
        if not len(self._added):
            return np.empty(0), self._surprise
        near = _nearness(amounts[None], self._amounts)[0]
        weights = self._factor @ near
        left = max(1.0 + ROUNDING - float(near @ weights), 0.0)
        return weights[1:], self._surprise * float(np.sqrt(left))


def _mixed(weights: Floats, fields: Single) -> Floats | float:
    """(n, 3) fields (m, n, 3) by their shares (m,)."""
    if not len(fields):
        return 0.0
    return np.tensordot(weights.astype(np.float32), fields, axes=1).astype(np.float64)


def _with(fields: Single, another: Floats) -> Single:
    """Fields (m, n, 3) and another one (n, 3), without the oldest where they are many."""
    newest = another[None].astype(np.float32)
    return np.concatenate([fields[1 - KEPT :], newest]) if len(fields) else newest


def _nearness(one: Floats, other: Floats) -> Floats:
    """(a, b) how far amounts (a, k) and (b, k) tell of each other, 0..1: Matern's kernel of order 5/2."""
    away = np.sqrt(5.0) / NEAR * np.linalg.norm(one[:, None] - other[None], axis=2)
    return np.asarray((1.0 + away + away**2 / 3.0) * np.exp(-away))
