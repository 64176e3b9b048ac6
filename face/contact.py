"""Contact: lips and lids that meet without passing through each other, and lids that stay off the eyeballs.

Projections of the posed skin. Where the upper margin of an opening has come below the lower one, both halves of the
skin are moved back to where they touch, fading with distance along the skin. Overlap that the neutral face has already
is left alone. Lids that are all but shut are shut along their whole length. What is not modelled: one lip over the
other, and lips against teeth.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from scipy import sparse
from scipy.spatial.distance import cdist

from ..arrays import Floats, Ints
from ..physics.mesh import Sparse
from .mechanisms import Mechanism
from .mechanisms.lids import Eye
from .openings import Opening
from .outer_skin import OuterSkin, smoothstep
from .template import MM

#: Distance along the skin over which a push at the margin fades out, metres.
LIP_REACH, LID_REACH = 16.0 * MM, 9.0 * MM

#: Share of the way back that the upper margin takes: lips give way alike unless one is asked to move, upper lids do.
LIP_SHARE, LID_SHARE = 0.5, 0.9

#: FAPs that move the upper and the lower lip up or down, inner and outer; requests below some units count as none.
UPPER_LIP_FAPS, LOWER_LIP_FAPS = (4, 8, 9, 51, 55, 56), (5, 10, 11, 52, 57, 58)
UNFELT = 2.0

#: Lids closed beyond the first share of their opening are drawn together, fully at the second.
SHUT_FROM, SHUT_AT = 0.86, 0.96

#: Within this of the border between both halves, metres, a push is shared by both.
BLEND = 1.0 * MM

#: A push moves the partner's margin too, so the projection is repeated; each round leaves a fraction.
ROUNDS = 3

#: Lid skin is kept off the eyeball within the first distance of the lid's edge, fading to the second, metres.
CLEAR_WITHIN, CLEAR_UNTIL = 4.0 * MM, 8.0 * MM


def crossing(positions: Floats, arc: Ints, partner: Ints) -> Floats:
    """(k,) height of each vertex of an arc above its partner arc at the same place across the face, metres.

    Positions (n, 3) in head space; the partner is interpolated linearly between its vertices.
    """
    other = positions[partner]
    order = np.argsort(other[:, 0], kind="stable")
    below: Floats = np.interp(positions[arc, 0], other[order, 0], other[order, 1])
    height: Floats = positions[arc, 1] - below
    return height


def _spread(positions: Floats, arc: Ints, weight: Floats) -> Sparse:
    """(n, k) matrix that spreads values at an arc's vertices over the skin, times weight (n,); exact on the arc."""
    touched = np.flatnonzero(weight > 1e-6)
    steps = np.linalg.norm(np.diff(positions[arc], axis=0), axis=1)
    length = np.maximum(np.append(steps, 0.0) + np.append(0.0, steps), 1e-9)  # so that a denser margin counts alike
    distance = cdist(positions[touched], positions[arc])
    first = distance.min(axis=1, keepdims=True)
    share = length * np.exp(-(((distance - first) / (0.5 * first + 0.05 * MM)) ** 2))
    share *= (weight[touched] / share.sum(axis=1))[:, None]
    row, column = np.nonzero(share > 1e-12)
    return sparse.csr_array((share[row, column], (touched[row], column)), shape=(len(positions), len(arc)))


@dataclass(frozen=True)
class Meeting:
    """Two margins of one opening that may meet.

    Attributes
    ----------
    upper, lower : (k,), (l,) vertices of the outer skin.
    rest : height of upper over lower, and of lower over upper (negative), at rest; metres.
    spread : (n, k) and (n, l) pushes at the margins spread over the skin.
    shuts : whether margins that nearly meet are drawn together.
    """

    upper: Ints
    lower: Ints
    rest: tuple[Floats, Floats]
    spread: tuple[Sparse, Sparse]
    shuts: bool

    def depths(self, positions: Floats) -> tuple[Floats, Floats]:
        """How far each vertex of the upper and of the lower margin lies beyond contact, metres; negative: apart."""
        above = crossing(positions, self.upper, self.lower)
        below = crossing(positions, self.lower, self.upper)
        return np.minimum(self.rest[0], 0.0) - above, below - np.maximum(self.rest[1], 0.0)

    def settle(self, positions: Floats, upper_share: float) -> Floats:
        """Positions (n, 3) with the margins moved to contact where they had passed each other, or were nearly shut.

        The upper one takes its share (0..1) of the way and the lower one the rest.
        """
        settled = positions
        for _ in range(ROUNDS):
            depths = self.depths(settled)
            drawn = self._shut(depths[0])
            push = [np.maximum(depth, drawn * depth) for depth in depths]
            if max(float(np.abs(p).max()) for p in push) < 1e-6:
                break
            settled = settled.copy()
            up, down = self.spread[0] @ push[0], self.spread[1] @ push[1]
            settled[:, 1] += upper_share * up - (1.0 - upper_share) * down
        return settled

    def _shut(self, depth: Floats) -> float:
        """How firmly the margins are drawn together, 0..1, by how much of the opening is closed."""
        if not self.shuts:
            return 0.0
        open_now, open_before = np.maximum(-depth, 0.0).sum(), np.maximum(self.rest[0], 0.0).sum()
        closed = 1.0 - float(open_now) / max(float(open_before), 1e-9)
        return float(smoothstep(np.array((closed - SHUT_FROM) / (SHUT_AT - SHUT_FROM))))


def _meeting(skin: OuterSkin, opening: Opening, distances: tuple[Floats, Floats], *, lids: bool) -> Meeting:
    """The margins of one opening; distances (n,) along the skin from the upper and the lower one."""
    reach = LID_REACH if lids else LIP_REACH
    on_upper = smoothstep(((distances[1] - distances[0]) / BLEND + 1.0) / 2.0)
    rest = skin.positions
    spread = tuple(
        _spread(rest, arc, side * (1.0 - smoothstep(distance / reach)))
        for arc, side, distance in zip(
            (opening.upper, opening.lower), (on_upper, 1.0 - on_upper), distances, strict=True
        )
    )
    return Meeting(
        upper=opening.upper,
        lower=opening.lower,
        rest=(crossing(rest, opening.upper, opening.lower), crossing(rest, opening.lower, opening.upper)),
        spread=(spread[0], spread[1]),
        shuts=lids,
    )


def lip_share(asked: Floats) -> float:
    """The upper lip's part of the way back, 0..1, for requests (68,): a lip that is asked to move pushes the other."""
    wanted = np.abs(np.nan_to_num(asked))
    upper, lower = (UNFELT + float(wanted[np.array(faps) - 1].sum()) for faps in (UPPER_LIP_FAPS, LOWER_LIP_FAPS))
    return lower / (upper + lower)


class Contact:
    """The contacts of one face's outer skin."""

    def __init__(self, skin: OuterSkin, eyes: Mapping[str, Eye]) -> None:
        self.skin = skin
        self.lips = _meeting(skin, skin.mouth, skin.lip_distances, lids=False)
        self.lids = {side: _meeting(skin, skin.eyes[side], skin.lid_distances(side), lids=True) for side in eyes}
        self._eyes = dict(eyes)
        self._near = {}
        for side in eyes:
            distance = np.min(skin.lid_distances(side), axis=0)
            self._near[side] = 1.0 - np.clip((distance - CLEAR_WITHIN) / (CLEAR_UNTIL - CLEAR_WITHIN), 0.0, 1.0)

    def settle(self, displacement: Floats, lip_share: float = LIP_SHARE) -> Floats:
        """The displacement (n, 3) of the outer skin in head space, metres, with every contact resolved.

        `lip_share` is the upper lip's part of the way back (`lip_share`).
        """
        if not self.skin.has(Mechanism.CONTACT):
            return displacement
        rest = self.skin.positions
        positions = self.lips.settle(rest + displacement, lip_share)
        for lids in self.lids.values():
            positions = lids.settle(positions, LID_SHARE)
        return self.clear_eyes(positions - rest)

    def clear_eyes(self, displacement: Floats) -> Floats:
        """The displacement (n, 3) with lid skin kept off the eyeballs, as far as at rest or nearly."""
        if not self.skin.has(Mechanism.CONTACT):
            return displacement
        rest = self.skin.positions
        positions = rest + displacement
        for side, eye in self._eyes.items():
            positions = eye.clear(positions, rest, self._near[side])
        return positions - rest
