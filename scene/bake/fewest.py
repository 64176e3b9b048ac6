"""The fewest shapes that keep every vertex of a motion within a tolerance.

A singular value decomposition is best in the mean: it spends shapes on the whole cheek where only the corner of the
mouth is still off. Here vertices that are farther off count more and the decomposition is made again, until the worst
vertices are equally far off (Lawson's algorithm for approximation in the largest error, with a decomposition in place
of least squares). On the six emotions of the default head, 16 shapes do instead of 23.

Limitations. The worst vertex falls from round to round as a rule, not always, and the rounds may end above the best
that there is: then there is one shape more than there must be.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arrays import Floats, Ints, Singles
from ...progress import Progress, Work, run
from .gathered import NEAR, TEXT, Gathered, squares

#: Rounds for one number of shapes, how sharply the error of a vertex counts in the next, and the least that it counts.
ROUNDS, SHARPNESS, LEAST = 14, 0.7, 0.02
#: Vertices and frames that stand for all at first, how many of the worst join them where others turn out worse, and how
#: nearly as far off as these they are.
VERTICES, FRAMES, JOINING, NEARLY = 3000, 120, 500, 0.9
#: How often vertices may join for one number of shapes.
JOINED = 4
#: Vertices join early, too, once a number of shapes does that leaves the first share of the tolerance, if they are off
#: by the second: else a number would be looked for that does for the first vertices alone.
EARLY, JOINING_EARLY = 0.5, 0.25
#: After so many rounds, an error so many times the tolerance will not come down to it; nor will one that has not fallen
#: for so many rounds.
PATIENCE, HOPELESS, STILL = 3, 1.25, 4
#: Where a number of shapes does not do, the next is greater by 1 and by this share.
FURTHER = 0.03


@dataclass(frozen=True, eq=False)
class Few:
    """Shapes of a gathered motion: ``displacement = weights @ parts @ fields``, weights (T, k) and parts (k, r)."""

    weights: Floats
    parts: Floats

    def turned(self, rotation: Floats) -> Few:
        """The same motion, by shapes turned (k, k) among one another."""
        return Few(self.weights @ rotation.T, rotation @ self.parts)

    def scaled(self) -> Few:
        """The same motion, with weights whose largest is 1."""
        rows = np.argmax(np.abs(self.weights), axis=0)
        peaks = self.weights[rows, np.arange(len(rows))]
        return Few(self.weights / peaks, self.parts * peaks[:, None])


class Search:
    """Looks for few shapes of one motion, with some of its frames and vertices in place of all."""

    def __init__(self, motion: Gathered) -> None:
        """Choose frames that differ and vertices spread evenly."""
        self.fields, self.loadings = motion.fields, motion.loadings
        self._orthonormal, self._scale = np.linalg.qr(self.loadings)
        evenly = np.linspace(0, len(self.loadings) - 1, FRAMES).astype(np.int64)
        self._frames = np.union1d(motion.telling(FRAMES), evenly)
        count = self.fields.shape[1] // 3
        self._sampled(np.unique(np.linspace(0, count - 1, VERTICES).astype(np.int64)))

    def _sampled(self, vertices: Ints) -> None:
        """Let some vertices stand for all; each counts alike."""
        self._vertices, self._counts = vertices, np.ones(len(vertices))
        columns = (3 * vertices[:, None] + np.arange(3)).ravel()
        self._some = np.ascontiguousarray(self.fields[:, columns])

    def fewest(self, tolerance: float, *, most: int | None = None) -> Work[tuple[Few, Floats]]:
        """The fewest that stay within a tolerance, metres, and how far (V,) each vertex is off at most.

        `most` : no more than these, even where they do not stay within it.
        """
        low, high, joined = 0, len(self.fields), False
        while low < high:
            yield Progress(0.5, TEXT)
            middle = (low + high) // 2
            few, sampled = self._best(middle, tolerance, hopeless=HOPELESS * tolerance)
            if sampled > tolerance:
                low = middle + 1
                continue
            high = middle
            if not joined and sampled > EARLY * tolerance:
                self._join((yield from self.off(few)), JOINING_EARLY * tolerance)
                joined = True
        last = len(self.fields) if most is None else min(most, len(self.fields))
        count = min(low, last)
        while True:
            hopeless = HOPELESS * tolerance if count < last else np.inf
            few, off = yield from self.best(count, tolerance, hopeless=hopeless)
            if off.max(initial=0.0) <= tolerance or count == last:
                return few, off
            count = min(count + 1 + int(FURTHER * count), last)

    def best(self, count: int, tolerance: float, *, hopeless: float = np.inf) -> Work[tuple[Few, Floats]]:
        """So many that come nearest, or within a tolerance, and how far (V,) each vertex is off at most.

        `hopeless` : an error of the first rounds with which there is no looking further.
        """
        found: tuple[Few, Floats] | None = None
        for _ in range(JOINED):
            few, sampled = self._best(count, tolerance, hopeless=hopeless)
            off = yield from self.off(few)
            if found is None or off.max(initial=0.0) < found[1].max():
                found = few, off
            ended = off.max(initial=0.0) <= tolerance or (sampled > tolerance and hopeless < np.inf)
            if ended or not self._join(off, NEARLY * max(tolerance, sampled)):
                break
        assert found is not None
        return found

    def _join(self, off: Floats, least: float) -> bool:
        """Let the worst by how far (V,) each vertex is off, from so much on, stand for all, too; whether any is new."""
        worst = np.argsort(off)[::-1][:JOINING]
        joined = np.union1d(self._vertices, worst[off[worst] > least])
        new = len(joined) > len(self._vertices)
        if new:
            self._sampled(joined)
        return new

    def off(self, few: Few) -> Work[Floats]:
        """(V,) how far each vertex is off in any frame, metres."""
        left = (self.loadings - few.weights @ few.parts).astype(np.float32)
        return (yield from farthest(left, self.fields))

    def _best(self, count: int, tolerance: float, *, hopeless: float) -> tuple[Few, float]:
        """So many shapes, and how far the sampled vertices are off at most in the sampled frames."""
        found, least, fell, counts = None, np.inf, 0, self._counts
        for number in range(ROUNDS):
            few = self._weighted(count, counts)
            left = self.loadings[self._frames] - few.weights[self._frames] @ few.parts
            off = run(farthest(left.astype(np.float32), self._some))
            largest = float(off.max(initial=0.0))
            if found is None or largest < least:
                found, least, fell = few, largest, number
            if least <= tolerance or largest == 0.0 or number - fell >= STILL:
                break
            if number >= PATIENCE and least > hopeless:
                break
            counts = counts * np.maximum(off / largest, LEAST) ** SHARPNESS
            counts /= counts.max()
            self._counts = counts
        assert found is not None
        return found, least

    def _weighted(self, count: int, counts: Floats) -> Few:
        """So many shapes that are best in the mean, each sampled vertex counting so much."""
        alike = (self._some * np.repeat(counts**2, 3).astype(np.float32)) @ self._some.T
        _, vectors = np.linalg.eigh(self._scale @ alike @ self._scale.T)
        chosen = np.ascontiguousarray(vectors[:, ::-1][:, :count])
        return Few(self._orthonormal @ chosen, chosen.T @ self._scale)


def farthest(left: Singles, fields: Singles) -> Work[Floats]:
    """(V,) the longest that any row of loadings (T, r) makes each vertex of some fields (r, 3 V)."""
    longest = np.empty(fields.shape[1] // 3)
    size = max(NEAR // (3 * max(len(left), 1)), 1)
    for first in range(0, len(longest), size):
        yield Progress(0.5, TEXT)
        apart = left @ fields[:, 3 * first : 3 * (first + size)]
        longest[first : first + size] = np.sqrt(squares(apart).max(axis=0, initial=0.0))
    return longest
