"""Eyeballs, tongue and head: what the direct FAPs (23-30, 43-50) move, and how those FAPs are read back."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from ..arrays import Floats, Ints
from .outer_skin import smoothstep
from .surroundings import Look
from .template import MM

ANGLE_UNIT = 1e-5

#: The skull's pose is refitted this often with weight on the vertices that agree to about this distance, metres.
SKULL_ROUNDS, SKULL_TOLERANCE = 12, 1e-6

#: The neutral pupil is a third of the iris, and the iris as wide as the neutral lid gap (ISO/IEC 14496-2 neutral face).
PUPIL_SHARE = 1.0 / 3.0

#: FAPs of the tongue, as places in a frame.
TONGUE = slice(42, 47)

#: A tongue of which nothing is asked loses this share of its height, once the chin has dropped so far (metres).
SINKS, SINKS_BY = 0.4, 14 * MM


def value_of(frame: Floats, number: int) -> float:
    """A FAP of a frame (68,), 0 where silent."""
    value = float(frame[number - 1])
    return 0.0 if np.isnan(value) else value


@dataclass(frozen=True)
class Eyeball:
    """One eyeball: turns about its centre, comes forward, widens its pupil.

    Attributes
    ----------
    index : (k,) mesh vertices. positions : (k, 3) at rest, head space. centre : (3,). gaze : (3,) unit axis at rest.
    pupil : angle from the axis to the neutral pupil's edge, rad. iris : the same to the iris' edge.
    faps : numbers of yaw, pitch, thrust, dilate for this side.
    units : metres of head space per unit of thrust and of dilation.
    """

    index: Ints
    positions: Floats
    centre: Floats
    gaze: Floats
    pupil: float
    iris: float
    faps: tuple[int, int, int, int]
    units: tuple[float, float]

    @property
    def side(self) -> str:
        """Whose it is: "l" or "r"."""
        return "l" if self.faps[0] == 23 else "r"

    def displacement(self, frame: Floats) -> Floats:
        """(k, 3) displacement in head space for a frame (68,) in FAP units."""
        yaw, pitch, thrust, dilate = (value_of(frame, number) for number in self.faps)
        away = self._dilated(dilate * self.units[1] / 2.0)
        turn = Rotation.from_euler("yx", [yaw * ANGLE_UNIT, pitch * ANGLE_UNIT])
        moved: Floats = turn.apply(away) + self.centre - self.positions
        moved[:, 2] += thrust * self.units[0]
        return moved

    def look(self, frame: Floats) -> Look:
        """Where the eyeball is and looks for a frame (68,) in FAP units."""
        yaw, pitch, thrust = (value_of(frame, number) for number in self.faps[:3])
        turn = Rotation.from_euler("yx", [yaw * ANGLE_UNIT, pitch * ANGLE_UNIT])
        return Look(self.centre + np.array([0.0, 0.0, thrust * self.units[0]]), turn.apply(self.gaze))

    def _dilated(self, growth: float) -> Floats:
        """Vertices from the centre (k, 3) with the pupil's edge moved out by a growth in metres, along the ball."""
        away: Floats = self.positions - self.centre
        if growth == 0.0:
            return away
        distance = np.linalg.norm(away, axis=1)
        angle = np.arccos(np.clip(away @ self.gaze / np.maximum(distance, 1e-9), -1.0, 1.0))
        radius = float(np.median(distance))
        share = 1.0 - smoothstep((angle - self.pupil) / max(self.iris - self.pupil, 1e-6))
        wider = angle * (1.0 + max(growth / radius / self.pupil, -0.9) * share)
        side = away - (away @ self.gaze)[:, None] * self.gaze
        side /= np.maximum(np.linalg.norm(side, axis=1, keepdims=True), 1e-12)
        wide: Floats = distance[:, None] * (np.cos(wider)[:, None] * self.gaze + np.sin(wider)[:, None] * side)
        return wide

    def measure(self, positions: Floats) -> dict[int, float]:
        """FAP number -> value read off deformed vertices (k, 3) in head space."""
        away, now = self.positions - self.centre, positions - self.centre
        body = (away @ self.gaze) < np.cos(self.iris) * np.linalg.norm(away, axis=1)
        if body.sum() < 4:
            body = np.ones(len(away), dtype=bool)
        turn, _ = Rotation.align_vectors(now[body] - now[body].mean(axis=0), away[body] - away[body].mean(axis=0))
        centre_shift = now[body].mean(axis=0) - turn.apply(away[body].mean(axis=0))
        yaw, pitch, _ = turn.as_euler("yxz")
        values = {
            self.faps[0]: yaw / ANGLE_UNIT,
            self.faps[1]: pitch / ANGLE_UNIT,
            self.faps[2]: float(centre_shift[2]) / self.units[0],
        }
        dilation = self._read_dilation(turn.inv().apply(now - centre_shift))
        if dilation is not None:
            values[self.faps[3]] = dilation
        return values

    def _read_dilation(self, unturned: Floats) -> float | None:
        """Growth of the pupil in FAP units from vertices turned back (k, 3); None where the pupil has no vertices."""
        away = self.positions - self.centre
        angle = np.arccos(np.clip(away @ self.gaze / np.linalg.norm(away, axis=1), -1.0, 1.0))
        pupil = (angle > 0.05 * self.pupil) & (angle <= 1.02 * self.pupil)
        if not pupil.any():
            return None
        now = np.arccos(np.clip(unturned @ self.gaze / np.linalg.norm(unturned, axis=1), -1.0, 1.0))
        growth = float(np.mean(now[pupil] / angle[pupil])) - 1.0
        radius = float(np.median(np.linalg.norm(away, axis=1)))
        return 2.0 * growth * self.pupil * radius / self.units[1]


@dataclass(frozen=True)
class Tongue:
    """The tongue: tip and body move, borders roll up; its root stays with the mandible.

    Attributes
    ----------
    index : (k,) mesh vertices. positions : (k, 3) at rest, head space.
    tip, body : (k,) weights of the tip's and the body's motion.
    units : metres of head space per unit of MW and MNS.
    """

    index: Ints
    positions: Floats
    tip: Floats
    body: Floats
    units: tuple[float, float]

    def displacement(self, frame: Floats) -> Floats:
        """(k, 3) displacement in head space for FAPs 43-47 of a frame (68,)."""
        wide, high = self.units
        right, up, forward, raised, roll = (value_of(frame, number) for number in range(43, 48))
        moved: Floats = np.zeros_like(self.positions)
        moved[:, 0] = -self.tip * right * wide
        moved[:, 1] = self.tip * up * high + self.body * raised * high
        moved[:, 2] = self.tip * forward * wide
        moved += self._rolled(roll * ANGLE_UNIT) * (self.tip + self.body)[:, None]
        return moved

    def sunk(self, opening: float, frame: Floats) -> Floats:
        """(k, 3) displacement in head space by which a tongue of which nothing is asked lies down as the jaw opens.

        A tongue at rest fills the closed mouth up to the palate; carried down like a stone it would plug the open one.
        `opening` is how far the chin has dropped, metres.
        """
        moved: Floats = np.zeros_like(self.positions)
        if np.isnan(frame[TONGUE]).all():
            height = self.positions[:, 1] - self.positions[:, 1].min()
            moved[:, 1] = -SINKS * float(smoothstep(np.array(opening / SINKS_BY))) * height
        return moved

    def _rolled(self, angle: float) -> Floats:
        """(k, 3) displacement that lifts both borders by turning each half about the midline."""
        middle = float(self.positions[:, 0].mean())
        aside = np.abs(self.positions[:, 0] - middle)
        turned = np.zeros_like(self.positions)
        turned[:, 0] = np.sign(self.positions[:, 0] - middle) * aside * (np.cos(angle) - 1.0)
        turned[:, 1] = aside * np.sin(angle)
        return turned


def build_tongue(
    index: Ints, positions: Floats, units: tuple[float, float], tip: Floats | None = None, body: Floats | None = None
) -> Tongue:
    """The tongue of a face from its vertices (k, 3) and the points 6.1 `tip` and 6.2 `body` (3,) in head space.

    The tip's weight is 0 at the body's point and the body's is 0 at the tip's, so that each FAP moves its own point.
    """
    front = positions[:, 2]
    start, length = float(front.min()), max(float(np.ptp(front)), 1e-6)
    along = (front - start) / length
    ends = 1.0 if tip is None else float(tip[2] - start) / length
    middle = 0.5 if body is None else float(body[2] - start) / length
    if ends - middle < 0.1:
        ends, middle = 1.0, 0.5
    foremost = smoothstep((along - middle) / (ends - middle))
    rise = np.exp(-(((along - middle) / 0.25) ** 2)) * (1.0 - foremost)
    return Tongue(index=index, positions=positions, tip=foremost, body=rise, units=units)


@dataclass(frozen=True)
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

    def apply(self, positions: Floats, frame: Floats) -> Floats:
        """Positions (V, 3) with FAPs 48 (down), 49 (left) and 50 (right shoulder) of a frame (68,) applied."""
        pitch, yaw, roll = (value_of(frame, number) * ANGLE_UNIT for number in (48, 49, 50))
        if pitch == yaw == roll == 0.0:
            return positions
        vector = Rotation.from_euler("yxz", [yaw, pitch, roll]).as_rotvec()
        turn = Rotation.from_rotvec(self.weights[:, None] * vector)
        turned: Floats = turn.apply(positions - self.pivot) + self.pivot
        return turned

    def undo(self, positions: Floats, rest: Floats) -> tuple[Floats, dict[int, float]]:
        """Positions (V, 3) with the head's turn taken out, and FAPs 48-50; unchanged where the mesh shows no skull."""
        if len(self.skull) < 4:
            return positions, {}
        turn, shift = self._rigid_motion(rest[self.skull], positions[self.skull])
        vector = turn.as_rotvec()
        undo = Rotation.from_rotvec(-self.weights[:, None] * vector)
        back = undo.apply(positions - self.pivot - self.weights[:, None] * shift) + self.pivot
        yaw, pitch, roll = turn.as_euler("yxz")
        return back, {48: pitch / ANGLE_UNIT, 49: yaw / ANGLE_UNIT, 50: roll / ANGLE_UNIT}

    def _rigid_motion(self, source: Floats, target: Floats) -> tuple[Rotation, Floats]:
        """Rotation about the pivot and shift (3,) that most skull vertices agree on (iteratively reweighted)."""
        weights = np.ones(len(source))
        for _ in range(SKULL_ROUNDS):
            middle, moved = np.average(source, axis=0, weights=weights), np.average(target, axis=0, weights=weights)
            turn, _ = Rotation.align_vectors(target - moved, source - middle, weights=weights)
            shift = moved - (turn.apply(middle - self.pivot) + self.pivot)
            off = np.linalg.norm(turn.apply(source - self.pivot) + self.pivot + shift - target, axis=1)
            weights = 1.0 / (off + SKULL_TOLERANCE)
        return turn, shift


def build_head_turn(positions: Floats, pivot: Floats, brow_height: float) -> HeadTurn:
    """The head's turn on a mesh (V, 3) in head space; a head without a neck turns as a whole."""
    low = float(positions[:, 1].min())
    y = positions[:, 1]
    weights = np.ones(len(positions)) if low > -105 * MM else smoothstep((y + 150 * MM) / (70 * MM))
    skull = np.flatnonzero((y > brow_height + 45 * MM) | ((positions[:, 2] < -100 * MM) & (y > -10 * MM)))
    return HeadTurn(pivot=pivot, weights=weights, skull=skull)
