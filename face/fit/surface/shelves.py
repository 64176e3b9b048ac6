"""Triangles of a dense surface put on shelves by place: a part of them is drawn from without a look at all of them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ....arrays import Bools, Floats, Ints

#: Surfaces of more triangles than this are put on shelves.
MANY = 100_000
#: Cells of the grid along each side of the surface's box, and levels in each cell that the width of a triangle is
#: told by: wide ones reach over more than half a cell. All cells are counted in 16 bits, which sort fastest.
CELLS, LEVELS = 40, 8


@dataclass(frozen=True, eq=False)
class Shelves:
    """Triangles of a surface, shelf after shelf.

    Attributes
    ----------
    triangles : (T,) numbers of the triangles, those of the first shelf first.
    starts : (S + 1,) where each shelf begins among them; the last ends with the triangles.
    filled : (T + 1,) area of all triangles before each.
    """

    triangles: Ints
    starts: Ints
    filled: Floats

    @classmethod
    def of(cls, shelf: Ints, count: int, areas: Floats) -> Shelves:
        """Triangles on their shelves (T,), of which there are so many; areas (T,) of the triangles."""
        kind = np.uint16 if count <= np.iinfo(np.uint16).max else np.int64
        order = np.argsort(shelf.astype(kind), kind="stable")
        starts = np.concatenate([[0], np.cumsum(np.bincount(shelf, minlength=count))])
        return cls(order, starts, np.concatenate([[0.0], np.cumsum(areas[order])]))

    @property
    def areas(self) -> Floats:
        """(S,) area on each shelf."""
        return np.asarray(np.diff(self.filled[self.starts]), dtype=np.float64)

    def drawn(self, chosen: Bools, count: int, random: np.random.Generator) -> Ints:
        """(count,) triangles on some of the shelves (S,), as many per area everywhere; none where they have no area."""
        ends = np.cumsum(self.areas[chosen])
        if not len(ends) or not ends[-1] > 0.0:
            return np.zeros(0, dtype=np.int64)
        places = (np.arange(count) + random.random(count)) * (ends[-1] / count)
        shelf = np.minimum(np.searchsorted(ends, places), len(ends) - 1)
        before = self.filled[self.starts[1:]][chosen] - ends  # what lies on shelves that are not chosen
        place = np.searchsorted(self.filled, places + before[shelf], side="right") - 1
        drawn: Ints = self.triangles[np.clip(place, 0, len(self.triangles) - 1)]
        return drawn


@dataclass(frozen=True, eq=False)
class Cells:
    """A surface on shelves by the cells of a coarse grid; each triangle that is wide for them has its own shelf.

    Attributes
    ----------
    shelves : those of the C cells, then those of the W wide triangles.
    middles : (C, 3) of the cells.
    reach : how far from its middle the triangles of a cell may lie.
    wide : (W,) the wide triangles.
    """

    shelves: Shelves
    middles: Floats
    reach: float
    wide: Ints

    @classmethod
    def of(cls, vertices: Floats, triangles: Ints, areas: Floats) -> Cells:
        """The cells of a surface: vertices (V, 3), triangles (T, 3) and their areas (T,)."""
        low, high = vertices.min(axis=0), vertices.max(axis=0)
        step = np.maximum(high - low, np.finfo(float).tiny) / (CELLS * LEVELS)
        level = np.minimum((vertices - low) / step, CELLS * LEVELS - 1).astype(np.int16)
        first = np.zeros(len(triangles), dtype=np.int64)
        is_wide = np.zeros(len(triangles), dtype=bool)
        for axis in range(3):
            a, b, c = (np.ascontiguousarray(level[:, axis])[corner] for corner in triangles.T)
            is_wide |= (np.maximum(np.maximum(a, b), c) - np.minimum(np.minimum(a, b), c)) > LEVELS // 2
            first = first * CELLS + a // LEVELS
        wide = np.flatnonzero(is_wide)
        first[wide] = CELLS**3
        shelves = Shelves.of(first, CELLS**3 + 1, areas)
        alone = np.arange(len(first) - len(wide) + 1, len(first) + 1)  # the last shelf is cut into single triangles
        shelves = Shelves(shelves.triangles, np.concatenate([shelves.starts[:-1], alone]), shelves.filled)
        grid = np.stack(np.meshgrid(*[np.arange(CELLS)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
        middles = low + (grid + 0.5) * LEVELS * step
        return cls(shelves, middles, LEVELS * float(np.linalg.norm(step)), wide)
