"""The head on its spine: what FAPs 48 to 50 turn, and how those FAPs are read back."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from ...arrays import Bools, Floats, Ints
from ...mpeg4 import ANGLE_UNIT
from ..figures import Length, Pair, read_figures
from ..mesh.head_frame import rotation_between
from ..skin.outer import smoothstep
from .direct_faps import value_of

#: The skull's pose is refitted this often with weight on the vertices that agree to about this distance, metres, or
#: until none of them is off by this more or less than before.
SKULL_ROUNDS, SKULL_TOLERANCE, SKULL_SETTLED = 12, 1e-6, 1e-12


@dataclass(frozen=True)
class HeadFigures:
    """Where neck and skull are (presets/anatomy/bodies.toml)."""

    neckless: float
    neck: Pair
    crown: Length
    occiput: Pair


HEAD = read_figures("bodies.head", HeadFigures)


@dataclass(frozen=True, eq=False)
class HeadTurn:
    """The head on its spine: pitch, yaw and roll about 7.1, the neck following down to its root.

    Attributes
    ----------
    pivot : (3,) head space. weights : (V,) 1 on the head, 0 at the root of the neck.
    skull : (s,) vertices that expression does not move, from which the head's pose is read back; may be empty.
    """

    pivot: Floats
    weights: Floats
    skull: Ints

    @property
    def is_readable(self) -> bool:
        """Whether enough of the skull is there to tell how the head is turned."""
        return len(self.skull) >= 4

    def apply(self, positions: Floats, faps: Floats, vertices: Ints | slice[None, None, None] = slice(None)) -> Floats:
        """Positions (V, 3), of all or some vertices, turned as FAPs 48 (down), 49 (left), 50 (right shoulder) say."""
        pitch, yaw, roll = (value_of(faps, number) * ANGLE_UNIT for number in (48, 49, 50))
        if pitch == yaw == roll == 0.0:
            return positions
        vector = Rotation.from_euler("yxz", [yaw, pitch, roll]).as_rotvec()
        turn = Rotation.from_rotvec(self.weights[vertices, None] * vector)
        turned: Floats = turn.apply(positions - self.pivot) + self.pivot
        return turned

    def undo(
        self, positions: Floats, rest: Floats, wanted: Ints | slice[None, None, None] = slice(None)
    ) -> tuple[Floats, dict[int, float]]:
        """Positions (V, 3), those of all or some vertices with the head's turn taken out, and FAPs 48-50.

        Where the mesh shows no skull they are unchanged.
        """
        if not self.is_readable:
            return positions, {}
        turn, shift = self._rigid_motion(rest[self.skull], positions[self.skull])
        vector, weights = turn.as_rotvec(), self.weights[wanted][:, None]
        undo = Rotation.from_rotvec(-weights * vector)
        back = positions.copy()
        back[wanted] = undo.apply(positions[wanted] - self.pivot - weights * shift) + self.pivot
        yaw, pitch, roll = turn.as_euler("yxz")
        return back, {48: pitch / ANGLE_UNIT, 49: yaw / ANGLE_UNIT, 50: roll / ANGLE_UNIT}

    def _rigid_motion(self, source: Floats, target: Floats) -> tuple[Rotation, Floats]:
        """Rotation about the pivot and shift (3,) that most skull vertices agree on (iteratively reweighted)."""
        weights, before = np.ones(len(source)), np.full(len(source), np.inf)
        for _ in range(SKULL_ROUNDS):
            shares = weights / weights.sum()
            middle, moved = shares @ source, shares @ target
            turn = rotation_between((source - middle) * shares[:, None], target - moved)
            shift = moved - (turn @ (middle - self.pivot) + self.pivot)
            off = np.sqrt((((source - self.pivot) @ turn.T + self.pivot + shift - target) ** 2).sum(axis=1))
            if np.abs(off - before).max() <= SKULL_SETTLED:
                break
            weights, before = 1.0 / (off + SKULL_TOLERANCE), off
        return Rotation.from_matrix(turn), shift


def build_head_turn(positions: Floats, pivot: Floats, brow_height: float, read: Bools) -> HeadTurn:
    """The head's turn on a mesh (V, 3) in head space; a head without a neck turns as a whole.

    `read` (V,) are the vertices that may tell how it is turned, and whether it has a neck: not hair, nor a hat.
    """
    low = float(positions[read, 1].min())
    y = positions[:, 1]
    (root, over), (behind, above) = HEAD.neck, HEAD.occiput
    weights = np.ones(len(positions)) if low > HEAD.neckless else smoothstep((y - root) / over)
    skull = np.flatnonzero(read & ((y > brow_height + HEAD.crown) | ((positions[:, 2] < behind) & (y > above))))
    return HeadTurn(pivot=pivot, weights=weights, skull=skull)
