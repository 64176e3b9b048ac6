"""The skin and mandible of a face in motion, quickly: the production way.

What `motion` integrates step by step is here the balance of each step and, in a few fields (`physics.reduced`), how far
inertia and damping leave the skin behind it. The muscles' part of the balance is foretold from a few equilibria of the
clip (`response.sampled`). All else, jaw, lids, correction and contact, is as exact as there.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import Floats
from ..errors import ParameterError
from ..physics.elastic import Factor
from ..physics.reduced import ReducedSkin, principal_fields
from ..physics.skin import State
from ..physics.tissue import Tissue
from ..progress import Progress, Work, part_of
from .anatomy import Anatomy
from .bodies.surroundings import Surroundings
from .drive.plan import Plan
from .jaw_follower import JawFollower, jaw_motion, resting
from .mechanisms.jaw import JawMotion
from .motion import Setpoint
from .posture import Balance, Effort, Posture
from .response.actuators import Amounts
from .response.sampled import SampledPull, farthest, foretelling, sampled_pull
from .response.spring_skin import spring_skin

#: Fields of the balance in which the skin may be left behind, and how many these and the skin's answers to them may be.
FIELDS, WITH_ANSWERS = 12, 36

#: The skin's stiffness is taken at so many of the steps that want points, lids and jaw farthest apart.
STIFFNESSES = 6

#: How far the work of a clip is once its muscles are found, once its equilibria are solved; what is said thereafter.
EFFORTS, SOLVED, LEFT_BEHIND = 0.2, 0.8, "Finding how the skin is left behind"

#: So many steps that want points, lids and jaw farthest apart are among what the fields are made of.
WANTED = 8


@dataclass(frozen=True, eq=False)
class Course:
    """What is known of a clip before its first step.

    Attributes
    ----------
    efforts : of its steps. pull : the muscles' part of their balances.
    reduced : how the skin is left behind; None where nothing moves.
    stiffness : (p, k, k) of it at some steps. shares : (T, p) how that of every step is a sum of these.
    """

    efforts: Sequence[Effort]
    pull: SampledPull
    reduced: ReducedSkin | None
    stiffness: Floats
    shares: Floats


class ReducedMotion:
    """Takes one face along whole clips."""

    def __init__(self, balance: Balance, duration: float, *, substeps: int, tissue: str | Tissue) -> None:
        """Prepare for steps of a duration, seconds.

        Parameters
        ----------
        balance : of the face. substeps : in each step, 1 or more, over each of which the jaw goes evenly.
        tissue : a name in presets/tissue.toml, or figures of its own.

        Raises
        ------
        ParameterError : names the parameter and its rule.
        """
        if substeps < 1:
            raise ParameterError("substeps", "must be 1 or more", substeps)
        self.balance, self.anatomy = balance, balance.anatomy
        self.duration, self.substeps = duration, substeps
        self.skin = spring_skin(self.anatomy.skin, tissue)
        self._jaw = JawFollower(tissue, duration / substeps)

    def course(self, plans: Sequence[Plan]) -> Work[Course]:
        """What a clip of plans, one for each step, needs before it can be run through.

        Raises
        ------
        ParameterError, SolverError : as `Balance.posture`.
        """
        efforts: list[Effort] = []
        for plan in plans:
            efforts.append(self.balance.effort(plan, before=efforts[-1] if efforts else None))
            yield Progress(EFFORTS * len(efforts) / len(plans), "Finding the muscles behind the motion")
        amounts = [effort.amounts for effort in efforts]
        pull = yield from part_of(sampled_pull(self.anatomy.relaxation, amounts), EFFORTS, SOLVED)
        places = np.array([_wanted(self.anatomy, effort) for effort in efforts])
        telling = [0, *farthest(places, [0], WANTED)]
        postures: dict[int, Posture] = {}
        for step in dict.fromkeys([*telling, *pull.steps.tolist()]):
            postures[step] = self.balance.reached(efforts[step], pull.at(step))
            yield Progress(SOLVED, LEFT_BEHIND)
        carried = [posture.carried for posture in postures.values()]
        balances = np.array([posture.displacement for posture in postures.values()] + carried)
        fields = principal_fields(balances, FIELDS)
        yield Progress(SOLVED, LEFT_BEHIND)
        if not len(fields):
            return Course(efforts, pull, None, np.empty((0, 0, 0)), np.empty((len(plans), 0)))
        reduced = ReducedSkin(
            self.skin, Factor(self.skin.matrix()), fields, self.duration / self.substeps, count=WITH_ANSWERS
        )
        stiff = telling[:STIFFNESSES]
        stiffness = [reduced.stiffness(self.skin.rest + postures[step].displacement) for step in stiff]
        return Course(efforts, pull, reduced, np.array(stiffness), _parts(foretelling(places, stiff)))

    def along(self, course: Course) -> Iterator[tuple[Floats, JawMotion]]:
        """Displacement (n, 3) of the outer skin in head space, metres, and the mandible, step by step."""
        contact, reduced = self.anatomy.contact, course.reduced
        before = after = self._setpoint(course, 0)
        jaw = resting(after.jaw)
        balanced = self._balanced(after, jaw)
        state, felt = (np.empty(0), np.empty(0)) if reduced is None else (reduced.at_rest(), reduced.read(balanced))
        for step in range(len(course.efforts)):
            if step:
                before, after = after, self._setpoint(course, step)
                stiffness = np.tensordot(course.shares[step], course.stiffness, axes=1)
            for number in range(self.substeps if step else 0):
                start, end = (before.towards(after, (number + part) / self.substeps) for part in (0.0, 1.0))
                jaw = self._jaw.swung(jaw, start.jaw, end.jaw)
                balanced = self._balanced(end, jaw)
                if reduced is not None:
                    now = reduced.read(balanced)
                    state, felt = reduced.follow(state, felt, now, stiffness), now
            shown = balanced if reduced is None else balanced + reduced.displacement(state)
            at = Surroundings(jaw_motion(jaw[0]), after.looks)
            moved = State.at_rest(self.skin.rest + shown)
            held = contact.hold(moved, after.lip_share, at, after.slack, self.duration)
            yield held.positions - self.skin.rest, at.jaw

    def _setpoint(self, course: Course, step: int) -> Setpoint:
        """What a step of a course asks for."""
        return Setpoint.of(self.balance.reached(course.efforts[step], course.pull.at(step)), self.anatomy.contact)

    def _balanced(self, setpoint: Setpoint, jaw: Floats) -> Floats:
        """(n, 3) where the outer skin would be in balance, carried by the mandible (2, 3) as it is."""
        carried = self.anatomy.actuators.carried(Amounts(np.zeros(0), setpoint.lids, jaw_motion(jaw[0])))
        return carried + setpoint.elastic + setpoint.pushed


def _parts(weights: Floats) -> Floats:
    """(T, p) weights as parts of a whole: none negative, so that no stiffness is taken away."""
    parts = np.maximum(weights, 0.0)
    return np.asarray(parts / parts.sum(axis=1, keepdims=True))


def _wanted(anatomy: Anatomy, effort: Effort) -> Floats:
    """Where points are wanted, and what lids and jaw are at, metres: muscles are not all that moves skin."""
    jaw, lids = effort.amounts.jaw, effort.amounts.lids
    carried = [*lids.values(), jaw.angle * anatomy.actuators.chin_lever, jaw.left, jaw.forward]
    return np.concatenate([np.nan_to_num(effort.targets.displacements), carried])
