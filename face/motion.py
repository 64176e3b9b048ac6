"""The skin and mandible of a face in motion: how they follow the postures that are asked for, one after the other.

At every step the muscles bear the load that would hold the step's own posture in equilibrium; the mandible follows as a
damped oscillator, and the skin, carried by jaw and lids, by Lagrangian dynamics (Zhang, Sung, Prakash 2001, equation
(23)), held off eyeballs, teeth and itself after every substep. A posture that is held is therefore reached exactly, and
what lies between is physics.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from ..arrays import Floats
from ..errors import ParameterError
from ..physics.implicit import ImplicitSolver
from ..physics.rk2 import Rk2Solver
from ..physics.skin import State
from ..physics.tissue import Tissue
from .anatomy import Anatomy
from .bodies.contact import Contact, Slack
from .bodies.surroundings import Look, Surroundings
from .jaw_follower import JawFollower, jaw_motion, resting
from .mechanisms.jaw import JawMotion
from .mechanisms.lid_movers import LidMove
from .posture import Posture
from .response.actuators import Amounts
from .response.spring_skin import spring_skin


class Stepping(StrEnum):
    """How every node is taken on: by backward Euler, or by the paper's second-order Runge-Kutta."""

    IMPLICIT = "implicit"
    RK2 = "rk2"


@dataclass(frozen=True, eq=False)
class Setpoint:
    """A posture as what moves follows it: taken apart so that the way from one to the next can be taken in part.

    Attributes
    ----------
    lids : the amounts of lid moves. jaw : (3,) the mandible's angle, slide to the left and forward.
    elastic : (n, 3) what muscles and elastic correction add to what jaw and lids carry, metres.
    pushed : (n, 3) what contact adds, metres.
    slack : how far the posture itself passes contact. lip_share : the upper lip's part of giving way.
    looks : where each eyeball looks.
    """

    lids: Mapping[tuple[str, LidMove], float]
    jaw: Floats
    elastic: Floats
    pushed: Floats
    slack: Slack
    lip_share: float
    looks: Mapping[str, Look]

    @classmethod
    def of(cls, posture: Posture, contact: Contact) -> Setpoint:
        """A posture taken apart."""
        jaw, at = posture.amounts.jaw, posture.surroundings
        return cls(
            lids=posture.amounts.lids,
            jaw=np.array([jaw.angle, jaw.left, jaw.forward]),
            elastic=posture.elastic,
            pushed=posture.pushed,
            slack=contact.slack(posture.displacement, at),
            lip_share=posture.lip_share,
            looks=at.looks,
        )

    def towards(self, other: Setpoint, share: float) -> Setpoint:
        """Part of the way (0..1) to another; eyeballs are there at once."""
        rest = 1.0 - share
        return Setpoint(
            lids={move: rest * amount + share * other.lids[move] for move, amount in self.lids.items()},
            jaw=rest * self.jaw + share * other.jaw,
            elastic=rest * self.elastic + share * other.elastic,
            pushed=rest * self.pushed + share * other.pushed,
            slack=self.slack.towards(other.slack, share),
            lip_share=rest * self.lip_share + share * other.lip_share,
            looks=other.looks,
        )


@dataclass(frozen=True, eq=False)
class MovingFace:
    """The moving skin in head space, and the mandible (2, 3): its angle and slides, and their rates."""

    skin: State
    jaw: Floats

    @property
    def jaw_motion(self) -> JawMotion:
        """Where the mandible is."""
        return jaw_motion(self.jaw[0])


class FaceMotion:
    """Takes one face from setpoint to setpoint."""

    def __init__(
        self, anatomy: Anatomy, duration: float, *, stepping: Stepping, substeps: int, tissue: str | Tissue
    ) -> None:
        """Prepare for steps of one length.

        Parameters
        ----------
        anatomy : of the face. duration : of a step from setpoint to setpoint, seconds.
        stepping : how nodes are taken on. substeps : in each step, 1 or more; contact is seen to after each.
        tissue : a name in presets/tissue.toml, or figures of its own.

        Raises
        ------
        ParameterError : names the parameter and its rule.
        SolverError : a mesh that the integrator cannot follow.
        """
        if substeps < 1:
            raise ParameterError("substeps", "must be 1 or more", substeps)
        self.anatomy = anatomy
        self.skin = spring_skin(anatomy.skin, tissue)
        self.substeps = substeps
        self.length = duration / substeps
        solver = ImplicitSolver if stepping is Stepping.IMPLICIT else Rk2Solver
        self.solver: ImplicitSolver | Rk2Solver = solver(self.skin, self.length)
        self.jaw = JawFollower(tissue, self.length)

    def at_rest(self, setpoint: Setpoint) -> MovingFace:
        """The face at rest where a setpoint has it."""
        positions = self._anchors(setpoint, setpoint.jaw) + setpoint.elastic
        return MovingFace(State.at_rest(positions), resting(setpoint.jaw))

    def follow(self, face: MovingFace, before: Setpoint, after: Setpoint) -> MovingFace:
        """The face one step on, its setpoint changing evenly from one to the other.

        Raises
        ------
        SolverError : a substep that was not solved.
        """
        for number in range(self.substeps):
            start, midway, end = (before.towards(after, (number + part) / self.substeps) for part in (0.0, 0.5, 1.0))
            face = self._substep(face, start, midway, end)
        return face

    def displacement(self, face: MovingFace) -> Floats:
        """(n, 3) of the outer skin, head space, metres."""
        return face.skin.positions - self.skin.rest

    def _substep(self, face: MovingFace, start: Setpoint, midway: Setpoint, end: Setpoint) -> MovingFace:
        """The face one substep on; forces are taken midway."""
        jaw = self.jaw.swung(face.jaw, start.jaw, end.jaw)
        anchors = self._anchors(midway, 0.5 * (face.jaw[0] + jaw[0]))
        load = -self.skin.force(anchors + midway.elastic, anchors)
        skin = self.solver.step(face.skin, load, anchors)
        at = Surroundings(jaw_motion(jaw[0]), end.looks)
        return MovingFace(self.anatomy.contact.hold(skin, end.lip_share, at, end.slack, self.length), jaw)

    def _anchors(self, setpoint: Setpoint, jaw: Floats) -> Floats:
        """(n, 3) where a jaw (3,), lids and contact would carry skin that no muscle pulls."""
        carried = self.anatomy.actuators.carried(Amounts(np.zeros(0), setpoint.lids, jaw_motion(jaw)))
        return np.asarray(self.skin.rest + carried + setpoint.pushed)
