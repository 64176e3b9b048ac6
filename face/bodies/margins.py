"""Two margins that may meet: upper and lower lip, upper and lower lid.

Where the upper margin of an opening has come below the lower one, both halves of the skin are moved back to where they
touch, fading with distance along the skin. Overlap that the neutral face has already is left alone. Lids that are all
but shut are shut along their whole length.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from scipy import sparse
from scipy.spatial.distance import cdist

from ...arrays import Floats, Ints
from ...physics.mesh import Sparse
from ..figures import Length, Pair, read_figures
from ..mesh.openings import Opening
from ..skin.outer import OuterSkin, nearer_side, smoothstep


@dataclass(frozen=True)
class MarginFigures:
    """How far a push at a margin reaches, and when lids are shut (presets/anatomy/bodies.toml)."""

    lip_reach: Length
    lid_reach: Length
    blend: Length
    shut: Pair


MARGINS = read_figures("bodies.margins", MarginFigures)

#: A push moves the partner's margin too, so the projection is repeated; each round leaves a fraction, until that is
#: less than this, metres.
ROUNDS, SETTLED = 8, 1e-6

#: A push is spread from the nearest of a margin's vertices, and from those that are hardly farther off, metres.
NEAREST = 0.05e-3

Depths: TypeAlias = "tuple[Floats, Floats]"
"""A length for each vertex of the upper and of the lower margin, metres."""


def crossing(positions: Floats, arc: Ints, partner: Ints) -> Floats:
    """(..., k) height of each vertex of an arc above its partner arc at the same place across the face, metres.

    Positions (..., n, 3) in head space; the partner is interpolated linearly between its vertices.
    """
    own, other = positions[..., arc, :2], positions[..., partner, :2]
    return np.asarray(own[..., 1] - _across(own[..., 0], other[..., 0], other[..., 1]))


def _across(places: Floats, known: Floats, values: Floats) -> Floats:
    """(..., k) values (..., l) of known places (..., l), interpolated linearly at others (..., k); beyond, the last."""
    order = np.argsort(known, axis=-1, kind="stable")
    known, values = (np.take_along_axis(each, order, axis=-1) for each in (known, values))
    places = np.clip(places, known[..., :1], known[..., -1:])
    # All moments are interpolated at once, laid one behind the other.
    behind = (np.ptp(known) + NEAREST) * np.arange(known[..., 0].size).reshape(*known.shape[:-1], 1)
    found = np.interp((places + behind).ravel(), (known + behind).ravel(), values.ravel())
    return np.asarray(found.reshape(places.shape))


def _spread(positions: Floats, arc: Ints, weight: Floats) -> Sparse:
    """(n, k) matrix that spreads values at an arc's vertices over the skin, times weight (n,); exact on the arc."""
    touched = np.flatnonzero(weight > 1e-6)
    steps = np.linalg.norm(np.diff(positions[arc], axis=0), axis=1)
    length = np.maximum(np.append(steps, 0.0) + np.append(0.0, steps), 1e-9)  # so that a denser margin counts alike
    distance = cdist(positions[touched], positions[arc])  # not the nearest few: on the midline both sides are as near
    first = distance.min(axis=1, keepdims=True)
    share = length * np.exp(-(((distance - first) / (0.5 * first + NEAREST)) ** 2))
    share *= (weight[touched] / share.sum(axis=1))[:, None]
    row, column = np.nonzero(share > 1e-12)
    return sparse.csr_array((share[row, column], (touched[row], column)), shape=(len(positions), len(arc)))


@dataclass(frozen=True, eq=False)
class Closing:
    """Margins that are drawn together: so far from where they were, and however often, so that lids close evenly.

    Attributes
    ----------
    before : how deep both margins lay beyond contact, as `Meeting.depths`. drawn : (T, 1) the share of the way, 0..1.
    """

    before: Depths
    drawn: Floats

    def some(self, chosen: Ints) -> Closing:
        """Those of some moments."""
        return Closing((self.before[0][chosen], self.before[1][chosen]), self.drawn[chosen])

    def passed(self, above: Floats, below: Floats) -> Depths:
        """How far margins at these depths are to go back, or, below 0, to be drawn on."""
        upper, lower = (
            np.where(
                (depth > 0.0) | (self.drawn == 0.0),
                np.maximum(depth, 0.0),
                np.minimum(depth - (1.0 - self.drawn) * np.minimum(before, 0.0), 0.0),
            )
            for depth, before in zip((above, below), self.before, strict=True)
        )
        return upper, lower


@dataclass(frozen=True, eq=False)
class Meeting:
    """Two margins of one opening that may meet.

    Attributes
    ----------
    upper, lower : (k,), (l,) vertices of the outer skin.
    rest : height of upper over lower, and of lower over upper (negative), at rest; metres.
    touched : (t,) vertices that pushes reach. spread : (t, k) and (t, l) pushes at the margins spread over these.
    shuts : whether margins that nearly meet are drawn together.
    """

    upper: Ints
    lower: Ints
    rest: tuple[Floats, Floats]
    touched: Ints
    spread: tuple[Sparse, Sparse]
    shuts: bool

    def depths(self, positions: Floats) -> Depths:
        """How far each vertex of the upper and of the lower margin lies beyond contact, metres; negative: apart."""
        above = crossing(positions, self.upper, self.lower)
        below = crossing(positions, self.lower, self.upper)
        return np.minimum(self.rest[0], 0.0) - above, below - np.maximum(self.rest[1], 0.0)

    def settle(
        self, positions: Floats, upper_share: Floats, slack: Depths | None = None, closing: Closing | None = None
    ) -> Floats:
        """Positions (T, n, 3) with the margins moved to contact where they had passed each other.

        The upper one takes its share (T,), 0..1, of the way and the lower one the rest. With a slack, for skin on its
        way to a pose: margins may pass each other by it. With a closing, they are drawn together as far as it says.
        """
        settled = positions
        drawn = np.zeros((len(positions), 1)) if closing is None else closing.drawn
        for _ in range(ROUNDS):
            upper, lower = self._passed(settled, slack, closing)
            pushed = np.flatnonzero(np.maximum(np.abs(upper).max(axis=1), np.abs(lower).max(axis=1)) >= SETTLED)
            if not len(pushed):
                break
            if settled is positions:
                settled = positions.copy()
            places = [settled[pushed[:, None], arc, 0] for arc in (self.upper, self.lower)]
            passed = upper[pushed], lower[pushed]
            pushes = [np.where(drawn[pushed] > 0.0, passed[i], _felt(places, passed, i)) for i in (0, 1)]
            up, down = (np.asarray(spread @ push.T).T for spread, push in zip(self.spread, pushes, strict=True))
            share = upper_share[pushed, None]
            settled[pushed[:, None], self.touched, 1] += share * up - (1.0 - share) * down
        return settled

    def _passed(self, positions: Floats, slack: Depths | None, closing: Closing | None) -> Depths:
        """How far the upper margin (T, k) has passed the lower, and it (T, l) that, as far as they are to go back."""
        above, below = self.depths(positions)
        if slack is not None:
            above, below = above - slack[0], below - slack[1]
        return (np.maximum(above, 0.0), np.maximum(below, 0.0)) if closing is None else closing.passed(above, below)

    def closing(self, positions: Floats) -> Closing | None:
        """How margins that nearly meet at positions (T, n, 3) are drawn together; None where these never are."""
        if not self.shuts:
            return None
        depths = self.depths(positions)
        open_now, open_before = np.maximum(-depths[0], 0.0).sum(axis=1, keepdims=True), np.maximum(self.rest[0], 0.0)
        closed = 1.0 - open_now / max(float(open_before.sum()), 1e-9)
        begin, full = MARGINS.shut
        return Closing(depths, smoothstep((closed - begin) / (full - begin)))


def _felt(places: Sequence[Floats], passed: Depths, own: int) -> Floats:
    """Pushes of one of two margins where either feels the other: a vertex may meet the middle of the other's edge.

    `places` (T, k) and (T, l) across the face, how far each margin has `passed` the other, and which is its `own`.
    """
    across = _across(places[own], places[1 - own], np.maximum(passed[1 - own], 0.0))
    return np.where(across > 0.0, np.maximum(passed[own], across), passed[own])


def build_meeting(skin: OuterSkin, opening: Opening, distances: tuple[Floats, Floats], *, lids: bool) -> Meeting:
    """The margins of one opening; distances (n,) along the skin from the upper and the lower one."""
    reach = MARGINS.lid_reach if lids else MARGINS.lip_reach
    on_upper = nearer_side(distances[1] - distances[0], MARGINS.blend)
    rest = skin.positions
    spread = tuple(
        _spread(rest, arc, side * (1.0 - smoothstep(distance / reach)))
        for arc, side, distance in zip(
            (opening.upper, opening.lower), (on_upper, 1.0 - on_upper), distances, strict=True
        )
    )
    touched = np.flatnonzero(sum(np.diff(each.indptr) for each in spread))
    return Meeting(
        upper=opening.upper,
        lower=opening.lower,
        rest=(crossing(rest, opening.upper, opening.lower), crossing(rest, opening.lower, opening.upper)),
        touched=touched,
        spread=(spread[0][touched], spread[1][touched]),
        shuts=lids,
    )
