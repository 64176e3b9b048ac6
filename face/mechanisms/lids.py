"""The eyes of one face: eyeballs that turn, lids that turn about them, pupils that widen.

A lid is a sheet on a ball: it moves by turning about the horizontal axis through the eyeball's centre, the whole
margin by nearly the same angle, and slides a little towards the nose as it closes. Source: scanned blinks
(docs/muscles.md).
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from ...arrays import Floats
from ..mechanism import Mechanism
from ..mesh.sphere import fit_sphere
from ..mesh.template import MM
from ..skin.outer import OuterSkin, smoothstep

#: Centre of the eyeball behind the middle of the two eye corners, template head space: inwards, up, forward (metres).
CENTRE_FROM_CORNERS = np.array([0.9, 1.5, -9.5]) * MM

#: Metres towards the nose per metre of closing: orbicularis fibres spring from the inner corner, so that closing the
#: upper lid draws the lower one along, which hardly rises (scanned blink: 2 to 3 mm); and the lower lid as it rises.
NASAL_SLIDE_LOWER = 0.5
NASAL_SLIDE_RISING = 0.42
NASAL_SLIDE_UPPER = 0.2

#: Squared bending length of the lids relative to other skin.
LID_BENDING = 0.25

#: Ties of the tarsal plate, 1/mm^2; scanned frowns move the brow 4 mm aside and the lid's edge 0.2 mm.
PLATE_FIRMNESS = 0.02

#: Where the motion of the upper lid ends, along the eye from the inner corner (0) to the outer one (1), and over which
#: length it fades: the outer corner's hood goes along, further when the lid opens.
CLOSING_END = (1.15, 0.14)
OPENING_END = (1.3, 0.3)
LOWER_END = (1.03, 0.14)


class LidMove(StrEnum):
    """The four movements of a pair of lids; each is a muscle of its own and only pulls one way."""

    UPPER_CLOSE = "upper_close"
    UPPER_OPEN = "upper_open"
    LOWER_UP = "lower_up"
    LOWER_DOWN = "lower_down"


#: Point that measures a move, and the sign of its angle (positive turns downwards).
_MOVES = {
    LidMove.UPPER_CLOSE: ("upper", 1.0),
    LidMove.UPPER_OPEN: ("upper", -1.0),
    LidMove.LOWER_UP: ("lower", -1.0),
    LidMove.LOWER_DOWN: ("lower", 1.0),
}


@dataclass(frozen=True)
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

    def angles(self, moves: dict[LidMove, float]) -> tuple[Floats, Floats]:
        """Angles (n,) and nasal slides (n,) of the skin for lid movements in metres at the middle of the lid."""
        angle = np.zeros_like(next(iter(self.weights.values())))
        slide = np.zeros_like(angle)
        for move, amount in moves.items():
            turn = amount * self.angle_per_metre[move]
            angle += _MOVES[move][1] * turn * self.weights[move]
            slide += turn * self.slides[move]
        return angle, slide

    def skin(self, positions: Floats, moves: dict[LidMove, float]) -> Floats:
        """Displacement (n, 3) of the outer skin by lid movements, as exact rotations about the eyeball's axis."""
        angle, slide = self.angles(moves)
        y, z = positions[:, 1] - self.centre[1], positions[:, 2] - self.centre[2]
        cosine, sine = np.cos(angle), np.sin(angle)
        moved = np.zeros_like(positions)
        moved[:, 0] = slide * (-1.0 if self.side == "l" else 1.0)
        moved[:, 1] = (cosine - 1.0) * y - sine * z
        moved[:, 2] = sine * y + (cosine - 1.0) * z
        return moved


def near_lids(skin: OuterSkin) -> Floats:
    """(n,) 1 within 6 mm of a lid's edge, 0 beyond 16 mm."""
    return 1.0 - smoothstep((skin.lid_edge_distance - 6 * MM) / (10 * MM))


def thickness(skin: OuterSkin) -> Floats:
    """(n,) squared bending length relative to other skin: lids are the thinnest skin of the body."""
    return 1.0 - (1.0 - LID_BENDING) * near_lids(skin)


def firmness(skin: OuterSkin) -> Floats:
    """(n,) what the lids' plates add to the skin's ties, 1/m^2.

    Tarsal plate and canthal tendons hold the lid's edge sideways: a brow that is drawn to the nose slides over it.
    """
    plate = 1.0 - smoothstep((skin.lid_edge_distance - 2 * MM) / (6 * MM))
    return np.asarray(PLATE_FIRMNESS / MM**2 * plate)


def _fissure_position(skin: OuterSkin, side: str) -> Floats:
    """(n,) where a vertex lies along the eye: 0 at the inner corner, 1 at the outer one."""
    inner, outer = (
        (skin.points["3.11"], skin.points["3.7"]) if side == "l" else (skin.points["3.8"], skin.points["3.12"])
    )
    axis = outer - inner
    along: Floats = (skin.positions - inner) @ axis / (axis @ axis)
    return along


def _taper(along: Floats, end: tuple[float, float]) -> Floats:
    """(n,) full in the middle of the lid, 0 at its inner corner and at its `end` (place, length of fading)."""
    return smoothstep((along + 0.04) / 0.26) * smoothstep((end[0] - along) / end[1])


def build_eye(skin: OuterSkin, side: str, eyeball: Floats | None) -> Eye:
    """One eye from its points, the skin, and the eyeball's vertices (k, 3) in head space where the mesh has them."""
    names = ("3.11", "3.7", "3.1", "3.3") if side == "l" else ("3.8", "3.12", "3.2", "3.4")
    inner, outer, top, bottom = (skin.points[n] for n in names)
    if eyeball is not None and len(eyeball) >= 12:
        centre, radius = fit_sphere(eyeball)
    else:
        inwards = np.array([-1.0 if side == "l" else 1.0, 1.0, 1.0])
        centre = (inner + outer) / 2.0 + CENTRE_FROM_CORNERS * inwards
        radius = float(min(np.linalg.norm(top - centre), np.linalg.norm(bottom - centre))) - 0.3 * MM
    upper, lower = skin.lid_distances(side)
    along = _fissure_position(skin, side)
    lower_taper = _taper(along, LOWER_END)
    on_upper = smoothstep(((lower - upper) / (2 * MM) + 1.0) / 2.0)
    on_lower = 1.0 - on_upper
    weights = {
        LidMove.UPPER_CLOSE: _taper(along, CLOSING_END) * on_upper * (1.0 - smoothstep(upper / (8.0 * MM))),
        LidMove.UPPER_OPEN: _taper(along, OPENING_END) * on_upper * (1.0 - smoothstep((upper - 3 * MM) / (9 * MM))),
        LidMove.LOWER_UP: lower_taper * on_lower * (1.0 - smoothstep(lower / (14 * MM))),
        LidMove.LOWER_DOWN: lower_taper * on_lower * (1.0 - smoothstep(lower / (14 * MM))),
    }
    middle = np.exp(-(((along - 0.4) / 0.5) ** 2))
    drawn = on_lower * (1.0 - smoothstep(lower / (14 * MM))) * _taper(along + 0.05, (1.18, 0.2))
    slides: dict[LidMove, Floats] = {move: np.zeros(skin.vertex_count) for move in LidMove}
    if skin.has(Mechanism.LID_SLIDE):
        slides[LidMove.UPPER_CLOSE] = (
            radius * middle * (NASAL_SLIDE_UPPER * weights[LidMove.UPPER_CLOSE] + NASAL_SLIDE_LOWER * drawn)
        )
        slides[LidMove.LOWER_UP] = NASAL_SLIDE_RISING * radius * weights[LidMove.LOWER_UP] * middle
    per_metre = {}
    for move in LidMove:
        point = top if _MOVES[move][0] == "upper" else bottom
        per_metre[move] = 1.0 / max(float(point[2] - centre[2]), 0.3 * radius)
    return Eye(side=side, centre=centre, radius=radius, weights=weights, slides=slides, angle_per_metre=per_metre)
