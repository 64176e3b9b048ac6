"""The skin and mandible of a face in motion, quickly: the production way.

What `motion` integrates step by step is here the balance of each step and, in a few fields (`physics.reduced`), how far
inertia and damping leave the skin behind it. The muscles' part of the balance is foretold from a few equilibria of the
clip (`clip_balance`). All else, jaw, lids, correction and contact, is as exact as there. Many steps are worked out
together, as products of matrices.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..arrays import Floats
from ..errors import ParameterError
from ..physics.reduced import ReducedSkin, principal_fields
from ..physics.skin import Skin
from ..physics.tissue import Tissue
from ..progress import Progress, Work, part_of
from .anatomy import Anatomy
from .assembly import check_finite
from .bodies.contact import Slack
from .bodies.surroundings import Surroundings
from .clip_balance import ClipBalance, clip_balance
from .drive.plan import Plan
from .jaw_follower import JawFollower, resting
from .mechanism import Mechanism
from .meeting_lips import SHORT, LipsAt, MeetingLips, each_of, lip_pushes
from .posture import Balance, Effort
from .response.actuators import Amounts
from .response.sampled import farthest, foretelling
from .response.spring_skin import spring_skin

#: Fields of the balance in which the skin may be left behind, and how many these and the skin's answers to them may be.
#: Skin of few nodes moves less smoothly and has more, which cost little there.
FIELDS, WITH_ANSWERS = 12, 36
COARSE, FIELDS_IF_COARSE = 3000, 20

#: How the skin passes from step to step is taken at so many of the steps that want points, lids and jaw farthest apart.
PASSAGES = 6

#: How far the work of a clip is once its balance is known, and what is said thereafter.
SOLVED, LEFT_BEHIND = 0.8, "Finding how the skin is left behind"

#: So many steps that want points, lids and jaw farthest apart are among what the fields are made of.
WANTED = 8


@dataclass(frozen=True, eq=False)
class Course:
    """What is known of a clip before its first step.

    Attributes
    ----------
    clip : the balance of its T steps.
    jaws, lids : (T, substeps, 3) where the mandible is and (T, substeps, l) what lids do after each substep.
    reduced : how the skin is left behind; None where nothing moves.
    passages, short : (p, 2k, 3k) of it at some steps, and of short ones (`meeting_lips`). shares : (T, p) how that of
    every step is a sum of these.
    """

    clip: ClipBalance
    jaws: Floats
    lids: Floats
    reduced: ReducedSkin | None
    passages: Floats
    short: Floats
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
        clip = yield from part_of(clip_balance(self.balance, plans), 0.0, SOLVED)
        efforts, pull = clip.efforts, clip.pull
        places = np.array([_wanted(self.anatomy, effort) for effort in efforts])
        telling = [0, *farthest(places, [0], WANTED)]
        some = np.array(list(dict.fromkeys([*telling, *pull.steps.tolist()])))
        postures = self.balance.reached_each([efforts[step] for step in some], pull.at(some))
        check_finite(postures.displacements, some)
        yield Progress(SOLVED, LEFT_BEHIND)
        many = FIELDS if len(self.skin.rest) > COARSE else FIELDS_IF_COARSE
        fields = principal_fields(np.concatenate([postures.displacements, postures.carried]), many)
        jaws, lids = self._carriers([effort.amounts for effort in efforts])
        if not len(fields):
            none = np.empty((0, 0, 0))
            return Course(clip, jaws, lids, None, none, none, np.empty((len(plans), 0)))
        yield Progress(SOLVED, LEFT_BEHIND)
        step = self.duration / self.substeps
        fields = np.concatenate([fields, lip_pushes(self.anatomy.contact)])
        reduced = ReducedSkin(self.skin, self.anatomy.relaxation.factor, fields, step, count=WITH_ANSWERS)
        passages, telling = list[list[Floats]](), telling[:PASSAGES]
        for displacement in postures.displacements[: len(telling)]:
            yield Progress(SOLVED, LEFT_BEHIND)
            passages.append(reduced.passages(self.skin.rest + displacement, [1, SHORT]))
        whole, short = (np.array(each) for each in zip(*passages, strict=True))
        return Course(clip, jaws, lids, reduced, whole, short, _parts(foretelling(places, telling)))

    def along(self, course: Course) -> Iterator[tuple[Floats, Floats]]:
        """Displacements (s, n, 3) of the outer skin in head space, metres, and mandibles (s, 3), some at a time."""
        contact, rest = self.anatomy.contact, self.skin.rest
        left_behind = LeftBehind(course, self.anatomy, self.skin)
        for steps, asked in course.clip.along():
            carried = self.anatomy.actuators.carried_each(course.jaws[steps, -1], course.lids[steps, -1])
            added = asked.elastic + asked.pushed
            slack = contact.slack(asked.displacements, asked.surroundings)
            shown = rest + carried + added
            shown += left_behind.displacements(steps, added, shown, asked.lip_shares, slack)
            at = Surroundings(course.jaws[steps, -1], asked.surroundings.looks)
            yield contact.held(shown, asked.lip_shares, at, slack) - rest, course.jaws[steps, -1]

    def _carriers(self, amounts: Sequence[Amounts]) -> tuple[Floats, Floats]:
        """The mandible (T, substeps, 3) as it follows, and lids (T, substeps, l), after each substep of each step."""
        asked, lids = (evenly(each, self.substeps) for each in self.anatomy.actuators.carriers(amounts))
        jaws, jaw, before = np.empty_like(asked), resting(asked[0, 0]), asked[0, 0]
        for place in np.ndindex(asked.shape[:2]):
            jaw, before = self._jaw.swung(jaw, before, asked[place]), asked[place]
            jaws[place] = jaw[0]
        return jaws, lids


class LeftBehind:
    """How far the skin of one clip is left behind, some steps after the others."""

    def __init__(self, course: Course, anatomy: Anatomy, skin: Skin) -> None:
        self._course, self._actuators = course, anatomy.actuators
        self._lips: MeetingLips | None = None
        if course.reduced is not None:
            self._state, self._jaw = course.reduced.at_rest(), course.reduced.read(anatomy.actuators.jaw_ways)
            if anatomy.contact.lips is not None and anatomy.skin.has(Mechanism.CONTACT):
                self._lips = MeetingLips(anatomy.contact.lips, course.reduced, skin.mass)
        self._added: Floats | None = None
        self._felt: Floats | None = None
        self._before: LipsAt | None = None

    def displacements(
        self, steps: slice[int, int, None], added: Floats, balanced: Floats, lip_shares: Floats, slack: Slack
    ) -> Floats:
        """(s, n, 3) metres at the ends of the next steps.

        Parameters
        ----------
        added : (s, n, 3) metres, the balance without jaw and lids. balanced : (s, n, 3) positions with these, metres.
        lip_shares, slack : as lips meet.
        """
        reduced = self._course.reduced
        if reduced is None:
            return np.zeros_like(added)
        ends = reduced.read(added)
        even = evenly(
            np.concatenate([ends[:1] if self._added is None else self._added, ends]), self._course.jaws.shape[1]
        )
        states, felts = [], self._carried(reduced, steps) + even[1:]
        before = felts[0, 0] if self._felt is None else self._felt
        lips = self._lips_at(balanced, felts[:, -1], lip_shares, slack)
        for number, parts in enumerate(felts):
            shares = self._course.shares[steps.start + number]
            start, passage = self._state, np.tensordot(shares, self._course.passages, axes=1)
            for felt in parts:
                self._state, before = reduced.follow(self._state, before, felt, passage), felt
            if self._lips is not None:
                self._meet(start, lips[number], parts, shares)
            states.append(self._state)
        self._added, self._felt = ends[-1:], before
        return reduced.displacement(np.array(states))

    def _lips_at(self, balanced: Floats, felts: Floats, lip_shares: Floats, slack: Slack) -> Sequence[LipsAt]:
        """Lips at the ends of steps; none where they cannot meet."""
        if self._lips is None:
            return []
        return each_of(balanced[:, self._lips.nodes], felts, lip_shares, slack.margins[0])

    def _meet(self, start: Floats, lips: LipsAt, felts: Floats, shares: Floats) -> None:
        """Go from the state at the start of a step through it again where lips have passed each other.

        `felts` (substeps, 2k) at the ends of substeps.
        """
        assert self._lips is not None
        before, self._before = self._before, lips
        if before is None or not self._lips.have_passed(lips, self._state):
            return
        short, self._state, last = np.tensordot(shares, self._course.short, axes=1), start, before
        for number, felt in enumerate(felts, start=1):
            after = replace(before.towards(lips, number / len(felts)), felt=felt)
            self._state, last = self._lips.through(self._state, last, after, short), after

    def _carried(self, reduced: ReducedSkin, steps: slice[int, int, None]) -> Floats:
        """(s, substeps, 2k) what the skin feels of being carried by jaw and lids."""
        jaws, lids = self._course.jaws[steps], self._course.lids[steps]
        felt = self._actuators.jaw.shares(jaws) @ self._jaw
        for near, moved in self._actuators.lids_carried(lids.reshape(-1, lids.shape[2])):
            felt += reduced.read(moved, near).reshape(felt.shape)
        return np.asarray(felt)


def evenly(values: Floats, parts: int) -> Floats:
    """(T, parts, d) values on the way to each of some values (T, d) from the one before, at the ends of equal parts."""
    before = np.concatenate([values[:1], values[:-1]])
    shares = np.arange(1, parts + 1)[:, None] / parts
    return np.asarray((1.0 - shares) * before[:, None] + shares * values[:, None])


def _parts(weights: Floats) -> Floats:
    """(T, p) weights as parts of a whole: none negative, so that nothing gains by being taken away."""
    parts = np.maximum(weights, 0.0)
    return np.asarray(parts / parts.sum(axis=1, keepdims=True))


def _wanted(anatomy: Anatomy, effort: Effort) -> Floats:
    """Where points are wanted, and what lids and jaw are at, metres: muscles are not all that moves skin."""
    jaw, lids = effort.amounts.jaw, effort.amounts.lids
    carried = [*lids.values(), jaw.angle * anatomy.actuators.chin_lever, jaw.left, jaw.forward]
    return np.concatenate([np.nan_to_num(effort.targets.displacements), carried])
