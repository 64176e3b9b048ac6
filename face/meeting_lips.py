"""Lips that meet on their way, and what that takes from how far they are left behind.

Lips that press on each other leave each other the speed of the slower one. A lip that gives way to one that goes on is
then late when that one turns back, by more than how far skin is left behind of itself. So where lips have passed each
other at the end of a step, the step is gone through in short ones, and after each what contact puts back, and the
speed that it takes, are taken from the fields in which skin is left behind. Lids and what lies on eyeballs and teeth
are soon where they would have been without that.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..arrays import Floats
from ..physics.reduced import ReducedSkin
from .bodies.contact import Contact
from .bodies.margins import Depths, Meeting
from .mechanism import Mechanism

#: Short steps of a substep, and how far lips have passed each other where a step is gone through in these, metres.
SHORT, PASSED = 4, 1e-4


@dataclass(frozen=True, eq=False)
class LipsAt:
    """Lips at the end of a step, as they would be were nothing left behind.

    Attributes
    ----------
    positions : (m, 3) of the skin that a push at them reaches, head space, metres. felt : (2k,) of `ReducedSkin.read`.
    share : the upper lip's part of giving way. slack : how far each margin may pass the other, metres.
    """

    positions: Floats
    felt: Floats
    share: float
    slack: Depths

    def towards(self, other: LipsAt, share: float) -> LipsAt:
        """Part of the way (0..1) to another moment; what is felt is the other's."""
        rest = 1.0 - share
        above, below = (rest * a + share * b for a, b in zip(self.slack, other.slack, strict=True))
        return LipsAt(
            rest * self.positions + share * other.positions,
            other.felt,
            rest * self.share + share * other.share,
            (above, below),
        )


def lip_pushes(contact: Contact) -> Floats:
    """(2, n, 3) pushes that raise the upper lip and the lower one, m per metre; none where no lips can meet."""
    count = contact.skin.vertex_count
    if contact.lips is None or not contact.skin.has(Mechanism.CONTACT):
        return np.zeros((0, count, 3))
    pushes = np.zeros((2, count, 3))
    for push, spread in zip(pushes, contact.lips.spread, strict=True):
        push[contact.lips.touched, 1] = np.asarray(spread @ np.ones(spread.shape[1]))
    return pushes


class MeetingLips:
    """The lips of one face, and the fields in which they are left behind."""

    def __init__(self, meeting: Meeting, reduced: ReducedSkin, mass: Floats) -> None:
        """`mass` (n,) of the skin's nodes."""
        self._reduced = reduced
        self.nodes = np.unique(np.concatenate([meeting.touched, meeting.upper, meeting.lower]))
        upper, lower, touched = (
            np.searchsorted(self.nodes, each) for each in (meeting.upper, meeting.lower, meeting.touched)
        )
        self._meeting = replace(meeting, upper=upper, lower=lower, touched=touched)
        fields = reduced.fields[:, self.nodes]
        self._fields = fields.reshape(len(fields), -1)
        self._weighed = (mass[self.nodes, None] * fields).reshape(len(fields), -1)

    def have_passed(self, lips: LipsAt, state: Floats) -> bool:
        """Whether lips, left behind in a state, have passed each other by enough to feel it."""
        depths = self._meeting.depths(self._shown(lips, state)[None])
        return any(float((deep - more).max()) > PASSED for deep, more in zip(depths, lips.slack, strict=True))

    def through(self, state: Floats, before: LipsAt, after: LipsAt, passage: Floats) -> Floats:
        """The state (3k,) a substep on from a state, between two moments; the passage is that of a short step."""
        count, short = len(self._fields), self._reduced.step / SHORT
        shown = self._shown(before, state)
        for number in range(1, SHORT + 1):
            lips = before.towards(after, number / SHORT)
            state = self._reduced.follow(state, before.felt, after.felt, passage)
            free = self._shown(lips, state)
            held = self._meeting.settle(free[None], np.array([lips.share]), lips.slack)[0]
            back = held - free
            way = np.linalg.norm(back, axis=1)
            out = back / np.maximum(way, 1e-12)[:, None]
            # As for every node (`Contact.hold`): no more speed than would have taken it as far within the short step.
            inwards = np.clip(-((free - shown) / short * out).sum(axis=1), 0.0, way / short)
            state[:count] += self._weighed @ back.ravel()
            state[count : 2 * count] += self._weighed @ (inwards[:, None] * out).ravel()
            shown = self._shown(lips, state)
        return state

    def _shown(self, lips: LipsAt, state: Floats) -> Floats:
        """(m, 3) where lips are."""
        return np.asarray(lips.positions + (state[: len(self._fields)] @ self._fields).reshape(lips.positions.shape))


def each_of(positions: Floats, felts: Floats, shares: Floats, slack: Depths) -> Sequence[LipsAt]:
    """Lips at T moments, of arrays of T."""
    return [
        LipsAt(place, felt, float(share), (above[None], below[None]))
        for place, felt, share, above, below in zip(positions, felts, shares, *slack, strict=True)
    ]
