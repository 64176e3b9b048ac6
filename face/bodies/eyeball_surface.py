"""The eyeball as a body that lids slide on: not quite a ball, and its cornea stands out and turns with the gaze.

Its surface is kept as the distance from its centre over direction, in the eyeball's own axes.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from scipy.spatial.transform import Rotation

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
        """Depths (k,) below the clearance and ways out (k, 3) of positions (k, 3) in head space."""
        away = positions - look.centre
        distance = np.maximum(np.linalg.norm(away, axis=1), 1e-9)
        outwards = away / distance[:, None]
        angle, turn = _direction(outwards @ _axes(look.gaze))
        first = np.minimum(angle.astype(np.int64), ANGLES - 2)
        second = np.minimum(turn.astype(np.int64), TURNS - 1)
        u, v = angle - first, turn - second
        near = (1.0 - v) * self.radii[first, second] + v * self.radii[first, second + 1]
        far = (1.0 - v) * self.radii[first + 1, second] + v * self.radii[first + 1, second + 1]
        return (1.0 - u) * near + u * far + EYEBALL.clearance - distance, outwards


def _axes(gaze: Floats) -> Floats:
    """(3, 3) columns: two axes across the gaze, the way head space's x and y are carried there, and the gaze."""
    turn = np.cross([0.0, 0.0, 1.0], gaze)
    sine = float(np.linalg.norm(turn))
    if sine < 1e-12:
        return np.eye(3)
    return np.asarray(Rotation.from_rotvec(turn / sine * np.arctan2(sine, gaze[2])).as_matrix())


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
    places, distances = list[tuple[Floats, Floats]](), list[Floats]()
    for block in sample_blocks(vertices[triangles], SPACING):
        yield Progress(0.0, "Preparing contact of lips and lids")
        away = block - rest.centre
        distances.append(np.maximum(np.linalg.norm(away, axis=1), 1e-9))
        places.append(_direction(away @ _axes(rest.gaze) / distances[-1][:, None]))
    angle, turn = (np.concatenate(part) for part in zip(*places, strict=True))
    distance = np.concatenate(distances)
    radii = _means(angle, turn, distance)
    radii[np.isnan(radii)] = np.median(distance)
    return Ball(rest, np.column_stack([radii, radii[:, 0]]))


def _means(angle: Floats, turn: Floats, distance: Floats) -> Floats:
    """(ANGLES, TURNS) mean distance of the outermost samples (k,) about each direction, NaN where there are none.

    A sample counts for the four directions round it by how near it is to each, so that none makes a difference by the
    side of a border that it lies on.
    """
    first, before = np.floor(angle).astype(np.int64), np.floor(turn).astype(np.int64)
    u, v = angle - first, turn - before
    corners = [
        (np.minimum(first + i, ANGLES - 1), (before + j) % TURNS, (u if i else 1.0 - u) * (v if j else 1.0 - v))
        for i in (0, 1)
        for j in (0, 1)
    ]
    outermost = np.zeros((ANGLES, TURNS))
    for row, column, _ in corners:
        np.maximum.at(outermost, (row, column), distance)
    total, weight = np.zeros((2, ANGLES, TURNS))
    for row, column, share in corners:
        counts = share * (1.0 - smoothstep((outermost[row, column] - distance) / SHELL))
        np.add.at(total, (row, column), counts * distance)
        np.add.at(weight, (row, column), counts)
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
        """See `Body`; positions (n, 3) of the outer skin."""
        deep, outwards = self.ball.depths(positions[self.index], at.looks.get(self.side, self.ball.rest))
        return deep - self._excused, outwards
