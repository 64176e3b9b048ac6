"""A row of teeth as a body that lips lie on: how far it reaches out, seen from an upright axis behind it.

Teeth are many separate pieces, often open ones. What lips can feel of them is their front: the distance from the axis
over direction and height, with the gaps between teeth closed. The lower row goes with the mandible.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from scipy import ndimage

from ...arrays import Bools, Floats, Ints
from ...physics.mesh import sample_blocks
from ...progress import Progress, Work
from ..figures import Length, read_figures
from ..mechanisms.jaw import Jaw
from .surroundings import Surroundings


@dataclass(frozen=True)
class TeethFigures:
    """Of any row of teeth (presets/anatomy/bodies.toml)."""

    clearance: Length
    widest: float
    thickest: Length


TEETH = read_figures("bodies.teeth", TeethFigures)

#: Grid of the front: step of the directions, rad, and of the heights, metres.
TURN, RISE = np.radians(1.5), 0.5e-3

#: Gaps of this many cells are closed.
GAP = 5


@dataclass(frozen=True, eq=False)
class Front:
    """The front of a row of teeth in head space, the mandible at rest.

    Attributes
    ----------
    axis : (2,) x and z of the upright axis behind the row. bottom : height of the grid's first line.
    reach : (directions, heights) distance of the front from the axis, metres; minus infinity where there is no tooth.
    """

    axis: Floats
    bottom: float
    reach: Floats

    def depths(self, positions: Floats) -> tuple[Floats, Floats]:
        """Depths (..., k) below the clearance and ways out (..., k, 3), for positions (..., k, 3).

        Off the row, and before all of it, depths are minus infinity and there is no way out.
        """
        x, y, z = np.moveaxis(positions, -1, 0)
        aside, before, line = x - self.axis[0], z - self.axis[1], (y - self.bottom) / RISE
        distance = np.maximum(np.sqrt(aside**2 + before**2), 1e-9)
        farthest, top = self._farthest + TEETH.clearance, self.reach.shape[1] - 1
        near = np.nonzero((distance < farthest) & (line >= 0.0) & (line <= top))
        deep, outwards = np.full(distance.shape, -np.inf), np.zeros_like(positions)
        way = np.stack([aside[near], np.zeros(len(near[0])), before[near]], axis=1)
        outwards[near] = way / distance[near][:, None]
        column = (np.arctan2(aside[near], before[near]) + TEETH.widest) / TURN
        deep[near] = self._reached(column, line[near]) + TEETH.clearance - distance[near]
        deep[deep >= TEETH.thickest] = -np.inf
        return deep, outwards

    def _reached(self, column: Floats, line: Floats) -> Floats:
        """(k,) distance of the front from the axis at places of the grid, minus infinity off the row."""
        first = np.clip(np.floor(column).astype(np.int64), 0, self.reach.shape[0] - 2)
        second = np.clip(np.floor(line).astype(np.int64), 0, self.reach.shape[1] - 2)
        u, v = column - first, line - second
        whole, known = self._known
        cell, width = first * self.reach.shape[1] + second, self.reach.shape[1]
        on_row = (np.abs(u - 0.5) <= 0.5) & (np.abs(v - 0.5) <= 0.5) & whole.take(cell)
        reached = (1 - u) * (1 - v) * known.take(cell) + (1 - u) * v * known.take(cell + 1)
        reached += u * (1 - v) * known.take(cell + width)
        reached += u * v * known.take(cell + width + 1)
        return np.where(on_row, reached, -np.inf)

    @cached_property
    def _farthest(self) -> float:
        """How far the row reaches out at most, metres."""
        return float(self.reach.max(initial=-np.inf))

    @cached_property
    def _known(self) -> tuple[Bools, Floats]:
        """Of every place of the grid, flat: whether there is a tooth there and at the three next, and `reach` or 0."""
        tooth = np.isfinite(self.reach)
        whole = np.zeros_like(tooth)
        whole[:-1, :-1] = tooth[:-1, :-1] & tooth[1:, :-1] & tooth[:-1, 1:] & tooth[1:, 1:]
        return whole.ravel(), np.where(tooth, self.reach, 0.0).ravel()


def front_steps(vertices: Floats, triangles: Ints) -> Work[Front]:
    """The front of a row of teeth from its surface: vertices (v, 3) in head space, triangles (t, 3)."""
    blocks: list[Floats] = []
    for block in sample_blocks(vertices[triangles], 0.5 * RISE):
        blocks.append(block)
        yield Progress(0.0, "Preparing contact of lips and lids")
    corners = vertices[np.unique(triangles)]
    low, high = corners.min(axis=0), corners[:, 1].max()
    middle = sum(float(block[:, 0].sum()) for block in blocks) / sum(map(len, blocks))
    axis, bottom = np.array([middle, low[2]]), float(low[1]) - RISE
    reach = np.full((int(2 * TEETH.widest / TURN) + 1, int((high - bottom) / RISE) + 3), -np.inf)
    for number, block in enumerate(blocks):
        yield Progress(number / len(blocks), "Preparing contact of lips and lids")
        aside, before = block[:, 0] - axis[0], block[:, 2] - axis[1]
        column = np.round((np.arctan2(aside, before) + TEETH.widest) / TURN).astype(np.int64)
        line = np.round((block[:, 1] - bottom) / RISE).astype(np.int64)
        far = np.hypot(aside, before)
        seen = np.flatnonzero((column >= 0) & (column < len(reach)))
        farther = seen[far[seen] > reach[column[seen], line[seen]]]
        farther = farther[np.argsort(far[farther])]  # of those in one cell the last stays, the farthest
        reach[column[farther], line[farther]] = far[farther]
    return Front(axis, bottom, np.asarray(ndimage.grey_closing(reach, size=(GAP, GAP), mode="nearest")))


@dataclass(frozen=True, eq=False)
class DentalArch:
    """One row of teeth behind the skin of the lips.

    Attributes
    ----------
    front : its front, the mandible at rest. jaw : the mandible that carries it; None for the upper row.
    index, firmness : as `Body`. skin : (k, 3) rest positions of those vertices.
    """

    front: Front
    jaw: Jaw | None
    index: Ints
    firmness: Floats
    skin: Floats
    _excused: Floats = field(init=False)

    def __post_init__(self) -> None:
        """Lips that lie in the teeth at rest may stay as deep."""
        deep, _ = self.front.depths(self.skin)
        object.__setattr__(self, "_excused", np.maximum(deep, 0.0))

    def depths(self, positions: Floats, at: Surroundings) -> tuple[Floats, Floats]:
        """See `Body`; positions (..., n, 3) of the outer skin."""
        near = positions[..., self.index, :]
        if self.jaw is None:
            deep, outwards = self.front.depths(near)
        else:
            deep, outwards = self.front.depths(self.jaw.unmoved(near, at.jaw))
            outwards = self.jaw.turned(outwards, at.jaw)
        return deep - self._excused, outwards
