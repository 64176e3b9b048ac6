"""The eyes of one face: eyeballs that turn, lids that turn about them, pupils that widen.

A lid is a sheet on a ball: it moves by turning about the horizontal axis through the eyeball's centre, the whole
margin by nearly the same angle, and slides a little towards the nose as it closes. Source: scanned blinks
(docs/muscles.md).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...arrays import Floats, Ints
from ..figures import Length, Pair, Place, Share, read_figures
from ..mechanism import Mechanism
from ..mesh.eye_parts import is_flat
from ..mesh.sphere import fit_sphere
from ..skin.outer import OuterSkin, nearer_side, smoothstep
from .lid_movers import LidMove


@dataclass(frozen=True, eq=False)
class BallFigures:
    """The eyeball of a face that has none (presets/anatomy/lids.toml, as those below)."""

    from_corners: Place
    lid_thickness: Length


@dataclass(frozen=True)
class LidSkinFigures:
    """How the lids' skin differs."""

    bending: Share
    near: Pair
    plate_firmness: float
    plate: Pair


@dataclass(frozen=True)
class LidExtentFigures:
    """What skin goes with the lids: places along the eye with lengths of fading, and distances from their edges."""

    inner: Pair
    closing_outer: Pair
    opening_outer: Pair
    lower_outer: Pair
    closing: Length
    opening: Pair
    lower: Length
    between: Length


@dataclass(frozen=True)
class LidSlideFigures:
    """How lids slide towards the nose."""

    upper: Share
    lower: Share
    rising: Share
    middle: Pair
    drawn_inner: Pair
    drawn_outer: Pair


BALL = read_figures("lids.eyeball", BallFigures)
LID_SKIN = read_figures("lids.skin", LidSkinFigures)
EXTENT = read_figures("lids.extent", LidExtentFigures)
SLIDE = read_figures("lids.slide", LidSlideFigures)

#: The eyeball's centre lies at least so many of its radii behind the lid's middle: what turns the lid is no shorter.
SHORTEST_LEVER = 0.3

#: An eyeball needs this many vertices to be measured.
MEASURABLE = 12

#: Point that measures a move, and the sign of its angle (positive turns downwards).
_MOVES = {
    LidMove.UPPER_CLOSE: ("upper", 1.0),
    LidMove.UPPER_OPEN: ("upper", -1.0),
    LidMove.LOWER_UP: ("lower", -1.0),
    LidMove.LOWER_DOWN: ("lower", 1.0),
}


@dataclass(frozen=True, eq=False)
class Eye:
    """One eye in head space.

    Attributes
    ----------
    side : "l" or "r", the subject's.
    centre, radius : the ball the lids turn about, metres.
    weights : move -> (n,) share of the move's angle that each skin vertex turns by.
    slides : move -> (n,) metres towards the nose per radian.
    angle_per_metre : move -> radians that move the lid's middle by one metre.
    """

    side: str
    centre: Floats
    radius: float
    weights: dict[LidMove, Floats]
    slides: dict[LidMove, Floats]
    angle_per_metre: dict[LidMove, float]

    @cached_property
    def near(self) -> Ints:
        """(k,) skin vertices that any move takes along."""
        moved = [share != 0.0 for share in (*self.weights.values(), *self.slides.values())]
        return np.flatnonzero(np.any(moved, axis=0))

    @cached_property
    def _near_shares(self) -> Mapping[LidMove, tuple[Floats, Floats]]:
        """Move -> (k,) radians that vertices turn by, and metres that they slide, where a lid's middle goes a metre."""
        return {
            move: (_MOVES[move][1] * rate * self.weights[move][self.near], rate * self.slides[move][self.near])
            for move, rate in self.angle_per_metre.items()
        }

    def carried(self, positions: Floats, moves: Mapping[LidMove, Floats]) -> Floats:
        """Displacements (T, k, 3) of the `near` skin by lid movements, as exact rotations about the eyeball's axis.

        positions : (n, 3) of the skin. moves : (T,) metres at the middle of the lid; one or more.
        """
        angle, slide = np.zeros((2, len(next(iter(moves.values()))), len(self.near)))
        for move, amount in moves.items():
            turned, slid = self._near_shares[move]
            angle, slide = angle + amount[:, None] * turned, slide + amount[:, None] * slid
        y, z = positions[self.near, 1] - self.centre[1], positions[self.near, 2] - self.centre[2]
        sine, fall = np.sin(angle), np.cos(angle) - 1.0
        nasal = slide * (-1.0 if self.side == "l" else 1.0)
        return np.stack([nasal, fall * y - sine * z, sine * y + fall * z], axis=2)

    def skin(self, positions: Floats, moves: Mapping[LidMove, float]) -> Floats:
        """Displacement (n, 3) of the outer skin by lid movements, metres at the middle of the lid."""
        moved = np.zeros_like(positions)
        moved[self.near] = self.carried(positions, {move: np.array([amount]) for move, amount in moves.items()})[0]
        return moved


def near_lids(skin: OuterSkin) -> Floats:
    """(n,) 1 beside a lid's edge, 0 away from it."""
    within, over = LID_SKIN.near
    return 1.0 - smoothstep((skin.lid_edge_distance - within) / over)


def thickness(skin: OuterSkin) -> Floats:
    """(n,) squared bending length relative to other skin: lids are the thinnest skin of the body."""
    return 1.0 - (1.0 - LID_SKIN.bending) * near_lids(skin)


def firmness(skin: OuterSkin) -> Floats:
    """(n,) what the lids' plates add to the skin's ties, 1/m^2.

    Tarsal plate and canthal tendons hold the lid's edge sideways: a brow that is drawn to the nose slides over it.
    """
    within, over = LID_SKIN.plate
    return LID_SKIN.plate_firmness * (1.0 - smoothstep((skin.lid_edge_distance - within) / over))


def _fissure_position(skin: OuterSkin, side: str) -> Floats:
    """(n,) where a vertex lies along the eye: 0 at the inner corner, 1 at the outer one."""
    inner, outer = (
        (skin.points["3.11"], skin.points["3.7"]) if side == "l" else (skin.points["3.8"], skin.points["3.12"])
    )
    axis = outer - inner
    along: Floats = (skin.positions - inner) @ axis / (axis @ axis)
    return along


def _taper(along: Floats, outer: Pair, inner: Pair = EXTENT.inner) -> Floats:
    """(n,) full in the middle of the lid, 0 beyond its inner and outer end (place, length of fading)."""
    return smoothstep((along - inner[0]) / inner[1]) * smoothstep((outer[0] - along) / outer[1])


def _ball_behind(side: str, middle: Floats, top: Floats, bottom: Floats) -> tuple[Floats, float]:
    """Centre and radius of the ball behind an eye that has none, from the middles (3,) of its corners and lids."""
    inwards = np.array([-1.0 if side == "l" else 1.0, 1.0, 1.0])
    centre: Floats = middle + BALL.from_corners * inwards
    nearest = float(min(np.linalg.norm(top - centre), np.linalg.norm(bottom - centre)))
    return centre, nearest - BALL.lid_thickness


def build_eye(skin: OuterSkin, side: str, eyeball: Floats | None) -> Eye:
    """One eye from its points, the skin, and the eyeball's vertices (k, 3) in head space where the mesh has them."""
    names = ("3.11", "3.7", "3.1", "3.3") if side == "l" else ("3.8", "3.12", "3.2", "3.4")
    inner, outer, top, bottom = (skin.points[n] for n in names)
    if eyeball is not None and len(eyeball) >= MEASURABLE and not is_flat(eyeball):
        centre, radius = fit_sphere(eyeball)
    else:
        centre, radius = _ball_behind(side, (inner + outer) / 2.0, top, bottom)
    upper, lower = skin.lid_distances(side)
    along = _fissure_position(skin, side)
    on_upper = nearer_side(lower - upper, EXTENT.between)
    within, over = EXTENT.opening
    closing, opening = 1.0 - smoothstep(upper / EXTENT.closing), 1.0 - smoothstep((upper - within) / over)
    below = (1.0 - on_upper) * (1.0 - smoothstep(lower / EXTENT.lower))
    weights = {
        LidMove.UPPER_CLOSE: _taper(along, EXTENT.closing_outer) * on_upper * closing,
        LidMove.UPPER_OPEN: _taper(along, EXTENT.opening_outer) * on_upper * opening,
        LidMove.LOWER_UP: _taper(along, EXTENT.lower_outer) * below,
        LidMove.LOWER_DOWN: _taper(along, EXTENT.lower_outer) * below,
    }
    if side in skin.sewn:
        weights = {move: np.zeros(skin.vertex_count) for move in LidMove}
    middle = np.exp(-(((along - SLIDE.middle[0]) / SLIDE.middle[1]) ** 2))
    drawn = below * _taper(along, SLIDE.drawn_outer, SLIDE.drawn_inner)
    slides: dict[LidMove, Floats] = {move: np.zeros(skin.vertex_count) for move in LidMove}
    if skin.has(Mechanism.LID_SLIDE) and side not in skin.sewn:
        slides[LidMove.UPPER_CLOSE] = (
            radius * middle * (SLIDE.upper * weights[LidMove.UPPER_CLOSE] + SLIDE.lower * drawn)
        )
        slides[LidMove.LOWER_UP] = SLIDE.rising * radius * weights[LidMove.LOWER_UP] * middle
    per_metre = {}
    for move in LidMove:
        point = top if _MOVES[move][0] == "upper" else bottom
        per_metre[move] = 1.0 / max(float(point[2] - centre[2]), SHORTEST_LEVER * radius)
    return Eye(side=side, centre=centre, radius=radius, weights=weights, slides=slides, angle_per_metre=per_metre)
