"""Polygons as two arrays, read once: what a mesh of a hundred thousand polygons is passed on as.

It is a sequence of index arrays to whoever walks through it, and its arrays to whoever computes with all at once.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import chain
from typing import overload

import numpy as np

from .arrays import Bools, Ints


@dataclass(frozen=True, eq=False)
class PolygonTable(Sequence[Ints]):
    """Polygons of three corners or more.

    Attributes
    ----------
    loops : (C,) int64, vertex index of each corner, polygon after polygon. sizes : (F,) int64, corners per polygon.
    """

    loops: Ints
    sizes: Ints

    def __post_init__(self) -> None:
        for name in ("loops", "sizes"):
            array = np.array(getattr(self, name), dtype=np.int64)
            array.flags.writeable = False
            object.__setattr__(self, name, array)

    @classmethod
    def of(cls, polygons: Sequence[Sequence[int]] | Sequence[Ints] | Ints) -> PolygonTable:
        """The polygons of an (F, n) array or any sequence of index sequences; themselves where they are a table."""
        if isinstance(polygons, PolygonTable):
            return polygons
        if isinstance(polygons, np.ndarray) and polygons.ndim == 2:
            return cls(polygons.ravel(), np.full(len(polygons), polygons.shape[1]))
        sizes = np.fromiter(map(len, polygons), dtype=np.int64, count=len(polygons))
        if len(sizes) and all(isinstance(polygon, np.ndarray) for polygon in polygons):
            return cls(np.concatenate(list(polygons)), sizes)
        return cls(np.fromiter(chain.from_iterable(polygons), dtype=np.int64, count=int(sizes.sum())), sizes)

    @classmethod
    def joined(cls, tables: Sequence[PolygonTable]) -> PolygonTable:
        """Those of several tables, one after the other."""
        return cls(np.concatenate([each.loops for each in tables]), np.concatenate([each.sizes for each in tables]))

    @cached_property
    def starts(self) -> Ints:
        """(F,) where each polygon begins in `loops`."""
        return np.asarray(np.cumsum(self.sizes) - self.sizes, dtype=np.int64)

    @cached_property
    def by_size(self) -> tuple[tuple[Ints, Ints], ...]:
        """For each number of corners n: polygon numbers (F_n,), corner indices (F_n, n)."""
        if len(self) and self.sizes.min() == self.sizes.max():  # most meshes: nothing to gather
            return ((np.arange(len(self)), self.loops.reshape(len(self), -1)),)
        gathered = []
        for size in np.unique(self.sizes):
            faces = np.flatnonzero(self.sizes == size)
            gathered.append((faces, self.loops[self.starts[faces][:, None] + np.arange(size)]))
        return tuple(gathered)

    def __len__(self) -> int:
        return len(self.sizes)

    @overload
    def __getitem__(self, number: int) -> Ints: ...
    @overload
    def __getitem__(self, number: slice[int | None, int | None, int | None]) -> PolygonTable: ...
    def __getitem__(self, number: int | slice[int | None, int | None, int | None]) -> Ints | PolygonTable:
        if isinstance(number, slice):
            chosen = np.zeros(len(self), dtype=bool)
            chosen[number] = True
            return self.kept(chosen)
        start = self.starts[number]
        return self.loops[start : start + self.sizes[number]]

    def __iter__(self) -> Iterator[Ints]:
        for start, size in zip(self.starts.tolist(), self.sizes.tolist(), strict=True):
            yield self.loops[start : start + size]

    def within(self, marked: Bools) -> Bools:
        """(F,) which polygons have all their corners among the marked vertices (V,)."""
        if not len(self):
            return np.zeros(0, dtype=bool)
        inside: Bools = np.logical_and.reduceat(marked[self.loops], self.starts)
        return inside

    def touching(self, marked: Bools) -> Bools:
        """(F,) which polygons have a corner among the marked vertices (V,)."""
        touched = np.zeros(len(self), dtype=bool)
        touched[self.owners[marked[self.loops]]] = True
        return touched

    def kept(self, wanted: Bools) -> PolygonTable:
        """Those of some polygons (F,)."""
        return PolygonTable(self.loops[np.repeat(wanted, self.sizes)], self.sizes[wanted])

    def numbered(self, numbers: Ints) -> PolygonTable:
        """The same polygons with each vertex called by its number (V,)."""
        return PolygonTable(numbers[self.loops], self.sizes)

    @cached_property
    def after(self) -> Ints:
        """(C,) the vertex that follows each corner's in its polygon."""
        following = np.arange(1, len(self.loops) + 1)
        ends = self.starts + self.sizes
        following[ends - 1] = self.starts
        return self.loops[following]

    @cached_property
    def owners(self) -> Ints:
        """(C,) the polygon of each corner."""
        return np.repeat(np.arange(len(self)), self.sizes)
