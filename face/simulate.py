"""The face in motion: the skin's inertia, damping and biphasic springs between the poses that FAPs ask for.

At every frame the muscles bear the load that would hold the frame's own pose in equilibrium; the skin, carried by
jaw and lids, follows it by Lagrangian dynamics (Zhang, Sung, Prakash 2001, equation (23)). A held frame is therefore
reached exactly, and what lies between is physics.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from ..arrays import Floats
from ..errors import ParameterError, SolverError
from ..mpeg4 import ARCHETYPES, Cue, sequence, strengths
from ..physics.implicit import ImplicitSolver
from ..physics.rk2 import Rk2Solver
from ..physics.skin import State
from .living_skin import living_skin
from .natural import Plan, blend
from .pose import Poser, SkinState
from .wishes import Drive


class Integrator(StrEnum):
    """How the equation of motion is integrated: backward Euler, or the paper's second-order Runge-Kutta."""

    IMPLICIT = "implicit"
    RK2 = "rk2"


@dataclass(frozen=True)
class Moment:
    """What is asked of one frame: FAPs (68,), how they drive the face, and the plan where the drive is natural."""

    frame: Floats
    drive: Drive
    plan: Plan | None


class Simulation:
    """The moving skin of one face."""

    def __init__(self, poser: Poser, *, fps: float, integrator: str, substeps: int, tissue: str) -> None:
        """Prepare a simulation.

        Parameters
        ----------
        poser : poses the same face.
        fps : frames per second, above 0.
        integrator : a name of `Integrator`. substeps : implicit steps per frame, 1 or more.
        tissue : a name in presets/tissue.toml.

        Raises
        ------
        ParameterError : names the parameter and its rule.
        """
        if not (np.isfinite(fps) and fps > 0):
            raise ParameterError("fps", "must be above 0", fps)
        if substeps < 1:
            raise ParameterError("substeps", "must be 1 or more", substeps)
        if integrator not in list(Integrator):
            raise ParameterError("integrator", f"must be one of {', '.join(Integrator)}", integrator)
        self.poser = poser
        self.skin = living_skin(poser.anatomy.skin, tissue)
        self.substeps = substeps if integrator == Integrator.IMPLICIT else 1
        step = 1.0 / fps / self.substeps
        solver = ImplicitSolver if integrator == Integrator.IMPLICIT else Rk2Solver
        self.solver: ImplicitSolver | Rk2Solver = solver(self.skin, step)

    def run(self, moments: Iterable[Moment]) -> Iterator[Floats]:
        """Positions (V, 3) in the face's coordinates, one array per moment; the first is at rest in its pose."""
        poser = self.poser
        state: State | None = None
        for number, moment in enumerate(moments):
            amounts = poser.amounts(moment.frame, moment.drive, moment.plan, None)
            target = poser.skin_state(moment.frame, moment.drive, moment.plan, amounts)
            wanted = self.skin.rest + target.displacement
            anchors = wanted - target.elastic
            if state is None:
                state = State.at_rest(wanted)
            else:
                load = -self.skin.force(wanted, anchors)
                try:
                    for _ in range(self.substeps):
                        state = self.solver.step(state, load, anchors)
                except SolverError as error:
                    raise SolverError(f"the face's motion was not solved: {error}", frame=number) from error
            yield poser.assemble(SkinState(state.positions - self.skin.rest, target.elastic, target.jaw), moment.frame)


def stream_moments(poser: Poser, frames: Floats, drive: Drive, weights: Floats | None) -> Iterator[Moment]:
    """Moments of a FAP stream (T, 68), each planned by itself; weights (T, 6) name the emotions where known."""
    for number, frame in enumerate(frames):
        emotion = None
        if weights is not None and (total := float(weights[number].sum())) > 0.0:
            emotion = {str(a): float(w) / total for a, w in zip(ARCHETYPES, weights[number], strict=True)}
        yield Moment(frame, drive, poser.natural.plan(frame, emotion) if drive is Drive.NATURAL else None)


def cue_moments(poser: Poser, cues: Sequence[Cue], fps: float, drive: Drive) -> Iterator[Moment]:
    """Moments of cues: each cue is planned once at its apex, and the plans are blended by the cues' strengths.

    So what a face adds by itself to one expression is not contradicted by FAPs that another cue asks for.
    """
    frames = sequence(cues, fps=fps)
    plans = [poser.natural.plan(cue.profile.frame(cue.seed), cue.profile.weights) for cue in cues]
    for frame, weights in zip(frames, strengths(cues, fps=fps), strict=True):
        plan = blend(plans, weights.tolist()) if drive is Drive.NATURAL else None
        yield Moment(frame, drive, plan)
