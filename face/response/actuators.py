"""Everything that FAPs are explained by: muscles, lids and jaw, as linear responses of the FAP rows.

Each actuator has an amount in metres: the largest skin displacement of a muscle, the way of a lid's middle, the way of
the chin. Amounts are what the inverse finds; contractions in [0, 1] are amounts over amplitudes.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.linalg.blas import daxpy

from ...arrays import Floats, Ints
from ...physics.mesh import Sparse
from ..figures import Length, read_figures
from ..mechanism import Mechanism
from ..mechanisms.jaw import Jaw, JawMotion
from ..mechanisms.lid_movers import LID_MOVERS, LidMove
from ..mechanisms.lids import Eye
from ..skin.outer import OuterSkin
from .pulls import Pulls

#: Places in a vector of amounts: the jaw's opening, then its slides to the left and forward; all else comes before.
OPENING, SLIDES = -3, slice(-2, None)


@dataclass(frozen=True)
class JawFigures:
    """How far the mandible goes at most, and how far it usually opens (presets/anatomy/jaw.toml)."""

    opening: Length
    sewn_opening: Length
    left: Length
    forward: Length
    usual_opening: Length


JAW = read_figures("jaw.motion", JawFigures)

#: A lid's way by which its response about rest is found, metres.
SMALL = 1e-3


@dataclass(frozen=True, eq=False)
class Amounts:
    """How much of each actuator: muscles (k,) in metres, lid moves in metres, jaw."""

    muscles: Floats
    lids: Mapping[tuple[str, LidMove], float]
    jaw: JawMotion


class Actuators:
    """The actuators of one face with their fields on the outer skin."""

    def __init__(self, skin: OuterSkin, pulls: Pulls, jaw: Jaw, eyes: Mapping[str, Eye]) -> None:
        self.skin, self.jaw, self.eyes = skin, jaw, eyes
        self.muscles, self.sheets, self.fields = list(pulls.muscles), pulls.sheets, pulls.fields
        lids = skin.has(Mechanism.LIDS)
        self.lid_moves = [(side, move) for side in "lr" for move in LidMove] if lids else []

    @property
    def count(self) -> int:
        """How many amounts there are: k muscles, 8 lid moves (none without lids), the jaw's opening, its two slides."""
        return len(self.muscles) + len(self.lid_moves) + 3

    def usual(self, opening: float, slide: float) -> Floats:
        """(k + 8 + 3,) usual amounts, metres; the jaw's opening at the chin and its slides as they are given."""
        muscles = [muscle.row.prior for muscle in self.muscles]
        lids = [LID_MOVERS[move].prior for _, move in self.lid_moves]
        return np.array([*muscles, *lids, opening, slide, slide])

    @property
    def upper(self) -> Floats:
        """Largest amount of each actuator, metres; the jaw's slides may also be negative."""
        muscles = [muscle.amplitude for muscle in self.muscles]
        lids = [LID_MOVERS[move].amplitude for _, move in self.lid_moves]
        opening = JAW.sewn_opening if "mouth" in self.skin.sewn else JAW.opening
        return np.array([*muscles, *lids, opening, JAW.left, JAW.forward])

    @property
    def chin_lever(self) -> float:
        """Metres the chin moves per radian of opening."""
        return float(np.linalg.norm((self.skin.points["2.1"] - self.jaw.hinge)[1:]))

    def responses(self, rows: Sparse) -> Floats:
        """(m, k + 8 + 3) change of FAP rows per metre of each amount, about rest.

        rows : (m, 3n) reads rows off flattened displacements of the outer skin.
        """
        lids = [self.lid_field({move: SMALL}, side) / SMALL for side, move in self.lid_moves]
        opening, left, forward = self.jaw.derivatives(self.skin.positions, JawMotion())
        extra = np.stack([*lids, opening / self.chin_lever, left, forward])
        every = np.concatenate([self.fields, extra])
        return np.asarray(rows @ every.reshape(len(every), -1).T)

    def lid_field(self, moves: dict[LidMove, float], side: str) -> Floats:
        """(n, 3) displacement of the outer skin by lid moves of one eye (metres)."""
        return self.eyes[side].skin(self.skin.positions, moves)

    def amounts(self, solution: Floats) -> Amounts:
        """Name the entries of a solution vector (k + 8 + 3,)."""
        count = len(self.muscles)
        lids = dict(zip(self.lid_moves, solution[count:OPENING].tolist(), strict=True))
        angle, (left, forward) = solution[OPENING] / self.chin_lever, solution[SLIDES]
        return Amounts(solution[:count].copy(), lids, JawMotion(float(angle), float(left), float(forward)))

    def none(self) -> Amounts:
        """No amount of anything."""
        return self.amounts(np.zeros(self.count))

    def carried(self, amounts: Amounts) -> Floats:
        """(n, 3) displacement of the outer skin by jaw and lids, as exact rotations."""
        return np.asarray(self.carried_each(*self.carriers([amounts]))[0])

    def carriers(self, several: Sequence[Amounts]) -> tuple[Floats, Floats]:
        """The mandible (T, 3), its angle and slides, and lid moves (T, l) of several amounts."""
        jaws = [(each.jaw.angle, each.jaw.left, each.jaw.forward) for each in several]
        return np.array(jaws), np.array([[each.lids[move] for move in self.lid_moves] for each in several])

    def carried_each(self, jaws: Floats, lids: Floats) -> Floats:
        """(T, n, 3) as `carried`, by mandibles (T, 3) and lid moves (T, l)."""
        moved: Floats = self.jaw.skin(self.skin.positions, jaws)  # to the bit, wherever in memory it is worked out
        for near, by_lids in self.lids_carried(lids):
            moved[:, near] += by_lids
        return moved

    @cached_property
    def jaw_ways(self) -> Floats:
        """(5, n, 3) fields of the outer skin that the jaw moves it in, by `Jaw.shares`."""
        return self.jaw.ways(self.skin.positions)

    def lids_carried(self, lids: Floats) -> Iterator[tuple[Ints, Floats]]:
        """Of each eye the skin (k,) that its lids take along, and how (T, k, 3) by lid moves (T, l)."""
        for side in "lr" if self.lid_moves else "":
            moves = {move: lids[:, i] for i, (s, move) in enumerate(self.lid_moves) if s == side}
            yield self.eyes[side].near, self.eyes[side].carried(self.skin.positions, moves)

    def low_strain(self, amounts: Amounts) -> Floats:
        """(n, 3) displacement of the outer skin by muscles, as if the skin were linear."""
        return np.asarray(self.low_strain_each(amounts.muscles[None])[0])

    def low_strain_each(self, muscles: Floats) -> Floats:
        """(T, n, 3) as `low_strain`, of muscles (T, k)."""
        pulling = muscles.any(axis=0)  # most muscles rest in most faces
        if len(muscles) == 1:
            moved = np.zeros(self.skin.positions.size)
            for muscle in np.flatnonzero(pulling):  # none of these fields is copied: each is run through once
                daxpy(self.fields[muscle].ravel(), moved, a=muscles[0, muscle])
            return moved.reshape(1, -1, 3)
        return np.asarray(np.tensordot(muscles[:, pulling], self.fields[pulling], axes=1), dtype=np.float64)

    def contractions(self, amounts: Amounts) -> dict[str, float]:
        """Actuator name -> contraction in [0, 1]; the jaw as "jaw_open"."""
        strengths = zip(self.muscles, amounts.muscles.tolist(), strict=True)
        named = {muscle.name: amount / muscle.amplitude for muscle, amount in strengths}
        for (side, move), amount in amounts.lids.items():
            named[f"{LID_MOVERS[move].name}_{side}"] = amount / LID_MOVERS[move].amplitude
        if self.skin.has(Mechanism.JAW):
            named["jaw_open"] = amounts.jaw.angle * self.chin_lever / self.upper[OPENING]
        return {name: min(max(float(value), 0.0), 1.0) for name, value in named.items()}
