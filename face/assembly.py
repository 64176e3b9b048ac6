"""From the outer skin and the mandible to all vertices: what follows the skin, and what FAPs move directly."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from functools import cached_property

import numpy as np

from ..arrays import Floats, Ints
from ..errors import SolverError
from ..physics.mesh import applied
from .anatomy import Anatomy
from .drive.drives import DRIVES
from .drive.request import Request
from .mechanism import Mechanism
from .mechanisms.jaw import JawMotion
from .response.folds import Folds

#: Frames are worked out together as long as they have no more figures than this, so that none takes long to come.
TOGETHER = 4_000_000


def check_finite(moved: Floats, frames: Sequence[int] | Ints | None = None) -> None:
    """Refuse displacements or positions (n, 3), or (T, n, 3) of frames, that are no numbers: nothing is made of them.

    Raises
    ------
    SolverError : names the first of the frames.
    """
    if np.isfinite(moved).all():
        return
    frame = None if frames is None else int(frames[int(np.isfinite(moved).all(axis=(1, 2)).argmin())])
    raise SolverError("the skin's balance is beyond all numbers: lower the forces", frame=frame, residual=math.inf)


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
        mandible = np.array([[jaw.angle, jaw.left, jaw.forward]])
        return next(self.positions_each(displacement[None], mandible, [request]))

    def positions_each(self, displacements: Floats, jaws: Floats, requests: Sequence[Request]) -> Iterator[Floats]:
        """As `positions`, one after the other, of displacements (T, n, 3), mandibles (T, 3) and requests of a drive."""
        count = max(1, TOGETHER // self.anatomy.mesh.positions.size)
        for first in range(0, len(requests), count):
            some = slice(first, first + count)
            yield from self._positions_together(displacements[some], jaws[some], requests[some])

    def _positions_together(self, displacements: Floats, jaws: Floats, requests: Sequence[Request]) -> Iterator[Floats]:
        """As `positions_each`, worked out all at once."""
        anatomy = self.anatomy
        rest, seams = anatomy.mesh.positions, anatomy.mesh.seams
        moved = np.zeros((len(requests), *rest.shape))
        moved[:, anatomy.given_skin.index] = self._folded(displacements, requests[0])
        anatomy.inner_skin.follow(moved)
        moved[:, anatomy.jaw_parts] = anatomy.jaw.rigid(rest[anatomy.jaw_parts], jaws)
        if anatomy.tongue is not None:
            for each, jaw, request in zip(moved, jaws, requests, strict=True):
                opening, faps = jaw[0] * anatomy.actuators.chin_lever, request.faps
                each[anatomy.tongue.index] += anatomy.tongue.displacement(faps) + anatomy.tongue.sunk(opening, faps)
        anatomy.rooted_parts.follow(moved)
        for each, request in zip(moved, requests, strict=True):
            for ball in anatomy.eyeballs:
                each[ball.index] = ball.displacement(request.faps)
            each[seams.copies] = each[seams.leads[seams.copies]]
            yield anatomy.mesh.head_frame.to_face(anatomy.head_turn.apply(rest + each, request.faps))

    def _folded(self, displacements: Floats, request: Request) -> Floats:
        """(T, g, 3) displacements of the outer skin's own vertices, with folds where the drive has them."""
        own = applied(self.anatomy.carry, displacements)
        if self.with_folds and DRIVES[request.drive].folds:
            own += self.folds.displacement(own)
        return own
