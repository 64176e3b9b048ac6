"""The face in motion: plans become postures, which skin and mandible follow, and all else follows these.

Folds belong to the shape that the skin has, not to the one that is asked for.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from ..arrays import Floats
from ..errors import ParameterError, SolverError
from ..physics.tissue import Tissue
from .drive.plan import Plan
from .motion import FaceMotion, MovingFace, Setpoint
from .pose import Poser


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
        integrator, substeps, tissue : as for `FaceMotion`.

        Raises
        ------
        ParameterError : names the parameter and its rule.
        SolverError : a mesh that the integrator cannot follow.
        """
        if not (np.isfinite(fps) and fps > 0):
            raise ParameterError("fps", "must be above 0", fps)
        self.poser = poser
        self.motion = FaceMotion(poser.anatomy, 1.0 / fps, integrator=integrator, substeps=substeps, tissue=tissue)

    def run(self, plans: Iterable[Plan]) -> Iterator[Floats]:
        """Positions (V, 3) in the face's coordinates, one array per plan; the first is at rest in its pose.

        Raises
        ------
        SolverError : names the step whose motion was not solved.
        """
        moving: MovingFace | None = None
        before: Setpoint | None = None
        for step, plan in enumerate(plans):
            setpoint = Setpoint.of(self.poser.balance.posture(plan), self.poser.anatomy.contact)
            if moving is None or before is None:
                moving = self.motion.at_rest(setpoint)
            else:
                try:
                    moving = self.motion.follow(moving, before, setpoint)
                except SolverError as error:
                    raise SolverError(f"the motion could not be solved: {error}", frame=step) from error
            before = setpoint
            yield self.poser.assembly.positions(self.motion.displacement(moving), moving.jaw_motion, plan.request)
