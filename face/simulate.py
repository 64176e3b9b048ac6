"""The face in motion: plans become postures, which skin and mandible follow, and all else follows these.

Folds belong to the shape that the skin has, not to the one that is asked for.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from ..arrays import Floats
from ..errors import ParameterError, SolverError
from ..mpeg4 import check_fps
from ..physics.tissue import Tissue
from ..progress import Prepared, Work
from .assembly import check_finite
from .clip_balance import clip_balance
from .drive.plan import Plan
from .drive.request import Request
from .motion import FaceMotion, MovingFace, Setpoint, Stepping
from .pose import Poser
from .reduced_motion import ReducedMotion


class Integrator(StrEnum):
    """How the equation of motion is integrated.

    reduced : in a few displacement fields about the balance, the production way. implicit, rk2 : of every node, by two
    backward-Euler stages or by the paper's second-order Runge-Kutta; for reference. balance : every step in balance,
    for motion that was made as it is to be seen and has an inertia of its own.
    """

    REDUCED = "reduced"
    BALANCE = "balance"
    IMPLICIT = "implicit"
    RK2 = "rk2"


@dataclass(frozen=True, eq=False)
class Clip:
    """A simulated clip: positions (T, V, 3) in the face's coordinates, frames per second."""

    positions: Floats
    fps: float


class Simulation:
    """The moving skin of one face."""

    def __init__(self, poser: Poser, *, fps: float, integrator: str, substeps: int, tissue: str | Tissue) -> None:
        """Prepare a simulation.

        Parameters
        ----------
        poser : poses the same face.
        fps : steps per second, above 0.
        integrator : a name of `Integrator`. substeps, tissue : as for `FaceMotion`.

        Raises
        ------
        ParameterError : names the parameter and its rule.
        SolverError : a mesh that the integrator cannot follow.
        """
        check_fps(fps)
        if integrator not in list(Integrator):
            raise ParameterError("integrator", f"must be one of {', '.join(Integrator)}", integrator)
        self.poser = poser
        self.motion: ReducedMotion | FaceMotion | None = None
        if integrator == Integrator.REDUCED:
            self.motion = ReducedMotion(poser.balance, 1.0 / fps, substeps=substeps, tissue=tissue)
        elif integrator != Integrator.BALANCE:
            stepping = Stepping(integrator)
            self.motion = FaceMotion(poser.anatomy, 1.0 / fps, stepping=stepping, substeps=substeps, tissue=tissue)

    def run(self, plans: Iterable[Plan]) -> Prepared[Floats]:
        """Positions in the face's coordinates, one array per plan; the first is at rest in its pose.

        Raises
        ------
        SolverError : names the step whose motion was not solved, where one step was solved after the other.
        """
        if self.motion is None:
            return Prepared(self._balanced(list(plans)))
        if isinstance(self.motion, ReducedMotion):
            return Prepared(self._reduced(self.motion, list(plans)))
        return Prepared.at_once(self._followed(self.motion, plans))

    def _reduced(self, motion: ReducedMotion, plans: list[Plan]) -> Work[Iterator[Floats]]:
        """Frames of a clip that is known as a whole."""
        course = yield from motion.course(plans)
        return self._together(motion.along(course), [plan.request for plan in plans])

    def _balanced(self, plans: list[Plan]) -> Work[Iterator[Floats]]:
        """Frames of a clip that is known as a whole, each in balance."""
        clip = yield from clip_balance(self.poser.balance, plans)
        shown = ((postures.displacements, np.asarray(postures.surroundings.jaw)) for _, postures in clip.along())
        return self._together(shown, [plan.request for plan in plans])

    def _together(self, moved: Iterator[tuple[Floats, Floats]], requests: Sequence[Request]) -> Iterator[Floats]:
        """Frames of displacements (s, n, 3) and mandibles (s, 3), some at a time."""
        done = 0
        for displacements, jaws in moved:
            some = requests[done : done + len(jaws)]
            check_finite(displacements, range(done, done + len(some)))
            for positions in self.poser.assembly.positions_each(displacements, jaws, some):
                check_finite(positions[None], [done])
                yield positions
                done += 1

    def _followed(self, motion: FaceMotion, plans: Iterable[Plan]) -> Iterator[Floats]:
        """Frames one after the other."""
        moving: MovingFace | None = None
        before: Setpoint | None = None
        for step, plan in enumerate(plans):
            try:
                setpoint = Setpoint.of(self.poser.balance.posture(plan), self.poser.anatomy.contact)
                if moving is None or before is None:
                    moving = motion.at_rest(setpoint)
                else:
                    moving = motion.follow(moving, before, setpoint)
            except SolverError as error:
                raise error.in_frame(step) from error
            before = setpoint
            displacement = motion.displacement(moving)
            check_finite(displacement[None], [step])
            positions = self.poser.assembly.positions(displacement, moving.jaw_motion, plan.request)
            check_finite(positions[None], [step])
            yield positions
