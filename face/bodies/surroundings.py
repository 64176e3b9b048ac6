"""What the skin of a posed or moving face may meet: where mandible and eyeballs are."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Protocol

import numpy as np
from scipy.spatial.transform import Rotation

from ...arrays import Floats, Ints
from ..mechanisms.jaw import JawMotion


@dataclass(frozen=True, eq=False)
class Look:
    """Where one eyeball is and looks: centre (3,) in head space, gaze (3,) a unit vector."""

    centre: Floats
    gaze: Floats

    @cached_property
    def axes(self) -> Floats:
        """(3, 3) columns: two axes across the gaze, the way head space's x and y are carried there, and the gaze."""
        turn = np.cross([0.0, 0.0, 1.0], self.gaze)
        sine = float(np.linalg.norm(turn))
        if sine < 1e-12:
            return np.eye(3)
        return np.asarray(Rotation.from_rotvec(turn / sine * np.arctan2(sine, self.gaze[2])).as_matrix())


@dataclass(frozen=True)
class Surroundings:
    """The bones and eyeballs of one moment; eyeballs that are not named are as at rest."""

    jaw: JawMotion = field(default_factory=JawMotion)
    looks: Mapping[str, Look] = field(default_factory=dict)


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
        """How deep each lies in the body beyond rest (k,), metres, negative outside; and its way out (k, 3)."""
