"""Eyeballs: what FAPs 23 to 30 turn, push and widen, and how those FAPs are read back."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from ...arrays import Floats, Ints
from ...mpeg4 import ANGLE_UNIT
from ..figures import Length, Share, read_figures
from ..mechanisms.lids import Eye
from ..mesh.head_frame import rotation_between
from ..skin.outer import smoothstep
from .direct_faps import value_of
from .surroundings import Look


@dataclass(frozen=True, eq=False)
class EyeballPlace:
    """An eyeball at rest, in the face's coordinates.

    Attributes
    ----------
    vertices : (k,) its vertices of the mesh. centre : (3,) about which it turns. gaze : (3,) where it looks, length 1.
    iris, pupil : angles from the gaze to their edges, rad.
    """

    vertices: Ints
    centre: Floats
    gaze: Floats
    iris: float
    pupil: float


@dataclass(frozen=True)
class EyeballFigures:
    """Of any eyeball (presets/anatomy/bodies.toml)."""

    clearance: Length
    pupil: Share


EYEBALL = read_figures("bodies.eyeball", EyeballFigures)

#: An iris is taken for no wider than this share of its eyeball, whatever the lids' gap says.
WIDEST_IRIS = 0.9

#: A pupil shrinks to no less than this share of its neutral size.
NARROWEST = 0.1

#: Vertices between these shares of the neutral pupil's angle tell how wide it is: not its pole, its edge still.
ON_PUPIL = (0.05, 1.02)


@dataclass(frozen=True, eq=False)
class Eyeball:
    """One eyeball: turns about its centre, comes forward, widens its pupil.

    Attributes
    ----------
    index : (k,) mesh vertices. positions : (k, 3) at rest, head space. centre : (3,). gaze : (3,) unit axis at rest.
    pupil : angle from the axis to the neutral pupil's edge, rad. iris : the same to the iris' edge.
    fap_numbers : of yaw, pitch, thrust, dilate for this side.
    units : metres of head space per unit of thrust and of dilation.
    """

    index: Ints
    positions: Floats
    centre: Floats
    gaze: Floats
    pupil: float
    iris: float
    fap_numbers: tuple[int, int, int, int]
    units: tuple[float, float]

    @property
    def side(self) -> str:
        """Whose it is: "l" or "r"."""
        return "l" if self.fap_numbers[0] == 23 else "r"

    def displacement(self, faps: Floats) -> Floats:
        """(k, 3) displacement in head space for FAPs (68,) in FAP units."""
        yaw, pitch, thrust, dilate = asked = tuple(value_of(faps, number) for number in self.fap_numbers)
        if not any(asked):
            return np.zeros_like(self.positions)
        away = self._dilated(dilate * self.units[1] / 2.0)
        turn = Rotation.from_euler("yx", [yaw * ANGLE_UNIT, pitch * ANGLE_UNIT])
        moved: Floats = turn.apply(away) + self.centre - self.positions
        moved[:, 2] += thrust * self.units[0]
        return moved

    def look(self, faps: Floats) -> Look:
        """Where the eyeball is and looks for FAPs (68,) in FAP units."""
        yaw, pitch, thrust = (value_of(faps, number) for number in self.fap_numbers[:3])
        if not (yaw or pitch or thrust):
            return Look(self.centre, self.gaze)
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
        wider = angle * (1.0 + max(growth / radius / self.pupil, NARROWEST - 1.0) * share)
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
        turned = rotation_between(away[body] - away[body].mean(axis=0), now[body] - now[body].mean(axis=0))
        turn = Rotation.from_matrix(turned)
        centre_shift = now[body].mean(axis=0) - turn.apply(away[body].mean(axis=0))
        yaw, pitch, _ = turn.as_euler("yxz")
        values = {
            self.fap_numbers[0]: yaw / ANGLE_UNIT,
            self.fap_numbers[1]: pitch / ANGLE_UNIT,
            self.fap_numbers[2]: float(centre_shift[2]) / self.units[0],
        }
        dilation = self._read_dilation(turn.inv().apply(now - centre_shift))
        if dilation is not None:
            values[self.fap_numbers[3]] = dilation
        return values

    def _read_dilation(self, unturned: Floats) -> float | None:
        """Growth of the pupil in FAP units from vertices turned back (k, 3); None where the pupil has no vertices."""
        away = self.positions - self.centre
        angle = np.arccos(np.clip(away @ self.gaze / np.linalg.norm(away, axis=1), -1.0, 1.0))
        pupil = (angle > ON_PUPIL[0] * self.pupil) & (angle <= ON_PUPIL[1] * self.pupil)
        if not pupil.any():
            return None
        now = np.arccos(np.clip(unturned @ self.gaze / np.linalg.norm(unturned, axis=1), -1.0, 1.0))
        growth = float(np.mean(now[pupil] / angle[pupil])) - 1.0
        radius = float(np.median(np.linalg.norm(away, axis=1)))
        return 2.0 * growth * self.pupil * radius / self.units[1]


def build_eyeball(
    eye: Eye,
    index: Ints,
    positions: Floats,
    pupil: Floats,
    iris_radius: float,
    fap_numbers: tuple[int, int, int, int],
    units: tuple[float, float],
) -> Eyeball:
    """An eyeball from its vertices (k,), (k, 3), the pupil's middle (3,) and the iris' radius, all in head space."""
    gaze = pupil - eye.centre
    gaze = gaze / np.linalg.norm(gaze)
    iris = float(np.arcsin(min(iris_radius / eye.radius, WIDEST_IRIS)))
    return Eyeball(index, positions, eye.centre, gaze, iris * EYEBALL.pupil, iris, fap_numbers, units)
