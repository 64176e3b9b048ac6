"""A closed piece beside the skin (eyeball, teeth, tongue, brow), and the quad shapes they share."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arrays import Floats, Ints
from ..mesh.parts import Part


@dataclass(frozen=True, eq=False)
class Piece:
    """One connected, closed quad mesh.

    Attributes
    ----------
    vertices : (V, 3) float64, metres.
    quads : (F, 4) int64, outward winding.
    part : what it is.
    materials : (F,) material names.
    mirror : (V,) int64 for a piece across the midline; None for one that has a twin on the other side.
    """

    vertices: Floats
    quads: Ints
    part: Part
    materials: tuple[str, ...]
    mirror: Ints | None = None

    def mirrored(self, part: Part) -> Piece:
        """The twin on the other side; vertex by vertex the same order."""
        return Piece(self.vertices * np.array([-1.0, 1.0, 1.0]), self.quads[:, ::-1].copy(), part, self.materials)


def tube_quads(rings: int, around: int) -> Ints:
    """Quads (F, 4) between consecutive closed rings; vertex = ring * around + place.

    Outward when, seen along the direction in which the rings advance, each ring runs clockwise.
    """
    ring, place = np.meshgrid(np.arange(rings - 1), np.arange(around), indexing="ij")
    following = (place + 1) % around
    here, there = ring * around, (ring + 1) * around
    quads = [there + place, there + following, here + following, here + place]
    return np.stack(quads, axis=-1).reshape(-1, 4).astype(np.int64)


def fan_quads(centre: int, ring: Ints) -> Ints:
    """Quads (N / 2, 4) that close an even ring with one centre vertex."""
    ahead = np.roll(ring, -1)
    quads = [np.full(len(ring) // 2, centre), ring[::2], ahead[::2], np.roll(ring, -2)[::2]]
    return np.stack(quads, axis=-1).astype(np.int64)


def ladder_quads(ring: Ints) -> Ints:
    """Quads (N / 2 - 1, 4) that close an even ring with rungs and no new vertex."""
    half = len(ring) // 2
    front, back = ring[:half], ring[: half - 1 : -1]
    return np.stack([front[:-1], front[1:], back[1:], back[:-1]], axis=-1).astype(np.int64)
