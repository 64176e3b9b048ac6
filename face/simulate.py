"""The face in motion: the skin's inertia, damping and biphasic springs between the poses that FAPs ask for.

At every frame the muscles bear the load that would hold the frame's own pose in equilibrium; the mandible follows as
a damped oscillator, and the skin, carried by jaw and lids, by Lagrangian dynamics (Zhang, Sung, Prakash 2001, equation
(23)), held off eyeballs, teeth and itself after every step. A held frame is therefore reached exactly, and what lies
between is physics. Folds belong to the shape that the skin has, not to the one that is asked for.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import TypeAlias

import numpy as np

from ..arrays import Floats
from ..errors import ParameterError, SolverError
from ..mpeg4 import ARCHETYPES, FAP_COUNT, Cue, Liveliness, Overlay, sequence, strengths
from ..physics.implicit import ImplicitSolver
from ..physics.rk2 import Rk2Solver
from ..physics.skin import State
from ..physics.tissue import Tissue
from .bodies.contact import Slack, lip_share
from .drive.natural import LID_FAPS, Plan, blend
from .drive.wishes import Drive
from .mechanisms.jaw import JawMotion
from .mechanisms.lids import LidMove
from .pose import Poser, SkinState
from .response.actuators import Amounts
from .response.living_skin import living_skin, mandible

#: Muscle name -> contraction in [0, 1].
Contractions: TypeAlias = Mapping[str, float]


class Integrator(StrEnum):
    """How the equation of motion is integrated: backward Euler, or the paper's second-order Runge-Kutta."""

    IMPLICIT = "implicit"
    RK2 = "rk2"


@dataclass(frozen=True)
class Moment:
    """What is asked of one frame: FAPs (68,), how they drive the face, and the plan where the drive is natural.

    `by_hand` are contractions set by hand, and how far each set has come, 0..1.
    """

    frame: Floats
    drive: Drive
    plan: Plan | None
    by_hand: tuple[tuple[Contractions, float], ...] = ()


@dataclass(frozen=True)
class Aim:
    """What one frame's pose is made of, so that the way from one to the next can be taken in part.

    Attributes
    ----------
    lids : the amounts of lid moves. jaw : (3,) the mandible's angle, slide to the left and forward.
    elastic : (n, 3) what muscles and elastic correction add to the kinematics of jaw and lids, metres.
    push : (n, 3) what contact adds, metres.
    slack : how far the pose itself passes contact. lip_share : the upper lip's part of giving way.
    """

    lids: Mapping[tuple[str, LidMove], float]
    jaw: Floats
    elastic: Floats
    push: Floats
    slack: Slack
    lip_share: float

    def towards(self, other: Aim, share: float) -> Aim:
        """Part of the way (0..1) to another aim."""
        rest = 1.0 - share
        return Aim(
            lids={move: rest * amount + share * other.lids[move] for move, amount in self.lids.items()},
            jaw=rest * self.jaw + share * other.jaw,
            elastic=rest * self.elastic + share * other.elastic,
            push=rest * self.push + share * other.push,
            slack=self.slack.towards(other.slack, share),
            lip_share=rest * self.lip_share + share * other.lip_share,
        )


@dataclass(frozen=True)
class Motion:
    """The moving face between two steps: its skin, and the mandible (2, 3): angle and slides, and their rates."""

    skin: State
    jaw: Floats


class Simulation:
    """The moving skin of one face."""

    def __init__(self, poser: Poser, *, fps: float, integrator: str, substeps: int, tissue: str | Tissue) -> None:
        """Prepare a simulation.

        Parameters
        ----------
        poser : poses the same face.
        fps : frames per second, above 0.
        integrator : a name of `Integrator`. substeps : steps per frame, 1 or more; contact is seen to after each.
        tissue : a name in presets/tissue.toml, or figures of its own.

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
        self.substeps = substeps
        self.length = 1.0 / fps / substeps
        solver = ImplicitSolver if integrator == Integrator.IMPLICIT else Rk2Solver
        self.solver: ImplicitSolver | Rk2Solver = solver(self.skin, self.length)
        self._jaw_step = mandible(tissue).propagator(self.length)

    def run(self, moments: Iterable[Moment]) -> Iterator[Floats]:
        """Positions (V, 3) in the face's coordinates, one array per moment; the first is at rest in its pose."""
        motion: Motion | None = None
        before: Aim | None = None
        for number, moment in enumerate(moments):
            aim = self._aim(moment)
            if motion is None or before is None:
                motion = Motion(State.at_rest(self._held(aim, aim.jaw)), np.stack([aim.jaw, np.zeros(3)]))
            else:
                try:
                    motion = self._frame(motion, before, aim, moment.frame)
                except SolverError as error:
                    raise SolverError(f"the motion could not be solved: {error}", frame=number) from error
            before = aim
            displacement = motion.skin.positions - self.skin.rest
            state = SkinState(displacement, aim.elastic, JawMotion(*motion.jaw[0].tolist()))
            yield self.poser.assemble(state, moment.drive, moment.frame)

    def _aim(self, moment: Moment) -> Aim:
        """The pose that a moment asks for, taken apart."""
        poser = self.poser
        amounts = found = poser.amounts(moment.frame, moment.drive, moment.plan)
        for contractions, share in moment.by_hand:
            amounts = poser.towards_hand(amounts, contractions, share)
        state = poser.skin_state(moment.frame, moment.drive, moment.plan, amounts, found=found)
        kinematic = poser.anatomy.actuators.kinematic(amounts)
        return Aim(
            lids=amounts.lids,
            jaw=np.array([amounts.jaw.angle, amounts.jaw.left, amounts.jaw.forward]),
            elastic=state.elastic,
            push=state.displacement - kinematic - state.elastic,
            slack=poser.anatomy.contact.slack(state.displacement, poser.surroundings(amounts.jaw, moment.frame)),
            lip_share=lip_share(moment.frame if moment.plan is None else moment.plan.asked),
        )

    def _anchors(self, aim: Aim, jaw: Floats) -> Floats:
        """(n, 3) where jaw (3,), lids and contact would carry skin that no muscle pulls."""
        actuators = self.poser.anatomy.actuators
        carried = actuators.kinematic(Amounts(np.zeros(0), aim.lids, JawMotion(*jaw.tolist())))
        return np.asarray(self.skin.rest + carried + aim.push)

    def _held(self, aim: Aim, jaw: Floats) -> Floats:
        """(n, 3) where the skin comes to rest for an aim."""
        return np.asarray(self._anchors(aim, jaw) + aim.elastic)

    def _frame(self, motion: Motion, before: Aim, after: Aim, frame: Floats) -> Motion:
        """The motion one frame on, its aim changing evenly from one to the other; forces are taken midway in a step."""
        poser, contact = self.poser, self.poser.anatomy.contact
        for number in range(self.substeps):
            start, midway, end = (before.towards(after, (number + part) / self.substeps) for part in (0.0, 0.5, 1.0))
            jaw = self._swung(motion.jaw, start.jaw, end.jaw)
            anchors = self._anchors(midway, 0.5 * (motion.jaw[0] + jaw[0]))
            load = -self.skin.force(anchors + midway.elastic, anchors)
            skin = self.solver.step(motion.skin, load, anchors)
            at = poser.surroundings(JawMotion(*jaw[0].tolist()), frame)
            motion = Motion(contact.hold(skin, end.lip_share, at, end.slack, self.length), jaw)
        return motion

    def _swung(self, jaw: Floats, start: Floats, end: Floats) -> Floats:
        """The mandible (2, 3) one step on, while what it follows goes from start (3,) to end (3,).

        Teeth stop it: it does not close further than it rests, or than is asked.
        """
        after: Floats = self._jaw_step @ np.stack([*jaw, start, (end - start) / self.length])
        least = min(0.0, float(end[0]))
        if after[0, 0] < least:
            after[:, 0] = least, max(float(after[1, 0]), 0.0)
        return after


def stream_moments(poser: Poser, frames: Floats, drive: Drive, weights: Floats | None) -> Iterator[Moment]:
    """Moments of a FAP stream (T, 68), each planned by itself; weights (T, 6) name the emotions where known."""
    for number, frame in enumerate(frames):
        emotion = None
        if weights is not None and (total := float(weights[number].sum())) > 0.0:
            emotion = {str(a): float(w) / total for a, w in zip(ARCHETYPES, weights[number], strict=True)}
        yield Moment(frame, drive, poser.natural.plan(frame, emotion) if drive is Drive.NATURAL else None)


def cue_moments(
    poser: Poser,
    cues: Sequence[Cue],
    fps: float,
    drive: Drive,
    contractions: Sequence[Contractions] | None = None,
    liveliness: Liveliness | None = None,
) -> Iterator[Moment]:
    """Moments of cues: each cue is planned once at its apex, and the plans are blended by the cues' strengths.

    So what a face adds by itself to one expression is not contradicted by FAPs that another cue asks for. Contractions
    set by hand, one set per cue, come and go with it. Blinks and small motions of head and eyes are laid over all that.
    """
    hands = [{} for _ in cues] if contractions is None else contractions
    if len(hands) != len(cues):
        raise ParameterError("contractions", f"must be one set for each of the {len(cues)} cues", len(hands))
    frames = sequence(cues, fps=fps)
    plans = [poser.natural.plan(cue.profile.frame(cue.seed), cue.profile.weights) for cue in cues]
    overlay = (liveliness or Liveliness()).over(len(frames), fps)
    for number, (frame, weights) in enumerate(zip(frames, strengths(cues, fps=fps), strict=True)):
        plan = blend(plans, weights.tolist()) if drive is Drive.NATURAL else None
        shares = (weights / max(1.0, weights.sum())).tolist()
        by_hand = tuple((hand, share) for hand, share in zip(hands, shares, strict=True) if hand and share > 0.0)
        lively = None if plan is None else _laid_over(plan, overlay, number)
        yield Moment(overlay.upon(frame, number), drive, lively, by_hand)


def _laid_over(plan: Plan, overlay: Overlay, number: int) -> Plan:
    """A plan whose lids close as far as is laid over its frame; eyes and head are no matter of plans."""
    goal = overlay.upon(plan.goal, number)
    blinks = np.isin(np.arange(1, FAP_COUNT + 1), LID_FAPS) & (overlay.closure[number] > 0.0)
    return replace(plan, goal=goal, asked=np.where(blinks, goal, plan.asked))
