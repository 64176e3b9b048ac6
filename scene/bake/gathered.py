"""The frames of a motion as they come, held as sums of few fields: never all of them are in memory.

A second of film is a matrix of millions of figures, and nearly all of it is the same few dozen displacement fields over
and over. Frames are taken in some at a time: what the fields so far cannot show of them gives new fields.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ...arrays import AnyFloats, Floats, Ints, Singles
from ...progress import Progress, Work

#: Figures that are taken in at once, and how many frames these are at least and at most; figures that the processor
#: holds near.
BLOCK, FEWEST, MOST, NEAR = 4_000_000, 4, 64, 250_000
#: What is said meanwhile.
TEXT = "Compressing the motion to shape keys"
#: Of what is new in some frames, fields whose squares are smaller than this share of the largest's may be rounding.
#: They are found once the others are taken away, which is done at most so often.
ROUNDING, STAGES = 1e-6, 8


class Gathered:
    """A motion as ``displacement[t] = loadings[t] @ fields``, every vertex of every frame within so many metres.

    Attributes
    ----------
    within : that bound. off : how far the vertex that is farthest off is.
    """

    def __init__(self, vertex_count: int, *, within: float) -> None:
        """Begin without frames."""
        self.within, self.off = within, 0.0
        self._fields: list[Singles] = [np.zeros((0, 3 * vertex_count), dtype=np.float32)]
        self._taken: list[Floats] = []
        batch = int(np.clip(BLOCK // max(3 * vertex_count, 1), FEWEST, MOST))
        # Frames that wait are written into one array again and again: fresh memory costs more than the work itself.
        self._room, self._waiting = np.empty((batch, 3 * vertex_count), dtype=np.float32), 0

    def __len__(self) -> int:
        return len(self._taken) + self._waiting

    def add(self, displacement: Floats) -> None:
        """Take in one frame (V, 3), metres."""
        self._room[self._waiting] = displacement.reshape(-1)
        self._waiting += 1
        if self._waiting == len(self._room):
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

    def telling(self, count: int) -> Ints:
        """At most so many frames, those first that the others before them tell least about."""
        from scipy.linalg import qr

        _, order = qr(self.loadings.T, mode="r", pivoting=True)
        return np.asarray(order[:count], dtype=np.int64)

    def frames(self, steps: Ints) -> Singles:
        """(n, 3 V) some frames, metres."""
        return np.asarray(self.loadings[steps].astype(np.float32) @ self.fields)

    def _take_in(self) -> None:
        """Show the waiting frames by the fields so far, and by new ones as far as it takes."""
        if not self._waiting:
            return
        frames, shown = self._room[: self._waiting], list[Singles]()
        for fields in self._fields:
            shown.append(frames @ fields.T)
            _take_away(frames, shown[-1], fields)
        new, left = list[Singles](), _farthest(frames)
        for _ in range(STAGES):
            if left <= self.within:
                break
            fields, share = _principal(frames, self.within)
            new.append(fields)
            shown.append(share)
            _take_away(frames, share, fields)
            left = _farthest(frames)
        self._fields += [np.concatenate(new)] if new else []
        self.off = max(self.off, left)
        self._taken += list(np.concatenate(shown, axis=1).astype(np.float64))
        self._waiting = 0


def _principal(frames: Singles, within: float) -> tuple[Singles, Singles]:
    """Orthonormal fields (k, 3 V) that show frames (n, 3 V) within so many metres, or as far as rounding lets them.

    And how much of each there is in every frame (n, k).
    """
    values, vectors = np.linalg.eigh((frames @ frames.T).astype(np.float64))
    many = int((values > max(ROUNDING * values[-1], np.finfo(float).tiny)).sum())
    # All that so many fields leave, spread evenly, is the least that they may leave where they leave most.
    spread = np.cumsum(np.maximum(values, 0.0))[::-1] / (frames.size / 3)
    few = min(int((spread > within**2).sum()), many)
    fields = np.ascontiguousarray(vectors[:, ::-1][:, :many].T).astype(np.float32) @ frames
    fields /= np.linalg.norm(fields, axis=1, keepdims=True)
    share = frames @ fields.T
    while few < many:
        count = (few + many) // 2
        if _shows(within, frames, share[:, :count], fields[:count]):
            many = count
        else:
            few = count + 1
    return fields[:few], share[:, :few]


def _shows(within: float, frames: Singles, share: Singles, fields: Singles) -> bool:
    """Whether shares (n, k) of fields (k, 3 V) show frames (n, 3 V) within so many metres."""
    for some in _blocks(frames):
        if squares(frames[:, some] - share @ fields[:, some]).max(initial=0.0) > within**2:
            return False
    return True


def _farthest(frames: Singles) -> float:
    """The longest vector in frames (n, 3 V)."""
    return float(np.sqrt(max((squares(frames[:, some]).max(initial=0.0) for some in _blocks(frames)), default=0.0)))


def _take_away(frames: Singles, share: Singles, fields: Singles) -> None:
    """Leave of frames (n, 3 V), in place, what shares (n, k) of fields (k, 3 V) do not show."""
    for some in _blocks(frames):
        frames[:, some] -= share @ fields[:, some]


def _blocks(frames: Singles) -> Iterator[slice[int, int, None]]:
    """Columns of all vertices of frames (n, 3 V), some at a time."""
    size = 3 * max(NEAR // (3 * len(frames)), 1)
    return (slice(first, first + size) for first in range(0, frames.shape[1], size))


def squares(vectors: AnyFloats) -> AnyFloats:
    """(n, V) squared lengths of the vectors in (n, 3 V)."""
    apart = (vectors * vectors).reshape(len(vectors), -1, 3)
    return np.asarray(apart[:, :, 0] + apart[:, :, 1] + apart[:, :, 2])
