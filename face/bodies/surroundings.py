"""What the skin of a posed or moving face may meet: where mandible and eyeballs are."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Protocol

import numpy as np

from ...arrays import Floats, Ints
from ..mechanisms.jaw import JawMotion


@dataclass(frozen=True, eq=False)
class Look:
    """Where one eyeball is and looks: centre (..., 3) in head space, gaze (..., 3) a unit vector."""

    centre: Floats
    gaze: Floats

    @cached_property
    def axes(self) -> Floats:
        """(..., 3, 3) columns: two across the gaze, the way head space's x and y are carried there, and the gaze."""
        x, y, z = np.moveaxis(self.gaze, -1, 0)
        share = 1.0 / np.maximum(1.0 + z, 1e-12)
        columns = [[1.0 - share * x * x, -share * x * y, -x], [-share * x * y, 1.0 - share * y * y, -y], [x, y, z]]
        return np.stack([np.stack(column, axis=-1) for column in columns], axis=-1)


@dataclass(frozen=True, eq=False)
class Surroundings:
    """The bones and eyeballs of one moment, or of T of them; eyeballs that are not named are as at rest.

    Attributes
    ----------
    jaw : the mandible; of T moments (T, 3) its angle and slides.
    looks : side -> where that eyeball is and looks; of T moments (T, 3) each.
    """

    jaw: JawMotion | Floats = field(default_factory=JawMotion)
    looks: Mapping[str, Look] = field(default_factory=dict)

    @classmethod
    def over(cls, jaws: Floats, looks: Sequence[Mapping[str, Look]]) -> Surroundings:
        """Those of T moments: mandibles (T, 3), and looks that name the same eyeballs at each."""
        together = {
            side: Look(np.array([each[side].centre for each in looks]), np.array([each[side].gaze for each in looks]))
            for side in looks[0]
        }
        return cls(jaws, together)

    def each(self, count: int) -> Surroundings:
        """Those of so many moments: themselves where they are, or the one moment again and again."""
        if not isinstance(self.jaw, JawMotion):
            return self
        jaw = np.tile([self.jaw.angle, self.jaw.left, self.jaw.forward], (count, 1))
        return Surroundings.over(jaw, [self.looks] * count)

    def some(self, moments: Ints) -> Surroundings:
        """Those of some moments among T."""
        jaw = self.jaw if isinstance(self.jaw, JawMotion) else self.jaw[moments]
        return Surroundings(jaw, {s: Look(look.centre[moments], look.gaze[moments]) for s, look in self.looks.items()})


class Body(Protocol):
    """Something solid that skin must stay out of.

    Attributes
    ----------
    index : (k,) vertices of the outer skin that are kept out.
    firmness : (k,) share of the way out that each is moved, 0..1, fading to nothing away from lips or lids.
    """

    @property
    def index(self) -> Ints:
        """Vertices of the outer skin that are kept out."""

    @property
    def firmness(self) -> Floats:
        """Share of the way out that each is moved."""

    def depths(self, positions: Floats, at: Surroundings) -> tuple[Floats, Floats]:
        """How deep each lies in the body beyond rest (..., k), metres; and its way out (..., k, 3) where that is deep.

        Negative outside, and there an upper bound.
        """
