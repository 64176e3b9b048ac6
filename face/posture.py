"""From a plan to a posture: how much of muscles, lids and jaw, and where that brings the outer skin.

The skin is carried by jaw and lids, pulled by muscles, corrected elastically where the drive goes the rest of the way
to the targets, and pushed by what it meets.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.spatial import cKDTree

from ..arrays import Floats, Ints
from .anatomy import Anatomy
from .bodies.contact import lip_share
from .bodies.surroundings import Look, Surroundings
from .drive.belief import Belief
from .drive.by_hand import set_by_hand
from .drive.drives import DRIVES, Correction
from .drive.held_together import held_reasons, held_together
from .drive.plan import Plan
from .drive.targets import Targets
from .figures import Length, read_figures
from .mechanism import Mechanism
from .response.actuators import Amounts


@dataclass(frozen=True)
class LastWordFigures:
    """What contact leaves alone where FAPs have the last word (presets/anatomy/targets.toml)."""

    spared: Length


LAST_WORD = read_figures("targets.last_word", LastWordFigures)

#: Rounds of elastic correction by who has the last word: where FAPs have it, what contact disturbs is corrected again.
ROUNDS = {Correction.NONE: 0, Correction.CONTACT: 1, Correction.FAPS: 3}


@dataclass(frozen=True, eq=False)
class Posture:
    """What a pose is made of; displacements (n, 3) of the outer skin in head space, metres.

    Attributes
    ----------
    amounts : of muscles, lids and jaw.
    carried : what jaw and lids do, which turn as bodies.
    elastic : what muscles and the elastic correction add.
    pushed : what contact adds.
    surroundings : where mandible and eyeballs are.
    explained : (m,) how far muscles (as far as they are believed), lids and jaw move the rows, metres.
    lip_share : the upper lip's part of the way where lips give way to each other, 0..1.
    """

    amounts: Amounts
    carried: Floats
    elastic: Floats
    pushed: Floats
    surroundings: Surroundings
    explained: Floats
    lip_share: float

    @property
    def displacement(self) -> Floats:
        """(n, 3) of the outer skin, all together."""
        return self.carried + self.elastic + self.pushed


@dataclass(frozen=True, eq=False)
class Postures:
    """What T postures are made of, as of `Posture`: lid moves (T, l), displacements (T, n, 3), rows (T, m), (T,)."""

    lids: Floats
    carried: Floats
    elastic: Floats
    pushed: Floats
    surroundings: Surroundings
    explained: Floats
    lip_shares: Floats

    @property
    def displacements(self) -> Floats:
        """(T, n, 3) of the outer skin, all together."""
        return self.carried + self.elastic + self.pushed

    def some(self, chosen: Ints) -> Postures:
        """Some of them, each as often as it is chosen."""
        lids, carried, elastic, pushed, explained, shares = (
            each[chosen]
            for each in (self.lids, self.carried, self.elastic, self.pushed, self.explained, self.lip_shares)
        )
        return Postures(lids, carried, elastic, pushed, self.surroundings.some(chosen), explained, shares)


@dataclass(frozen=True, eq=False)
class Effort:
    """A plan, what it wants of the points of a face, the amounts that explain it, and what of their motion is a guess.

    Attributes
    ----------
    guessed : (n, 3) the part of the muscles' motion that is not believed (`Belief`), metres; 0.0: none.
    """

    plan: Plan
    targets: Targets
    amounts: Amounts
    guessed: Floats | float = 0.0

    def reached_as(self, other: Effort) -> bool:
        """Whether it is known to take the skin where another, of which its amounts are, takes it."""
        mine, theirs = ((each.plan.request.faps, each.plan.evened) for each in (self, other))
        alike = all(np.array_equal(a, b, equal_nan=True) for a, b in zip(mine, theirs, strict=True))
        return alike and self.amounts is other.amounts


class Balance:
    """Finds the postures in which one face's skin is in balance."""

    def __init__(self, anatomy: Anatomy) -> None:
        self.anatomy = anatomy

    def posture(self, plan: Plan, answer: Callable[[Amounts], Floats] | None = None) -> Posture:
        """The posture of a plan; the skin's `answer` to amounts (n, 3) is in balance unless told otherwise.

        Raises
        ------
        ParameterError : an unknown muscle set by hand, or a contraction outside 0..1.
        SolverError : contractions beyond what the skin can bear.
        """
        effort = self.effort(plan)
        pulled = self.anatomy.relaxation.pulled if answer is None else answer
        return self.reached(effort, pulled(effort.amounts))

    def effort(self, plan: Plan, *, before: Effort | None = None) -> Effort:
        """What a plan takes of muscles, lids and jaw, before the skin answers; errors as `posture`.

        An effort `before` that wanted the same is known to take the same.
        """
        anatomy, rules = self.anatomy, DRIVES[plan.request.drive]
        targets = held_together(anatomy.inverse.rows, rules.targets(anatomy.inverse.rows, plan), anatomy.skin.sewn)
        if (
            before is not None
            and plan.request.by_hand == before.plan.request.by_hand == ()
            and targets.same(before.targets)
        ):
            return replace(before, plan=plan)
        found = anatomy.inverse.solve(targets) if rules.muscles else anatomy.actuators.none()
        amounts = set_by_hand(anatomy.actuators, found, plan.request.by_hand)
        guessed: Floats | float = 0.0
        if rules.muscles and rules.correction is Correction.FAPS and self._rounds(rules.correction):
            guessed = self.belief.guessed(found, amounts, targets)
        if plan.request.by_hand and rules.correction is Correction.CONTACT:
            targets = self._moved_by_hand(targets, found, amounts)
        return Effort(plan, targets, amounts, guessed)

    def reached(self, effort: Effort, pulled: Floats) -> Posture:
        """The posture of an effort whose muscles pull the skin so (n, 3), metres."""
        shown = self.reached_each([effort], pulled[None])
        looks = {side: Look(look.centre[0], look.gaze[0]) for side, look in shown.surroundings.looks.items()}
        return Posture(
            effort.amounts,
            shown.carried[0],
            elastic=shown.elastic[0],
            pushed=shown.pushed[0],
            surroundings=Surroundings(effort.amounts.jaw, looks),
            explained=shown.explained[0],
            lip_share=float(shown.lip_shares[0]),
        )

    def reached_each(self, efforts: Sequence[Effort], pulled: Floats) -> Postures:
        """As `reached`, of T efforts of one drive, whose muscles pull the skin so (T, n, 3), metres."""
        plans = [effort.plan for effort in efforts]
        jaws, lids = self.anatomy.actuators.carriers([effort.amounts for effort in efforts])
        looks = [{ball.side: ball.look(plan.request.faps) for ball in self.anatomy.eyeballs} for plan in plans]
        carried = self.anatomy.actuators.carried_each(jaws, lids)
        elastic = np.array([each - effort.guessed for each, effort in zip(pulled, efforts, strict=True)])
        postures = Postures(
            lids,
            carried,
            elastic=elastic,
            pushed=np.zeros_like(carried),
            surroundings=Surroundings.over(jaws, looks),
            explained=self._read(carried + elastic),
            lip_shares=np.array([lip_share(plan.evened) for plan in plans]),
        )
        rules = DRIVES[plans[0].request.drive]
        return self._corrected(postures, [effort.targets for effort in efforts], rules.correction)

    def held(self, plan: Plan) -> dict[int, str]:
        """FAP number -> why it is not met, of what sewn lips and shut lids keep a plan from."""
        rows = self.anatomy.inverse.rows
        targets = DRIVES[plan.request.drive].targets(rows, plan)
        return held_reasons(rows, targets, held_together(rows, targets, self.anatomy.skin.sewn))

    def _moved_by_hand(self, targets: Targets, found: Amounts, amounts: Amounts) -> Targets:
        """Targets that want what was set by hand, too: the difference that it makes is not corrected away."""
        actuators, inverse = self.anatomy.actuators, self.anatomy.inverse
        change = inverse.muscles_on_rows(amounts) - inverse.muscles_on_rows(found)
        if (found.jaw, found.lids) != (amounts.jaw, amounts.lids):
            carried = actuators.carried(amounts) - actuators.carried(found)
            change = change + np.asarray(inverse.matrix @ carried.ravel())
        return replace(targets, displacements=targets.displacements + change)

    def _read(self, displacements: Floats) -> Floats:
        """(T, m) how far displacements (T, n, 3) move the rows, metres."""
        return np.asarray(self.anatomy.inverse.matrix @ displacements.reshape(len(displacements), -1).T).T

    def _corrected(self, postures: Postures, targets: Sequence[Targets], correction: Correction) -> Postures:
        """Postures held off what their skin meets, and taken the rest of the way to targets."""
        contact, correct = self.anatomy.contact, self.anatomy.inverse.correction
        at, shares = postures.surroundings, postures.lip_shares
        wanted = np.array([np.where(each.corrected, each.displacements, np.nan) for each in targets])
        doubts = np.array([each.doubts for each in targets])
        rounds = self._rounds(correction)
        free = postures.carried + postures.elastic
        shown = contact.settle(free, shares, at, shut=rounds == 0)
        elastic, pushed = postures.elastic, shown - free
        for number in range(1, rounds + 1):
            change = correct(wanted - self._read(shown), doubts)
            elastic, free = elastic + change, shown + change
            if correction is Correction.FAPS and number == rounds:
                shown = contact.clear(free, at, self._near_points)
            else:
                shown = contact.settle(free, shares, at, shut=number == rounds)
            pushed = pushed + (shown - free)
        return replace(postures, elastic=elastic, pushed=pushed)

    def _rounds(self, correction: Correction) -> int:
        """How often the skin is corrected."""
        return ROUNDS[correction] if Mechanism.CORRECTION in self.anatomy.mechanisms else 0

    @cached_property
    def belief(self) -> Belief:
        """How far this face's muscles are believed."""
        return Belief(self.anatomy.inverse)

    @cached_property
    def _near_points(self) -> Floats:
        """(n,) 1 where FAPs are read off the skin, fading over a few millimetres."""
        positions = self.anatomy.skin.positions
        distance, _ = cKDTree(positions[self.anatomy.points_on_skin]).query(positions)
        return np.asarray(np.exp(-((distance / LAST_WORD.spared) ** 2)))
