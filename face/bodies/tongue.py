"""The tongue: what FAPs 43 to 47 move, and how it lies down in an open mouth."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arrays import Floats, Ints
from ...mpeg4 import ANGLE_UNIT
from ..figures import Length, Share, read_figures
from ..skin.outer import smoothstep
from .direct_faps import value_of

#: FAPs of the tongue, as places in a vector of all FAPs.
TONGUE = slice(42, 47)


@dataclass(frozen=True)
class TongueFigures:
    """How a tongue lies down, and how much of it its body is (presets/anatomy/bodies.toml)."""

    sinks: Share
    sinks_by: Length
    body: float


FIGURES = read_figures("bodies.tongue", TongueFigures)

#: Tip and body that are nearer to each other than this share of the tongue's length are taken for misplaced.
APART = 0.1


@dataclass(frozen=True, eq=False)
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

    def displacement(self, faps: Floats) -> Floats:
        """(k, 3) displacement in head space, as FAPs 43-47 of `faps` (68,) say."""
        wide, high = self.units
        right, up, forward, raised, roll = (value_of(faps, number) for number in range(43, 48))
        moved: Floats = np.zeros_like(self.positions)
        moved[:, 0] = -self.tip * right * wide
        moved[:, 1] = self.tip * up * high + self.body * raised * high
        moved[:, 2] = self.tip * forward * wide
        moved += self._rolled(roll * ANGLE_UNIT) * (self.tip + self.body)[:, None]
        return moved

    def sunk(self, opening: float, faps: Floats) -> Floats:
        """(k, 3) displacement in head space by which a tongue of which nothing is asked lies down as the jaw opens.

        A tongue at rest fills the closed mouth up to the palate; carried down like a stone it would plug the open one.
        `opening` is how far the chin has dropped, metres.
        """
        moved: Floats = np.zeros_like(self.positions)
        if np.isnan(faps[TONGUE]).all():
            height = self.positions[:, 1] - self.positions[:, 1].min()
            moved[:, 1] = -FIGURES.sinks * float(smoothstep(np.array(opening / FIGURES.sinks_by))) * height
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
    if ends - middle < APART:
        ends, middle = 1.0, 0.5
    foremost = smoothstep((along - middle) / (ends - middle))
    rise = np.exp(-(((along - middle) / FIGURES.body) ** 2)) * (1.0 - foremost)
    return Tongue(index=index, positions=positions, tip=foremost, body=rise, units=units)
