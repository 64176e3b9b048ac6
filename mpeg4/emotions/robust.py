"""The robust rule: how well each profile explains all that a face was seen to do, and whether the face rests.

The paper's product has weaknesses that matter on real faces: one FAP that a face does not show kills a profile; a
profile is judged by its own FAPs alone, so that sadness, which says nothing of the mouth, is not contradicted by a
broad smile; there is no neutral face. So here

- every FAP that was seen counts for every profile: where the profile asks for it by its membership, elsewhere by how
  far it is from rest. Both are weighed by how sure the value is. A profile that asks for one FAP of a lip, a lid or a
  brow knows the others of it (`places.TOGETHER`).
- a profile may be shown at any strength up to its own (section 4.1, Rule 2), and what it does not ask for is measured
  by how much the face moves at all: an expression that grows is the same expression all the way, and a weak smile
  counts against sadness as a broad one does.
- what lifts the upper lip lifts its outer contour, too (`LIFTED`); pressed lips move the inner one alone.
- the neutral face is a verdict. It is believed as far as the three places of the face that moved most have not left
  rest: an expression moves several, noise, a blink or a twitch one. Emotions are believed as far as the
  face does not rest.
- where the neutral face is doubtful, each profile may have the neutral face that suits it best, at a price: so much
  as the doubt makes it unlikely.
- anger with a shut mouth is known beside the angers of Table 5, all of which leave the lips alone or part them
  (`beside`).

Source: own choice; the figures of the constants were chosen on one half of the faces of docs/evidence.md.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np

from ...arrays import Bools, Floats
from ..standard import FAP_COUNT
from .beside import known_classes
from .fuzzy import LEAST_SEEN, LEAST_WIDTH, FuzzyClass
from .places import by_place, known, largest, usual

#: Shares of a profile that are tried.
STRENGTHS = (1.0, 0.85, 0.7, 0.55, 0.4, 0.3, 0.2, 0.1)

#: A place rests, to one half, where its FAPs are this share of what profiles usually ask, or so many units, from 0.
REST_SHARE, REST_LEAST = 0.2, 50.0

#: Less belief in the neutral face than this takes nothing off an emotion.
LEAST_REST = 0.05

#: How much a face moves, 0..1: this times the shares of what profiles usually ask, of which no more than so much counts
#: at one FAP; a face that moves less than the least is judged as if it did.
MOVED_SHARE, MOVED_CAP, MOVED_LEAST = 0.65, 3.0, 0.4

#: Motion that a profile does not ask for halves a membership at this share of what profiles usually ask of the FAP,
#: times how much the face moves, and takes at most so many halvings off.
UNASKED_SHARE, UNASKED_MOST = 1.25, 4.0

#: Halvings by which one FAP can count against a profile that asks for it: no FAP decides alone.
ASKED_MOST = 16.0

#: FAPs of the upper lip's inner contour -> those of the outer one at the same place. Levators lie outside the lip,
#: so that a profile that asks for the one asks for the other; shut lips roll in by the orbicularis alone.
LIFTED = {4: 51, 8: 55, 9: 56}

#: Price of a neutral face, in halvings, per squared standard deviation: -log2 of exp(-1/2).
DOUBT_PRICE = 0.5 / float(np.log(2.0))

#: Rounds in which values that are far off are weighed down while the neutral face is sought, and frames at once.
ROUNDS, CHUNK = 3, 16

#: Distances in widths -> halvings of the membership.
Fall = Callable[[Floats], Floats]


@dataclass(frozen=True, eq=False)
class Judgement:
    """What the robust rule says of n frames.

    Attributes
    ----------
    beliefs : (n, k) in each profile, 0..1. neutral : (n,) that the face rests; NaN where too little was seen to tell.
    against : (n, k, 68) halvings that each FAP takes off each profile.
    """

    beliefs: Floats
    neutral: Floats
    against: Floats


@dataclass(frozen=True, eq=False)
class RobustRule:
    """k profiles, ready to be judged by.

    Attributes
    ----------
    asked, unasked : (k, 68) FAPs that a profile asks for, and those that count against it where they move.
    centres, widths : (k, 68) FAP units; 0 and 1 where not asked.
    usual : (68,) what profiles of Table 5 ask of a FAP, FAP units.
    strengths : shares of a profile that are tried.
    """

    asked: Bools
    unasked: Bools
    centres: Floats
    widths: Floats
    usual: Floats
    strengths: tuple[float, ...]

    @classmethod
    def of(cls, classes: Sequence[FuzzyClass], strengths: tuple[float, ...] = STRENGTHS) -> RobustRule:
        """The rule for these fuzzy classes."""
        shape = (len(classes), FAP_COUNT)
        asked, centres, widths = np.zeros(shape, dtype=np.bool_), np.zeros(shape), np.ones(shape)
        for row, fuzzy in enumerate(classes):
            columns = list(fuzzy.indices)
            asked[row, columns], centres[row, columns], widths[row, columns] = True, fuzzy.centres, fuzzy.widths
        for inner, outer in LIFTED.items():
            rows = asked[:, inner - 1] & ~asked[:, outer - 1]
            for table in (asked, centres, widths):
                table[rows, outer - 1] = table[rows, inner - 1]
        sizes = usual()
        return cls(asked, (sizes > 0.0) & ~known(asked), centres, widths, sizes, strengths)

    def judge(
        self,
        frames: Floats,
        *,
        visible: Bools | None = None,
        confidence: Floats | None = None,
        doubt: Floats | None = None,
        fall: Fall = np.square,
    ) -> Judgement:
        """Judge frames.

        Parameters
        ----------
        frames : (n, 68) FAPs, NaN where not seen. visible : (68,) FAPs that could be seen at all.
        confidence : (n, 68) 0..1, in each frame beside that of the surest value; None: the same everywhere.
        doubt : (68, m) FAP units: errors of the neutral face, each as large as one standard deviation.
        fall : what a distance from a centre, in widths, takes off.
        """
        seen = ~np.isnan(frames) & (True if visible is None else visible)
        sure = np.where(seen, 1.0 if confidence is None else confidence, 0.0)
        sure = sure / np.maximum(sure.max(axis=1, keepdims=True), 1e-9)
        parts = [slice(first, first + CHUNK) for first in range(0, len(frames), CHUNK)]
        judged = [self._judge(np.nan_to_num(frames[part]), sure[part], doubt, fall) for part in parts]
        asked = self.asked & (True if visible is None else visible)
        told = (seen[:, None] & asked).sum(axis=2) >= np.maximum(LEAST_SEEN * asked.sum(axis=1), 1.0)
        fits, rests, against = (np.concatenate(columns) for columns in zip(*judged, strict=True))
        expressed = 1.0 - np.clip((rests - LEAST_REST) / (1.0 - LEAST_REST), 0.0, 1.0)
        return Judgement(
            np.where(told, fits * expressed[:, None], 0.0), np.where(told.any(axis=1), rests, np.nan), against
        )

    def _judge(self, values: Floats, sure: Floats, doubt: Floats | None, fall: Fall) -> tuple[Floats, Floats, Floats]:
        """(n, k) how well each profile fits at its best strength; (n,) how far the face rests; (n, k, 68) halvings."""
        moved = self._moved(values, sure)[:, None, None]
        least = LEAST_WIDTH * moved
        unasked = np.maximum(UNASKED_SHARE * self.usual * moved, least)
        use = (self.asked | self.unasked) * sure[:, None]
        most = np.where(self.asked, ASKED_MOST, UNASKED_MOST)
        tried = [
            _explained(
                values,
                share * self.centres,
                np.where(self.asked, np.maximum(share * self.widths, least), unasked),
                use,
                most,
                doubt,
                fall,
            )
            for share in self.strengths
        ]
        halvings, against = np.array([each[0] for each in tried]), np.array([each[1] for each in tried])
        best = halvings.argmin(axis=0)[None]
        fits = np.exp2(-np.take_along_axis(halvings, best, axis=0)[0])
        at_best: Floats = np.take_along_axis(against, best[..., None], axis=0)[0]
        return fits, self._rests(values, sure, doubt), at_best

    def _moved(self, values: Floats, sure: Floats) -> Floats:
        """(n,) how much faces move, from `MOVED_LEAST` to 1."""
        shares = values / np.where(self.usual > 0.0, self.usual, np.inf)
        moved = largest(np.abs(by_place(np.clip(shares, -MOVED_CAP, MOVED_CAP), sure)))
        return np.clip(MOVED_SHARE * moved, MOVED_LEAST, 1.0)

    def _rests(self, values: Floats, sure: Floats, doubt: Floats | None) -> Floats:
        """(n,) beliefs that faces rest; a doubtful neutral face is the one with which they rest best."""
        widths = np.maximum(REST_SHARE * self.usual, REST_LEAST)
        use = sure * (self.usual > 0.0)
        rest, price = values, np.zeros(len(values))
        if doubt is not None and doubt.size:
            shift = _best_neutral(rest[:, None], widths, use[:, None], np.full(FAP_COUNT, ASKED_MOST), doubt)[:, 0]
            rest = rest - shift @ doubt.T
            price = DOUBT_PRICE * (shift**2).sum(axis=1) / np.maximum(use.sum(axis=1), 1e-9)
        most = np.sqrt(ASKED_MOST)
        off = by_place(np.clip(rest / widths, -most, most), sure) ** 2
        return np.asarray(np.exp2(-(largest(off) + price)))


def _explained(
    values: Floats, targets: Floats, widths: Floats, use: Floats, most: Floats, doubt: Floats | None, fall: Fall
) -> tuple[Floats, Floats]:
    """Halvings that values (n, 68) take off profiles (k, 68), (n, k) on the whole and (n, k, 68) by FAP.

    `use` (n, k, 68) weighs each FAP; `most` (k, 68) is what one may take off.
    """
    rest = values[:, None] - targets
    total = np.maximum(use.sum(axis=2), 1e-9)
    price = np.zeros(use.shape[:2])
    if doubt is not None and doubt.size:
        shift = _best_neutral(rest, widths, use, most, doubt)
        rest = rest - shift @ doubt.T
        price = DOUBT_PRICE * (shift**2).sum(axis=2)
    by_fap = use * np.minimum(fall(np.abs(rest) / widths), most) / total[..., None]
    return by_fap.sum(axis=2) + price / total, by_fap


def _best_neutral(rest: Floats, widths: Floats, use: Floats, most: Floats, doubt: Floats) -> Floats:
    """(n, k, m) the error of the neutral face, in standard deviations, that explains the rest best at its price."""
    trust = np.ones_like(rest)
    for _ in range(ROUNDS):
        weight = use * trust / widths**2
        normal = np.einsum("im,nki,il->nkml", doubt, weight, doubt, optimize=True)
        normal += DOUBT_PRICE * np.eye(doubt.shape[1])
        shift: Floats = np.linalg.solve(normal, ((weight * rest) @ doubt)[..., None])[..., 0]
        off = ((rest - shift @ doubt.T) / widths) ** 2
        trust = np.minimum(1.0, most / np.maximum(off, 1e-9))
    return shift


@cache
def archetype_rule() -> RobustRule:
    """The rule for all profiles of Table 5 and beside it, in the order of `known_classes`."""
    return RobustRule.of(list(known_classes().values()))
