"""Posing one face: a frame of FAPs becomes vertex positions."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.spatial import cKDTree

from ..arrays import Floats, Ints
from ..errors import ParameterError
from .anatomy import Anatomy
from .bodies.contact import lip_share
from .bodies.surroundings import Surroundings
from .drive.inverse import EXACT_NOISE
from .drive.natural import EmotionShares, Natural, Plan
from .drive.wishes import (
    ASKED_DOUBT,
    LIP_DOUBT,
    LIP_FAPS,
    SILENT_DOUBT,
    Drive,
    exact_wish,
    fill,
    lip_middles,
    natural_wish,
)
from .measure import measure
from .mechanism import Mechanism
from .mechanisms.jaw import JawMotion
from .response.actuators import LID_AMPLITUDES, LID_NAMES, Amounts
from .response.folds import Folds
from .response.living_skin import Memory

#: Rounds of elastic correction where FAPs are met exactly: what contact disturbs is corrected again.
CORRECTION_ROUNDS = 3

#: Exact poses leave contact alone within this of the FAPs' points, fading, metres.
SPARED = 3.0e-3


@dataclass(frozen=True)
class Pose:
    """A posed face.

    Attributes
    ----------
    positions : (V, 3) in the face's coordinates.
    contractions : muscle name -> contraction in [0, 1].
    asked : (68,) the frame as given. goal : (68,) what the drive decided to do. achieved : (68,) measured on the
        positions. All in FAP units, NaN where silent or not measurable.
    reasons : FAP number -> why the goal differs from what was asked, natural mode only.
    """

    positions: Floats
    contractions: Mapping[str, float]
    asked: Floats
    goal: Floats
    achieved: Floats
    reasons: Mapping[int, str]


@dataclass(frozen=True)
class Sketch:
    """A quickly posed face: positions (V, 3) in the face's coordinates, muscle name -> contraction in [0, 1]."""

    positions: Floats
    contractions: Mapping[str, float]


@dataclass(frozen=True)
class SkinState:
    """One state of the outer skin in head space: displacement (n, 3), its elastic part, and the mandible."""

    displacement: Floats
    elastic: Floats
    jaw: JawMotion


class Poser:
    """Poses one face; in the natural mode with folds, unless told otherwise."""

    def __init__(self, anatomy: Anatomy, *, folds: bool = True) -> None:
        self.anatomy = anatomy
        self.natural = Natural()
        self.with_folds = folds and Mechanism.FOLDS in anatomy.mechanisms

    @cached_property
    def folds(self) -> Folds:
        """Where the skin folds; no FAP's point moves with it."""
        return Folds(self.anatomy.given_skin, self.anatomy.warp, self._points_on_skin)

    def pose(
        self, frame: Floats, drive: Drive, emotion: EmotionShares | None, contractions: Mapping[str, float] | None
    ) -> Pose:
        """The equilibrium for one frame (68,); see `Face.pose`."""
        plan = self.natural.plan(frame, emotion) if drive is Drive.NATURAL else None
        found = self.amounts(frame, drive, plan)
        amounts = self.by_hand(found, contractions) if contractions else found
        state = self.skin_state(frame, drive, plan, amounts, found=found)
        positions = self.assemble(state, drive, frame)
        goal = plan.goal if plan is not None else frame
        return Pose(
            positions=positions,
            contractions=self.anatomy.actuators.contractions(amounts),
            asked=frame.copy(),
            goal=goal.copy(),
            achieved=measure(self.anatomy, positions),
            reasons={} if plan is None else _reasons(plan),
        )

    def sketch(
        self,
        frame: Floats,
        drive: Drive,
        emotion: EmotionShares | None,
        contractions: Mapping[str, float] | None,
        memory: Memory,
    ) -> Sketch:
        """What `pose` shows, a little short of balance and not measured."""
        plan = self.natural.plan(frame, emotion) if drive is Drive.NATURAL else None
        found = self.amounts(frame, drive, plan)
        amounts = self.by_hand(found, contractions) if contractions else found
        state = self.skin_state(frame, drive, plan, amounts, found=found, memory=memory)
        return Sketch(self.assemble(state, drive, frame), self.anatomy.actuators.contractions(amounts))

    def amounts(self, frame: Floats, drive: Drive, plan: Plan | None) -> Amounts:
        """Contractions that explain the frame."""
        actuators, rows = self.anatomy.actuators, self.anatomy.inverse.rows
        if drive is Drive.POINTS:
            return actuators.amounts(np.zeros(len(actuators.prior)))
        return self.anatomy.inverse.solve(natural_wish(rows, plan) if plan is not None else exact_wish(rows, frame))

    def towards_hand(self, amounts: Amounts, contractions: Mapping[str, float], share: float) -> Amounts:
        """Amounts some of whose contractions have come a share (0..1) of the way to those set by hand."""
        now = self.anatomy.actuators.contractions(amounts)
        part = {name: (1.0 - share) * now.get(name, 0.0) + share * value for name, value in contractions.items()}
        return self.by_hand(amounts, {name: min(max(value, 0.0), 1.0) for name, value in part.items()})

    def by_hand(self, amounts: Amounts, contractions: Mapping[str, float]) -> Amounts:
        """Amounts with some contractions set by hand.

        Raises
        ------
        ParameterError : an unknown muscle, or a contraction outside 0..1.
        """
        actuators = self.anatomy.actuators
        muscles, lids, jaw = amounts.muscles.copy(), dict(amounts.lids), amounts.jaw
        index = {muscle.name: i for i, muscle in enumerate(actuators.muscles)}
        lid_index = {f"{LID_NAMES[move]}_{side}": (side, move) for side, move in actuators.lid_moves}
        hinge = ["jaw_open"] if Mechanism.JAW in self.anatomy.mechanisms else []
        for name, value in contractions.items():
            if not 0.0 <= value <= 1.0:
                raise ParameterError(f"contraction of {name}", "must be in 0..1", value)
            if name in index:
                muscles[index[name]] = value * actuators.muscles[index[name]].amplitude
            elif name in lid_index:
                lids[lid_index[name]] = value * LID_AMPLITUDES[lid_index[name][1]]
            elif name in hinge:
                jaw = JawMotion(value * float(actuators.upper[-3]) / actuators.chin_lever, jaw.left, jaw.forward)
            else:
                known = ", ".join(sorted([*index, *lid_index, *hinge]))
                raise ParameterError("muscle", f"must be one of {known}", name)
        return Amounts(muscles, lids, jaw)

    def skin_state(
        self,
        frame: Floats,
        drive: Drive,
        plan: Plan | None,
        amounts: Amounts,
        *,
        found: Amounts | None = None,
        memory: Memory | None = None,
    ) -> SkinState:
        """The outer skin under given amounts, corrected as the drive asks, without its folds.

        In the natural mode what was set by hand is wanted: `found` are the amounts before, and the difference that
        they make is not corrected away.

        In the natural mode contact has the last word; where FAPs are met exactly, their correction has, and only what
        lies away from the FAPs' points is cleared once more.
        """
        anatomy, at = self.anatomy, self.surroundings(amounts.jaw, frame)
        actuators, inverse = anatomy.actuators, anatomy.inverse
        kinematic = actuators.kinematic(amounts)
        elastic = anatomy.relaxation.muscular(amounts, memory=memory)
        if drive is Drive.MUSCLES:
            return SkinState(self.anatomy.contact.settle(kinematic + elastic, at=at), elastic, amounts.jaw)
        share = lip_share(frame if plan is None else plan.asked)
        shown = self.anatomy.contact.settle(kinematic + elastic, share, at)
        if Mechanism.CORRECTION not in anatomy.mechanisms:
            return SkinState(shown, elastic, amounts.jaw)
        target, doubts = self._targets(frame, plan)
        if plan is not None and found is not None and found is not amounts:
            target = target + np.asarray(inverse.matrix @ self._low_strain_change(found, amounts).ravel())
        for number in range(1, CORRECTION_ROUNDS + 1):
            change = inverse.correction(target - np.asarray(inverse.matrix @ shown.ravel()), doubts)
            elastic = elastic + change
            shown = shown + change
            if plan is not None:
                return SkinState(self.anatomy.contact.settle(shown, share, at), elastic, amounts.jaw)
            if number < CORRECTION_ROUNDS:
                shown = self.anatomy.contact.settle(shown, share, at)
        return SkinState(self.anatomy.contact.clear(shown, at, self._measured), elastic, amounts.jaw)

    def _low_strain_change(self, before: Amounts, after: Amounts) -> Floats:
        """(n, 3) how much further other amounts move the outer skin, metres."""
        actuators = self.anatomy.actuators
        moved = [actuators.kinematic(amounts) + actuators.muscular(amounts) for amounts in (before, after)]
        change: Floats = moved[1] - moved[0]
        return change

    @cached_property
    def _points_on_skin(self) -> Ints:
        """Vertices of the outer skin that feature points are read off."""
        return np.unique(self.anatomy.inverse.matrix.indices // 3).astype(np.int64)

    @cached_property
    def _measured(self) -> Floats:
        """(n,) 1 where FAPs are read off the skin, fading over a few millimetres."""
        positions = self.anatomy.skin.positions
        distance, _ = cKDTree(positions[self._points_on_skin]).query(positions)
        return np.asarray(np.exp(-((distance / SPARED) ** 2)))

    def surroundings(self, jaw: JawMotion, frame: Floats) -> Surroundings:
        """Where mandible and eyeballs are for a frame (68,)."""
        return Surroundings(jaw, {ball.side: ball.look(frame) for ball in self.anatomy.eyeballs})

    def folded(self, state: SkinState, drive: Drive) -> Floats:
        """(g, 3) displacement of the outer skin's own vertices, with folds in the natural mode."""
        own = state.displacement[: self.anatomy.given_skin.vertex_count]
        if drive is not Drive.NATURAL or not self.with_folds:
            return own
        return own + self.folds.displacement(own)

    def _targets(self, frame: Floats, plan: Plan | None) -> tuple[Floats, Floats]:
        """Row targets and doubts (m,) of the elastic correction."""
        rows = self.anatomy.inverse.rows
        hidden = rows.numbers == 0
        if plan is None:
            middles, loose = lip_middles(rows, fill(frame))
            return np.where(hidden, middles, rows.select(frame)), np.where(hidden, loose, 0.0)
        wish = natural_wish(rows, plan)
        asked = ~np.isnan(rows.select(plan.asked))
        doubts = np.where(asked, ASKED_DOUBT, SILENT_DOUBT)
        doubts = np.where(np.isin(rows.numbers, LIP_FAPS), LIP_DOUBT, doubts)
        doubts = np.where(hidden, wish.doubts, doubts)
        return wish.targets, np.where(wish.doubts == EXACT_NOISE, 0.0, doubts)

    def assemble(self, state: SkinState, drive: Drive, frame: Floats) -> Floats:
        """(V, 3) positions in the face's coordinates from a state of the outer skin and the direct FAPs."""
        anatomy, face_mesh = self.anatomy, self.anatomy.mesh
        moved = np.zeros_like(face_mesh.positions)
        moved[anatomy.given_skin.index] = self.folded(state, drive)
        anatomy.inner_skin.follow(moved)
        carried = anatomy.lower_teeth
        moved[carried] = anatomy.jaw.rigid(face_mesh.positions[carried], state.jaw)
        if anatomy.tongue is not None:
            opening = state.jaw.angle * anatomy.actuators.chin_lever
            moved[anatomy.tongue.index] += anatomy.tongue.displacement(frame) + anatomy.tongue.sunk(opening, frame)
        anatomy.loose_parts.follow(moved)
        for ball in anatomy.eyeballs:
            moved[ball.index] = ball.displacement(frame)
        turned = anatomy.head_turn.apply(face_mesh.positions + moved, frame)
        return face_mesh.frame.to_face(turned)


def _reasons(plan: Plan) -> dict[int, str]:
    """Reasons for every planned FAP that is not simply as asked."""
    numbers = np.flatnonzero(~np.isnan(plan.goal)) + 1
    reasons = {int(n): plan.reason(int(n)) for n in numbers}
    return {n: reason for n, reason in reasons.items() if reason != "as asked"}
