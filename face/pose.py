"""Posing one face: request -> plan -> targets -> amounts -> pose, each worked out once and carried on.

plan        `drives`: what the face is to do, FAP by FAP; a natural plan weighs the request
targets     `drives`: where that takes the feature points of this face, metres
amounts     `posture`: of muscles, lids and jaw, which explain the targets; then those set by hand
posture     `posture`: the outer skin in balance, corrected and held off what it meets
positions   `assembly`: all vertices of the face
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Floats
from ..mpeg4 import ARCHETYPES, expression
from ..progress import Progress, Work
from .anatomy import Anatomy
from .assembly import Assembly, check_finite
from .drive.drives import DRIVES
from .drive.plan import Plan
from .drive.request import Drive, EmotionShares, Request
from .measure import measure
from .posture import Balance, Posture
from .requests import checked_request
from .response.recollection import Recollection
from .response.relaxation import FORETOLD, IN_PASSING
from .unmet import unmet

#: Activations of the archetypes that are explored; and directions of the wheel, in degrees, at one activation.
EXPLORED, ROUND, AT = (7.0, 4.0), range(0, 360, 30), 5.0


@dataclass(frozen=True, eq=False)
class Pose:
    """A posed face.

    Attributes
    ----------
    positions : (V, 3) in the face's coordinates.
    contractions : muscle name -> contraction in [0, 1].
    asked : (68,) the FAPs as given. goal : (68,) what the drive decided to do. achieved : (68,) measured on the
        positions. All in FAP units, NaN where silent or not measurable.
    reasons : FAP number -> why the goal differs from what was asked, natural drive only; and in every drive what sewn
        lips and shut lids do not let the face do.
    unmet : FAP number -> why, of FAPs that were asked and of which nothing shows.
    by_muscles : FAP number -> share of its goal that muscles, lids and jaw reach, 0..1, of those that have one; the
        elastic skin adds the rest where the drive corrects.
    """

    positions: Floats
    contractions: Mapping[str, float]
    asked: Floats
    goal: Floats
    achieved: Floats
    reasons: Mapping[int, str]
    unmet: Mapping[int, str]
    by_muscles: Mapping[int, float]


@dataclass(frozen=True, eq=False)
class Sketch:
    """A quickly posed face: positions (V, 3) in the face's coordinates, muscle name -> contraction in [0, 1]."""

    positions: Floats
    contractions: Mapping[str, float]


class Poser:
    """Poses one face; where the drive has folds with these, unless told otherwise."""

    def __init__(self, anatomy: Anatomy, *, folds: bool = True) -> None:
        self.anatomy = anatomy
        self.balance = Balance(anatomy)
        self.assembly = Assembly(anatomy, folds=folds)
        self.known, self.is_explored = Recollection(), False

    def plan(self, request: Request) -> Plan:
        """What the face is to do for a request."""
        return DRIVES[request.drive].plan(request)

    def pose(self, request: Request, *, teaching: bool = False) -> Pose:
        """The equilibrium for a request; see `Face.pose`. With teaching, what is found foretells sketches."""
        plan, pulled = self.plan(request), self.anatomy.relaxation.pulled
        posture = self.balance.posture(plan, partial(pulled, teaching=self.known) if teaching else pulled)
        positions = self._positions(posture, request)
        achieved, reasons = measure(self.anatomy, positions), {**plan.reasons(), **self.balance.held(plan)}
        return Pose(
            positions=positions,
            contractions=self.anatomy.actuators.contractions(posture.amounts),
            asked=request.faps.copy(),
            goal=plan.goal.copy(),
            achieved=achieved,
            reasons=reasons,
            unmet=unmet(self.anatomy, plan.wanted, achieved, reasons),
            by_muscles=self._by_muscles(plan, posture),
        )

    def _by_muscles(self, plan: Plan, posture: Posture) -> dict[int, float]:
        """FAP number -> share of its goal that muscles, lids and jaw reach."""
        rows = self.anatomy.inverse.rows
        goal = rows.select(plan.goal)
        shares = np.clip(posture.explained / np.where(np.abs(goal) > 0.0, goal, np.inf), 0.0, 1.0)
        told = np.isfinite(goal) & (goal != 0.0)
        return dict(zip(rows.numbers[told].tolist(), shares[told].tolist(), strict=True))

    def sketch(self, request: Request, *, trusted: float = FORETOLD) -> Sketch:
        """What `pose` shows, a little short of balance and not measured; what is found foretells others.

        What others foretell is taken where its doubt is no more than `trusted`, metres.
        """
        answer = partial(self.anatomy.relaxation.recalled, known=self.known, trusted=trusted)
        posture = self.balance.posture(self.plan(request), answer)
        return Sketch(self._positions(posture, request), self.anatomy.actuators.contractions(posture.amounts))

    def _positions(self, posture: Posture, request: Request) -> Floats:
        """(V, 3) in the face's coordinates."""
        check_finite(posture.displacement)
        positions = self.assembly.positions(posture.displacement, posture.amounts.jaw, request)
        check_finite(positions)
        return positions


class Sketcher:
    """Poses one face again and again, as a slider is dragged: what was found for the others foretells the next one.

    A sketch is within a tenth of a millimetre of the pose, and takes a fifth to a third of its time. In passing, where
    the next one is soon to follow, it is within half a millimetre, and hardly ever takes more than the least time.
    """

    def __init__(self, poser: Poser) -> None:
        self._poser = poser

    def sketch(
        self,
        frame: ArrayLike,
        *,
        drive: str | Drive = Drive.NATURAL,
        emotion: EmotionShares | None = None,
        contractions: Mapping[str, float] | None = None,
        passing: bool = False,
    ) -> Sketch:
        """The face for one frame of FAPs; parameters and errors as `Face.pose`."""
        request = checked_request(frame, drive, emotion, contractions)
        return self._poser.sketch(request, trusted=IN_PASSING if passing else FORETOLD)

    def pose(
        self,
        frame: ArrayLike,
        *,
        drive: str | Drive = Drive.NATURAL,
        emotion: EmotionShares | None = None,
        contractions: Mapping[str, float] | None = None,
    ) -> Pose:
        """As `Face.pose`, whatever was sketched before; what is found foretells the sketches after it."""
        return self._poser.pose(checked_request(frame, drive, emotion, contractions), teaching=True)

    def explore(self) -> Work[None]:
        """Sketch archetypes and the wheel once, bit by bit: what is found foretells whatever lies between."""
        if self._poser.is_explored:
            return
        some = [expression(name, activation=level) for level in EXPLORED for name in ARCHETYPES]
        some += [expression(angle=float(angle), activation=AT) for angle in ROUND]
        for number, found in enumerate(some):
            yield Progress(number / len(some), "Exploring expressions")
            self.sketch(found.frame(), emotion=found.weights)
        self._poser.is_explored = True
