"""From the outer skin and the mandible to all vertices: what follows the skin, and what FAPs move directly."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from ..arrays import Floats
from .anatomy import Anatomy
from .drive.drives import DRIVES
from .drive.request import Request
from .mechanism import Mechanism
from .mechanisms.jaw import JawMotion
from .response.folds import Folds


class Assembly:
    """Puts one face together; with folds where the drive has them, unless told otherwise."""

    def __init__(self, anatomy: Anatomy, *, folds: bool = True) -> None:
        self.anatomy = anatomy
        self.with_folds = folds and Mechanism.FOLDS in anatomy.mechanisms

    @cached_property
    def folds(self) -> Folds:
        """Where the skin folds; no FAP's point moves with it."""
        return Folds(self.anatomy.given_skin, self.anatomy.warp, self.anatomy.points_on_given_skin)

    def positions(self, displacement: Floats, jaw: JawMotion, request: Request) -> Floats:
        """(V, 3) positions in the face's coordinates.

        Parameters
        ----------
        displacement : (n, 3) of the outer skin without its folds, head space, metres.
        jaw : where the mandible is.
        request : whose FAPs move eyeballs, tongue and head, and whose drive says whether skin folds.
        """
        anatomy, faps = self.anatomy, request.faps
        rest = anatomy.mesh.positions
        moved = np.zeros_like(rest)
        moved[anatomy.given_skin.index] = self._folded(displacement, request)
        anatomy.inner_skin.follow(moved)
        moved[anatomy.jaw_parts] = anatomy.jaw.rigid(rest[anatomy.jaw_parts], jaw)
        if anatomy.tongue is not None:
            opening = jaw.angle * anatomy.actuators.chin_lever
            moved[anatomy.tongue.index] += anatomy.tongue.displacement(faps) + anatomy.tongue.sunk(opening, faps)
        anatomy.rooted_parts.follow(moved)
        for ball in anatomy.eyeballs:
            moved[ball.index] = ball.displacement(faps)
        seams = anatomy.mesh.seams
        moved[seams.copies] = moved[seams.leads[seams.copies]]
        return anatomy.mesh.head_frame.to_face(anatomy.head_turn.apply(rest + moved, faps))

    def _folded(self, displacement: Floats, request: Request) -> Floats:
        """(g, 3) displacement of the outer skin's own vertices, with folds where the drive has them."""
        own = np.asarray(self.anatomy.carry @ displacement)
        if not (self.with_folds and DRIVES[request.drive].folds):
            return own
        return own + self.folds.displacement(own)
