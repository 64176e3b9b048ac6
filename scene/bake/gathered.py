"""The frames of a motion as they come, held as sums of few fields: never all of them are in memory.

A second of film is a matrix of millions of figures, and nearly all of it is the same few dozen displacement fields over
and over. Frames are taken in some at a time: what the fields so far cannot show of them gives new fields.
"""

from __future__ import annotations

import numpy as np

from ...arrays import AnyFloats, Floats, Singles
from ...progress import Progress, Work

#: Figures that are worked through in one step, and how many frames are taken in at once at least and at most.
BLOCK, FEWEST, MOST = 4_000_000, 4, 64
#: What is said meanwhile.
TEXT = "Compressing the motion to shape keys"
#: Of what is new in some frames, a field whose part is smaller than this share of the largest is what rounding left.
ROUNDING = 1e-6


class Gathered:
    """A motion as ``displacement[t] = loadings[t] @ fields``, every vertex of every frame within so many metres."""

    def __init__(self, vertex_count: int, *, within: float) -> None:
        """Begin without frames."""
        self.within = within
        self._fields: list[Singles] = [np.zeros((0, 3 * vertex_count), dtype=np.float32)]
        self._taken: list[Floats] = []
        self._waiting: list[Singles] = []
        self._batch = int(np.clip(BLOCK // max(3 * vertex_count, 1), FEWEST, MOST))

    def __len__(self) -> int:
        return len(self._taken) + len(self._waiting)

    def add(self, displacement: Floats) -> None:
        """Take in one frame (V, 3), metres."""
        self._waiting.append(displacement.reshape(-1).astype(np.float32))
        if len(self._waiting) == self._batch:
            self._take_in()

    def add_all(self, displacements: Floats) -> Work[None]:
        """Take in frames (n, V, 3)."""
        for number, displacement in enumerate(displacements):
            self.add(displacement)
            if not self._waiting:
                yield Progress(number / len(displacements), TEXT)

    @property
    def fields(self) -> Singles:
        """(r, 3 V) orthonormal, in single precision: what is written in the end is, too."""
        self._take_in()
        self._fields = [np.concatenate(self._fields)]
        return self._fields[0]

    @property
    def loadings(self) -> Floats:
        """(T, r) how much of each field shows in every frame; exactly zero in a frame without displacement."""
        self._take_in()
        padded = np.zeros((len(self._taken), sum(map(len, self._fields))))
        for row, taken in zip(padded, self._taken, strict=True):
            row[: len(taken)] = taken
        return padded

    def _take_in(self) -> None:
        """Show the waiting frames by the fields so far, and by new ones as far as it takes."""
        if not self._waiting:
            return
        frames = np.array(self._waiting)
        shown = [frames @ fields.T for fields in self._fields]
        for share, fields in zip(shown, self._fields, strict=True):
            frames -= share @ fields
        # In double precision: a field ten thousand times smaller than the largest is at right angles to it, too.
        left = frames.astype(np.float64)
        values, vectors = np.linalg.eigh(left @ left.T)
        sizes = np.sqrt(np.maximum(values[::-1], 0.0))
        kept = sizes > ROUNDING * max(float(sizes[0]), np.finfo(float).tiny)
        new = np.ascontiguousarray(vectors[:, ::-1][:, kept].T) @ left
        new /= np.linalg.norm(new, axis=1, keepdims=True)
        parts = left @ new.T
        few, many = 0, len(new)
        while few < many:
            count = (few + many) // 2
            if _longest(left - parts[:, :count] @ new[:count]) > self.within:
                few = count + 1
            else:
                many = count
        self._fields.append(new[:few].astype(np.float32))
        self._taken += list(np.concatenate([*shown, parts[:, :few]], axis=1).astype(np.float64))
        self._waiting = []


def squares(vectors: AnyFloats) -> AnyFloats:
    """(n, V) squared lengths of the vectors in (n, 3 V)."""
    apart = vectors.reshape(len(vectors), -1, 3)
    return np.asarray(np.einsum("nvk,nvk->nv", apart, apart))


def _longest(vectors: Floats) -> float:
    """Length of the longest of the vectors in (n, 3 V)."""
    return float(np.sqrt(squares(vectors).max(initial=0.0)))
