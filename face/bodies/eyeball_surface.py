"""The eyeball as a body that lids slide on: not quite a ball, and its cornea stands out and turns with the gaze.

Its surface is kept as the distance from its centre over direction, in the eyeball's own axes.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple

import numpy as np

from ...arrays import Floats, Ints
from ...physics.mesh import sample_blocks
from ...progress import Progress, Work
from ..skin.outer import smoothstep
from .eyeball import EYEBALL
from .surroundings import Look, Surroundings

#: Directions of the surface: this many angles from the gaze to its back, and this many round it.
ANGLES, TURNS = 91, 72

#: Distance of the points at which a modelled eyeball's surface is taken, metres.
SPACING = 0.25e-3

#: So many points are looked at at once, which the processor holds near.
AT_ONCE = 20_000

#: What lies farther below the outermost surface in its direction is another shell, metres.
SHELL = 0.5e-3


@dataclass(frozen=True, eq=False)
class Ball:
    """The surface of one eyeball.

    Attributes
    ----------
    rest : where it is at rest.
    radii : (ANGLES, TURNS + 1) distance from the centre, metres, over angle from the gaze and turn about it; the last
        turn is the first again.
    """

    rest: Look
    radii: Floats

    def depths(self, positions: Floats, look: Look) -> tuple[Floats, Floats]:
        """Depths (..., k) below the clearance and ways out (..., k, 3) of positions (..., k, 3) in head space.

        What is farther out than all of the ball has the depth that it would have were the ball as large everywhere.
        """
        away = positions - look.centre[..., None, :]
        distance = np.maximum(np.sqrt((away**2).sum(axis=-1)), 1e-9)
        depth = self.largest + EYEBALL.clearance - distance
        near = np.nonzero(depth > 0.0)
        outwards = np.zeros_like(away)
        outwards[near] = unit = away[near] / distance[near][:, None]
        axes = np.broadcast_to(look.axes, (*distance.shape[:-1], 3, 3))[near[:-1]]
        depth[near] += self._radius((unit[:, None] @ axes)[:, 0]) - self.largest
        return depth, outwards

    @cached_property
    def largest(self) -> float:
        """Its largest radius, metres."""
        return float(self.radii.max())

    def _radius(self, unit: Floats) -> Floats:
        """(k,) distance of the surface from the centre in directions (k, 3) in the eyeball's axes."""
        angle, turn = _direction(unit)
        first = np.minimum(angle.astype(np.int64), ANGLES - 2)
        second = np.minimum(turn.astype(np.int64), TURNS - 1)
        u, v = angle - first, turn - second
        near = (1.0 - v) * self.radii[first, second] + v * self.radii[first, second + 1]
        far = (1.0 - v) * self.radii[first + 1, second] + v * self.radii[first + 1, second + 1]
        return np.asarray((1.0 - u) * near + u * far)


def _direction(unit: Floats) -> tuple[Floats, Floats]:
    """Places on the grid of directions (k,), (k,) for unit vectors (k, 3) in the eyeball's axes."""
    angle = np.arccos(np.clip(unit[:, 2], -1.0, 1.0)) / np.pi * (ANGLES - 1)
    turn = (np.arctan2(unit[:, 1], unit[:, 0]) / (2.0 * np.pi) % 1.0) * TURNS
    return angle, turn


def round_ball(rest: Look, radius: float) -> Ball:
    """The eyeball of a face that has none modelled."""
    return Ball(rest, np.full((ANGLES, TURNS + 1), radius))


def modelled_ball_steps(rest: Look, vertices: Floats, triangles: Ints) -> Work[Ball]:
    """The surface of a modelled eyeball: vertices (v, 3) in head space, triangles (t, 3).

    Of several shells the outermost counts. Directions in which nothing is modelled have the median distance.
    """
    samples = list[_Samples]()
    for block in sample_blocks(vertices[triangles], SPACING):
        for part in np.array_split(block, len(block) // AT_ONCE + 1):
            yield Progress(0.0, "Preparing contact of lips and lids")
            away = part - rest.centre
            distance = np.maximum(np.linalg.norm(away, axis=1), 1e-9)
            samples.append(_Samples(*_direction(away @ rest.axes / distance[:, None]), distance))
    radii = yield from _means(samples)
    radii[np.isnan(radii)] = np.median(np.concatenate([part.distance for part in samples]))
    return Ball(rest, np.column_stack([radii, radii[:, 0]]))


class _Samples(NamedTuple):
    """Places (k,), (k,) on the grid of directions, and how far off the surface is there (k,), metres."""

    angle: Floats
    turn: Floats
    distance: Floats

    def cells(self) -> tuple[Ints, Floats]:
        """The four directions round each (4, k), as numbers of a flat grid, and how near it is to each, 0..1."""
        first, before = np.floor(self.angle).astype(np.int64), np.floor(self.turn).astype(np.int64)
        u, v = self.angle - first, self.turn - before
        row, above = first * TURNS, np.minimum(first + 1, ANGLES - 1) * TURNS
        column, beside = before % TURNS, (before + 1) % TURNS
        cells = np.stack([row + column, row + beside, above + column, above + beside])
        return cells, np.stack([(1.0 - u) * (1.0 - v), (1.0 - u) * v, u * (1.0 - v), u * v])


def _means(samples: Sequence[_Samples]) -> Work[Floats]:
    """(ANGLES, TURNS) mean distance of the outermost samples about each direction, NaN where there are none.

    A sample counts for the four directions round it by how near it is to each, so that none makes a difference by the
    side of a border that it lies on.
    """
    outermost = np.zeros(ANGLES * TURNS)
    for part in samples:
        yield Progress(0.0, "Preparing contact of lips and lids")
        for cell in part.cells()[0]:
            higher = np.flatnonzero(part.distance > outermost[cell])
            higher = higher[np.argsort(part.distance[higher])]  # of those in one cell the last stays, the farthest
            outermost[cell[higher]] = part.distance[higher]
    total, weight = np.zeros((2, ANGLES * TURNS))
    for part in samples:
        yield Progress(0.0, "Preparing contact of lips and lids")
        cells, shares = part.cells()
        counts = shares * (1.0 - smoothstep((outermost[cells] - part.distance) / SHELL))
        total += np.bincount(cells.ravel(), (counts * part.distance).ravel(), len(total))
        weight += np.bincount(cells.ravel(), counts.ravel(), len(total))
    total, weight = total.reshape(ANGLES, TURNS), weight.reshape(ANGLES, TURNS)
    for pole in (0, -1):  # one direction, whatever the turn
        total[pole], weight[pole] = total[pole].sum(), weight[pole].sum()
    return np.where(weight > 0.0, total / np.where(weight > 0.0, weight, 1.0), np.nan)


@dataclass(frozen=True, eq=False)
class EyeballSurface:
    """One eyeball behind the skin of its lids.

    Attributes
    ----------
    side : "l" or "r". ball : its surface.
    index, firmness : as `Body`. skin : (k, 3) rest positions of those vertices.
    """

    side: str
    ball: Ball
    index: Ints
    firmness: Floats
    skin: Floats
    _excused: Floats = field(init=False)

    def __post_init__(self) -> None:
        """Skin that lies in the eyeball at rest, at its corners, may stay as deep."""
        deep, _ = self.ball.depths(self.skin, self.ball.rest)
        object.__setattr__(self, "_excused", np.maximum(deep, 0.0))

    def depths(self, positions: Floats, at: Surroundings) -> tuple[Floats, Floats]:
        """See `Body`; positions (..., n, 3) of the outer skin."""
        deep, outwards = self.ball.depths(positions[..., self.index, :], at.looks.get(self.side, self.ball.rest))
        return deep - self._excused, outwards
