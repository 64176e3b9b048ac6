"""The mandible: a hinge about the jaw joints that also slides forward and sideways, and the skin it carries.

The skin is not glued to the bone: a weight field, itself an elastic equilibrium between mandible, skull and neck,
says how far each place follows. Source: rigid fit and weights read off scanned jaw motions (docs/muscles.md).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arrays import Floats
from ...physics.elastic import Factor, elastic_matrix
from ..figures import Extent, Length, Pair, Place, Share, read_figures
from ..mechanism import Mechanism
from ..mesh.template import TEMPLATE_POINTS, TemplateWarp
from ..skin.outer import OuterSkin, smoothstep
from .separation import upper_lip_side


@dataclass(frozen=True, eq=False)
class HingeFigures:
    """Where the mandible turns (presets/anatomy/jaw.toml, as those below)."""

    from_ear: Place


@dataclass(frozen=True)
class MandibleFigures:
    """Borders of the skin that lies over the mandible."""

    lips: Length
    angle_rise: Length
    cheek_over: Length
    edge_below: Length
    edge_over: Length
    angle_over: Length


@dataclass(frozen=True)
class FollowFigures:
    """How far the skin follows the mandible."""

    bending_length: Length
    anchor_length: Length
    pull_length: Length
    chin: Share
    held: float
    held_above: Pair
    held_below: Pair
    floor: Share
    floor_below: Pair


@dataclass(frozen=True, eq=False)
class FloorFigures:
    """The floor of the mouth, squeezed between mandible and neck, bulges."""

    bulge: Length
    centre: Place
    extent: Extent
    below_lip: Pair


@dataclass(frozen=True, eq=False)
class HollowFigures:
    """The cheek beside the mouth, stretched between the jaws, hollows and slips up over the mandible."""

    sinking: Length
    slip: Length
    centre: Place
    extent: Extent


HINGE = read_figures("jaw.hinge", HingeFigures)
MANDIBLE = read_figures("jaw.mandible", MandibleFigures)
FOLLOW = read_figures("jaw.follow", FollowFigures)
FLOOR = read_figures("jaw.floor", FloorFigures)
HOLLOW = read_figures("jaw.hollow", HollowFigures)


@dataclass(frozen=True)
class JawMotion:
    """Where the mandible is: opening angle (rad, positive opens), slide to the subject's left and forward (metres)."""

    angle: float = 0.0
    left: float = 0.0
    forward: float = 0.0


@dataclass(frozen=True, eq=False)
class Jaw:
    """The mandible of one face in head space.

    Attributes
    ----------
    hinge : (3,) a point on the axis, which runs left to right.
    weights : (n,) how far each vertex of the outer skin follows, 0 to 1.
    bulge : (n, 3) where floor of the mouth and cheeks go besides, metres per squared sine of the opening angle.
    """

    hinge: Floats
    weights: Floats
    bulge: Floats

    def rigid(self, positions: Floats, motion: JawMotion | Floats) -> Floats:
        """Displacement (..., k, 3) of points (k, 3) fixed to the mandible itself, by one motion or several (..., 3)."""
        angle, left, forward = _figures(motion)
        cosine, sine = np.cos(angle), np.sin(angle)
        y, z = positions[:, 1] - self.hinge[1], positions[:, 2] - self.hinge[2]
        moved = np.empty((*angle.shape[:-1], *positions.shape))
        moved[..., 0] = left
        moved[..., 1] = (cosine - 1.0) * y - sine * z
        moved[..., 2] = sine * y + (cosine - 1.0) * z + forward
        return moved

    def turned(self, directions: Floats, motion: JawMotion | Floats) -> Floats:
        """Directions (..., k, 3) fixed to the mandible, in head space, by one motion or several (..., 3)."""
        angle = _figures(motion)[0]
        cosine, sine = np.cos(angle), np.sin(angle)
        x, y, z = np.moveaxis(directions, -1, 0)
        return np.stack([x, cosine * y - sine * z, sine * y + cosine * z], axis=-1)

    def unmoved(self, positions: Floats, motion: JawMotion | Floats) -> Floats:
        """Where places (..., k, 3) of head space lie for one who sits on the mandible: `rigid` undone."""
        angle, left, forward = _figures(motion)
        slid = positions - np.stack([left, np.zeros_like(left), forward], axis=-1)
        back = np.concatenate([-angle, np.zeros((*angle.shape[:-1], 2))], axis=-1)
        return self.hinge + self.turned(slid - self.hinge, back)

    def skin(self, positions: Floats, motion: JawMotion | Floats) -> Floats:
        """Displacement (..., n, 3) of the outer skin, by one motion or several (..., 3)."""
        moved = self.rigid(positions, motion)
        moved *= self.weights[:, None]
        moved += np.maximum(np.sin(_figures(motion)[0]), 0.0)[..., None] ** 2 * self.bulge
        return moved

    def ways(self, positions: Floats) -> Floats:
        """(5, n, 3) fields that `skin` is a sum of, by `shares`."""
        y, z = positions[:, 1] - self.hinge[1], positions[:, 2] - self.hinge[2]
        ways = np.zeros((5, *positions.shape))
        ways[0, :, 0] = ways[1, :, 2] = 1.0
        ways[2, :, 1], ways[2, :, 2] = -z, y
        ways[3, :, 1], ways[3, :, 2] = y, z
        ways[:4] *= self.weights[:, None]
        ways[4] = self.bulge
        return ways

    def shares(self, motions: Floats) -> Floats:
        """(..., 5) how much of each of `ways` several motions (..., 3) are."""
        angle, left, forward = np.moveaxis(motions, -1, 0)
        sine = np.sin(angle)
        return np.stack([left, forward, sine, np.cos(angle) - 1.0, np.maximum(sine, 0.0) ** 2], axis=-1)

    def derivatives(self, positions: Floats, motion: JawMotion) -> Floats:
        """(3, n, 3) change of `skin` per radian of opening and per metre of slide left and forward, at a motion."""
        cosine, sine = np.cos(motion.angle), np.sin(motion.angle)
        y, z = positions[:, 1] - self.hinge[1], positions[:, 2] - self.hinge[2]
        change = np.zeros((3, *positions.shape))
        change[0, :, 1] = -sine * y - cosine * z
        change[0, :, 2] = cosine * y - sine * z
        change[1, :, 0] = 1.0
        change[2, :, 2] = 1.0
        change *= self.weights[None, :, None]
        change[0] += 2.0 * max(sine, 0.0) * cosine * self.bulge
        return change


def _figures(motion: JawMotion | Floats) -> tuple[Floats, Floats, Floats]:
    """Angle, slide to the left and slide forward, (..., 1) each, of one motion or of several (..., 3)."""
    figures = np.array([motion.angle, motion.left, motion.forward]) if isinstance(motion, JawMotion) else motion
    return figures[..., 0:1], figures[..., 1:2], figures[..., 2:3]


def _above_line(positions: Floats, start: Floats, end: Floats, blend: float) -> Floats:
    """(n,) 1 above the line start-end as seen from the side (y over z), 0 below, over a blend in metres."""
    slope = (start[1] - end[1]) / (start[2] - end[2])
    height = end[1] + slope * (positions[:, 2] - end[2])
    return smoothstep((positions[:, 1] - height) / blend + 0.5)


def mandible_mask(skin: OuterSkin) -> Floats:
    """(n,) 1 where the skin lies over the mandible: below lips and cheek, above the jaw line, before its angle."""
    points = skin.points
    corner = (points["8.3"] + points["8.4"]) / 2.0
    chin = points["2.1"]
    angle = (points["2.13"] + points["2.14"]) / 2.0 if "2.13" in points and "2.14" in points else None
    if angle is None:
        angle = (TEMPLATE_POINTS["2.13"] + TEMPLATE_POINTS["2.14"]) / 2.0
    up = np.array([0.0, 1.0, 0.0])
    lower_lip = 1.0 - upper_lip_side(skin, MANDIBLE.lips)
    below_mouth = 1.0 - _above_line(skin.positions, corner, angle + MANDIBLE.angle_rise * up, MANDIBLE.cheek_over)
    edge = (chin - MANDIBLE.edge_below * up, angle - MANDIBLE.edge_below * up)
    above_jaw = _above_line(skin.positions, *edge, MANDIBLE.edge_over)
    before_angle = smoothstep((skin.positions[:, 2] - angle[2]) / MANDIBLE.angle_over + 0.5)
    return lower_lip * below_mouth * above_jaw * before_angle


def build_jaw(skin: OuterSkin, warp: TemplateWarp) -> Jaw:
    """The mandible of a face from its ears, chin and lips."""
    points = skin.points
    ears = [points[n] if n in points else warp(TEMPLATE_POINTS[n]) for n in ("10.7", "10.8")]
    hinge = (ears[0] + ears[1]) / 2.0 + HINGE.from_ear
    hinge[0] = (points["8.3"][0] + points["8.4"][0]) / 2.0
    if not skin.has(Mechanism.JAW):
        return Jaw(hinge, np.zeros(skin.vertex_count), np.zeros((skin.vertex_count, 3)))
    pull = mandible_mask(skin) / FOLLOW.pull_length**2
    anchor = _rest_anchor(skin) + _held(skin) + pull
    stiffness = elastic_matrix(skin.laplacian, skin.areas, FOLLOW.bending_length**2, anchor)
    weights = Factor(stiffness).solve(skin.areas * pull)
    boss = np.argmin(np.linalg.norm(skin.positions - points["2.10"], axis=1))
    weights *= FOLLOW.chin / max(float(weights[boss]), 1e-6)
    beside = _floor_bulge(skin, warp) + _cheek_hollow(skin, warp)
    return Jaw(hinge=hinge, weights=np.clip(weights, 0.0, 1.0), bulge=beside)


def _floor_bulge(skin: OuterSkin, warp: TemplateWarp) -> Floats:
    """(n, 3) bulge of the floor of the mouth per squared sine of the opening angle."""
    if not skin.has(Mechanism.FLOOR):
        return np.zeros_like(skin.positions)
    away = (skin.positions - warp(FLOOR.centre)) / FLOOR.extent
    window = np.exp(-(away[:, 0] ** 4) - away[:, 1] ** 2 - away[:, 2] ** 2)
    begin, over = FLOOR.below_lip
    below = smoothstep((skin.points["2.3"][1] - begin - skin.positions[:, 1]) / over)
    return FLOOR.bulge * (window * below)[:, None] * skin.normals


def _cheek_hollow(skin: OuterSkin, warp: TemplateWarp) -> Floats:
    """(n, 3) hollowing and slipping of the cheeks per squared sine of the opening angle."""
    if not skin.has(Mechanism.HOLLOW):
        return np.zeros_like(skin.positions)
    window = np.zeros(skin.vertex_count)
    for side in (1.0, -1.0):
        away = (skin.positions - warp(HOLLOW.centre * np.array([side, 1.0, 1.0]))) / HOLLOW.extent
        window += np.exp(-(away**2).sum(axis=1))
    return np.asarray(window[:, None] * (np.array([0.0, HOLLOW.slip, 0.0]) - HOLLOW.sinking * skin.normals))


def _rest_anchor(skin: OuterSkin) -> Floats:
    """(n,) ties to the skull, 1/m^2; weak under the chin, whose floor goes with the jaw."""
    height, over = FOLLOW.floor_below
    above = smoothstep((skin.positions[:, 1] - height) / over)
    return (FOLLOW.floor + (1.0 - FOLLOW.floor) * above) / FOLLOW.anchor_length**2


def _held(skin: OuterSkin) -> Floats:
    """(n,) extra ties above the mouth and below the chin, 1/m^2."""
    y = skin.positions[:, 1]
    (top, top_over), (bottom, bottom_over) = FOLLOW.held_above, FOLLOW.held_below
    return FOLLOW.held * (smoothstep((y - top) / top_over) + smoothstep((bottom - y) / bottom_over))
