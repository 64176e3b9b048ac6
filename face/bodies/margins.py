"""Two margins that may meet: upper and lower lip, upper and lower lid.

Where the upper margin of an opening has come below the lower one, both halves of the skin are moved back to where they
touch, fading with distance along the skin. Overlap that the neutral face has already is left alone. Lids that are all
but shut are shut along their whole length.
"""

from __future__ import annotations

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

#: A push moves the partner's margin too, so the projection is repeated; each round leaves a fraction.
ROUNDS = 8

#: A push is spread from the nearest of a margin's vertices, and from those that are hardly farther off, metres.
NEAREST = 0.05e-3

Depths: TypeAlias = "tuple[Floats, Floats]"
"""A length for each vertex of the upper and of the lower margin, metres."""


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
    distance = cdist(positions[touched], positions[arc])  # not the nearest few: on the midline both sides are as near
    first = distance.min(axis=1, keepdims=True)
    share = length * np.exp(-(((distance - first) / (0.5 * first + NEAREST)) ** 2))
    share *= (weight[touched] / share.sum(axis=1))[:, None]
    row, column = np.nonzero(share > 1e-12)
    return sparse.csr_array((share[row, column], (touched[row], column)), shape=(len(positions), len(arc)))


@dataclass(frozen=True, eq=False)
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

    def depths(self, positions: Floats) -> Depths:
        """How far each vertex of the upper and of the lower margin lies beyond contact, metres; negative: apart."""
        above = crossing(positions, self.upper, self.lower)
        below = crossing(positions, self.lower, self.upper)
        return np.minimum(self.rest[0], 0.0) - above, below - np.maximum(self.rest[1], 0.0)

    def settle(self, positions: Floats, upper_share: float, slack: Depths | None = None) -> Floats:
        """Positions (n, 3) with the margins moved to contact where they had passed each other, or were nearly shut.

        The upper one takes its share (0..1) of the way and the lower one the rest. With a slack, for skin on its way to
        a pose: margins may pass each other by it, and are not drawn together.
        """
        settled = positions
        for _ in range(ROUNDS):
            above, below = self.depths(settled)
            drawn = 0.0
            if slack is None:
                drawn = self._shut(above)
            else:
                above, below = above - slack[0], below - slack[1]
            upper, lower = np.maximum(above, drawn * above), np.maximum(below, drawn * below)
            if max(float(np.abs(upper).max()), float(np.abs(lower).max())) < 1e-6:
                break
            if drawn == 0.0:
                upper, lower = self._felt(settled, upper, lower)
            settled = settled.copy()
            up, down = np.asarray(self.spread[0] @ upper), np.asarray(self.spread[1] @ lower)
            settled[:, 1] += upper_share * up - (1.0 - upper_share) * down
        return settled

    def _felt(self, positions: Floats, upper: Floats, lower: Floats) -> Depths:
        """Pushes of both margins where either feels the other: a vertex may meet the middle of the other's edge."""
        places = [positions[arc, 0] for arc in (self.upper, self.lower)]
        pushes, felt = (upper, lower), []
        for own, other in ((0, 1), (1, 0)):
            order = np.argsort(places[other], kind="stable")
            across = np.interp(places[own], places[other][order], np.maximum(pushes[other][order], 0.0))
            felt.append(np.where(across > 0.0, np.maximum(pushes[own], across), pushes[own]))
        return felt[0], felt[1]

    def _shut(self, depth: Floats) -> float:
        """How firmly the margins are drawn together, 0..1, by how much of the opening is closed."""
        if not self.shuts:
            return 0.0
        open_now, open_before = np.maximum(-depth, 0.0).sum(), np.maximum(self.rest[0], 0.0).sum()
        closed = 1.0 - float(open_now) / max(float(open_before), 1e-9)
        begin, full = MARGINS.shut
        return float(smoothstep(np.array((closed - begin) / (full - begin))))


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
    return Meeting(
        upper=opening.upper,
        lower=opening.lower,
        rest=(crossing(rest, opening.upper, opening.lower), crossing(rest, opening.lower, opening.upper)),
        spread=(spread[0], spread[1]),
        shuts=lids,
    )
