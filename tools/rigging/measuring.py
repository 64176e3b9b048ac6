"""How far shape keys follow the muscles' own poses, beside what plain bounded least squares gives at best."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import risorius.api as api
from risorius.api import Retargeting
from risorius.arrays import Bools, Floats
from risorius.face.retarget.fights import opposed_pairs
from risorius.face.retarget.normal import Wishes, normal_equations
from risorius.face.retarget.weighing import Counted
from scipy.optimize import lsq_linear

from .heads import KeyedHead

WORDS = ("joy", "surprise", "fear", "anger", "sadness", "disgust")
#: FAPs that turn the eyeballs, and radians per unit of an angle.
GAZE, ANGLE_UNIT = slice(22, 26), 1e-5
#: A key is on, and two of them fight, from this value.
ON = 0.05


@dataclass(frozen=True)
class Shown:
    """What one way to key an emotion shows.

    Attributes
    ----------
    explained : share of the skin's motion.
    every, requested : root mean square error of all measurable FAPs and of the requested ones, mm on a life-size face.
    units : that of the requested ones beside what the profile asks, FAP units.
    gaze : the largest error of an eyeball's turn, degrees; NaN where the head has no eyeballs.
    on, fights : number of keys that are on, and of pairs of them that pull against each other.
    """

    explained: float
    every: float
    requested: float
    units: float
    gaze: float
    on: int
    fights: int


@dataclass(frozen=True)
class Followed:
    """An emotion on one head: `muscles` rms error of the requested FAPs of the muscles' own pose, FAP units."""

    head: str
    word: str
    muscles: float
    plain: Shown
    ours: Shown


def followed(head: KeyedHead) -> Iterator[Followed]:
    """Each of the six emotions on the keys of a head."""
    retargeting = Retargeting(head.face, head.keys)
    for word in WORDS:
        profile = api.expression(word)
        positions = head.face.pose(profile.frame(), emotion=profile.weights).positions
        measuring = _Measuring(head, retargeting, positions, profile.frame())
        take = retargeting.take()
        take.add(positions)
        found = retargeting.values(take, requested=profile.frame())
        best = plain_values(retargeting, positions)
        yield Followed(head.name, word, measuring.muscles, measuring.shown(best), measuring.shown(found.values[0]))


def plain_values(retargeting: Retargeting, positions: Floats) -> Floats:
    """(K,) the values that are nearest to positions (V, 3) over the outer skin alone."""
    by = retargeting
    moved = by.sight.of_skin(by.frame.to_head(positions) - by.face.anatomy.mesh.positions)
    values: Floats = lsq_linear(by.does.skin.T, moved, (by.controls.low, by.controls.high)).x
    return values


def cosines(retargeting: Retargeting) -> Floats:
    """(K, K) how much keys do the same, 1, or the opposite, -1, over skin, feature points and gaze."""
    does, faps = retargeting.does, np.arange(retargeting.does.points.shape[1]) < len(retargeting.sight.numbers)
    nothing = Wishes(np.zeros((1, len(does.skin))), np.zeros((1, len(faps))), np.zeros(1))
    return normal_equations(does, nothing, Counted(faps, np.zeros_like(faps)).weights(0.4, 0.4)).matrix


class _Measuring:
    """Measures ways to key one pose of the muscles."""

    def __init__(self, head: KeyedHead, retargeting: Retargeting, positions: Floats, asked: Floats) -> None:
        self.face, self.by = head.face, retargeting
        self.moved = retargeting.sight.of_skin(retargeting.frame.to_head(positions) - head.face.anatomy.mesh.positions)
        self.asked, self.achieved = asked, head.face.measure(positions)
        self.metres = np.full(68, np.nan)
        self.metres[retargeting.sight.numbers - 1] = retargeting.sight.units
        self.every: Bools = ~np.isnan(self.metres) & ~np.isnan(self.achieved)
        self.requested: Bools = self.every & ~np.isnan(asked)
        self.muscles = _rms((self.achieved - asked)[self.requested])
        controls = retargeting.controls
        self.opposed = opposed_pairs(cosines(retargeting), controls.low, controls.high, {})

    def shown(self, values: Floats) -> Shown:
        """What values (K,) show."""
        left = self.by.does.skin.T @ values - self.moved
        faps = self.face.measure(self.face.vertices + self.by.controls.displacement(values))
        off = 1000.0 * (faps - self.achieved) * self.metres
        turns = np.abs((faps - self.achieved)[GAZE])
        fighting = [pair for pairs in self.opposed for pair in pairs if values[list(pair)].min() > ON]
        return Shown(
            1.0 - float(left @ left) / float(self.moved @ self.moved),
            _rms(off[self.every]),
            _rms(off[self.requested]),
            _rms((faps - self.asked)[self.requested]),
            float(np.degrees(turns.max() * ANGLE_UNIT)),
            int((values > ON).sum()),
            len(fighting),
        )


def _rms(values: Floats) -> float:
    """Root mean square."""
    return float(np.sqrt((values**2).mean()))
