"""The mandible: a hinge about the jaw joints that also slides forward and sideways, and the skin it carries.

The skin is not glued to the bone: a weight field, itself an elastic equilibrium between mandible, skull and neck,
says how far each place follows. Source: rigid fit and weights read off scanned jaw motions (docs/muscles.md).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arrays import Floats
from ...physics.elastic import Factor, elastic_matrix
from ..mechanism import Mechanism
from ..mesh.template import MM, TEMPLATE_POINTS, TemplateWarp
from ..skin.outer import OuterSkin, smoothstep
from .separation import upper_lip_side

#: The axis lies this far from the ear's lower contact 10.7, head space, metres.
HINGE_FROM_EAR = np.array([0.0, 10.0, -1.0]) * MM

JAW_BENDING_LENGTH = 24.0 * MM
JAW_ANCHOR_LENGTH = 16.625 * MM
JAW_STIFFNESS = 1.0 / (13.13 * MM) ** 2
CHIN_WEIGHT = 0.9

#: The floor of the mouth, squeezed between mandible and neck, bulges along its normal: height per squared sine of the
#: opening angle (there is slack first), place on the template and extent (side, height, depth), metres. Fitted to a
#: scanned open jaw: its residual under the chin lies along the normal for 83 %; this one window explains 94 % of that.
FLOOR_BULGE = 82.7 * MM
FLOOR_CENTRE = np.array([0.0, -72.8, -59.2]) * MM
FLOOR_EXTENT = np.array([69.0, 23.8, 40.9]) * MM

#: The cheek beside the mouth, stretched between the jaws, hollows along its normal and slips up over the mandible:
#: metres per squared sine, place on the template (left side) and extent (side, height, depth). Fitted to a scanned jaw:
#: one window explains 77 % of what the turning mandible leaves there.
HOLLOW, SLIP = -51.9 * MM, 35.4 * MM
HOLLOW_CENTRE = np.array([33.7, -23.7, -39.8]) * MM
HOLLOW_EXTENT = np.array([22.5, 24.0, 26.2]) * MM


@dataclass(frozen=True)
class JawMotion:
    """Where the mandible is: opening angle (rad, positive opens), slide to the subject's left and forward (metres)."""

    angle: float = 0.0
    left: float = 0.0
    forward: float = 0.0


@dataclass(frozen=True)
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

    def rigid(self, positions: Floats, motion: JawMotion) -> Floats:
        """Displacement (k, 3) of points (k, 3) fixed to the mandible itself: teeth, tongue, bone."""
        cosine, sine = np.cos(motion.angle), np.sin(motion.angle)
        y, z = positions[:, 1] - self.hinge[1], positions[:, 2] - self.hinge[2]
        moved = np.empty_like(positions)
        moved[:, 0] = motion.left
        moved[:, 1] = (cosine - 1.0) * y - sine * z
        moved[:, 2] = sine * y + (cosine - 1.0) * z + motion.forward
        return moved

    def turned(self, directions: Floats, motion: JawMotion) -> Floats:
        """Directions (k, 3) fixed to the mandible, in head space."""
        cosine, sine = np.cos(motion.angle), np.sin(motion.angle)
        x, y, z = directions.T
        return np.stack([x, cosine * y - sine * z, sine * y + cosine * z], axis=1)

    def unmoved(self, positions: Floats, motion: JawMotion) -> Floats:
        """Where places (k, 3) of head space lie for one who sits on the mandible: `rigid` undone."""
        slid = positions - np.array([motion.left, 0.0, motion.forward])
        return self.hinge + self.turned(slid - self.hinge, JawMotion(-motion.angle))

    def skin(self, positions: Floats, motion: JawMotion) -> Floats:
        """Displacement (n, 3) of the outer skin."""
        bulged = max(float(np.sin(motion.angle)), 0.0) ** 2 * self.bulge
        return np.asarray(self.weights[:, None] * self.rigid(positions, motion) + bulged)

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
    lower_lip = 1.0 - upper_lip_side(skin, 8 * MM)
    below_mouth = 1.0 - _above_line(skin.positions, corner, angle + np.array([0.0, 20 * MM, 0.0]), 16 * MM)
    above_jaw = _above_line(
        skin.positions, chin - np.array([0.0, 4 * MM, 0.0]), angle - np.array([0.0, 4 * MM, 0.0]), 10 * MM
    )
    before_angle = smoothstep((skin.positions[:, 2] - angle[2]) / (14 * MM) + 0.5)
    return lower_lip * below_mouth * above_jaw * before_angle


def build_jaw(skin: OuterSkin, warp: TemplateWarp) -> Jaw:
    """The mandible of a face from its ears, chin and lips."""
    points = skin.points
    ears = [points[n] if n in points else warp(TEMPLATE_POINTS[n]) for n in ("10.7", "10.8")]
    hinge = (ears[0] + ears[1]) / 2.0 + HINGE_FROM_EAR
    hinge[0] = (points["8.3"][0] + points["8.4"][0]) / 2.0
    if not skin.has(Mechanism.JAW):
        return Jaw(hinge, np.zeros(skin.vertex_count), np.zeros((skin.vertex_count, 3)))
    mask = mandible_mask(skin)
    y = skin.positions[:, 1]
    held = 0.02 * smoothstep((y + 5 * MM) / (20 * MM)) + 0.02 * smoothstep((-y - 105 * MM) / (20 * MM))
    pull = JAW_STIFFNESS * mask
    stiffness = elastic_matrix(
        skin.laplacian, skin.areas, JAW_BENDING_LENGTH**2, _rest_anchor(skin) + held / MM**2 + pull
    )
    weights = Factor(stiffness).solve(skin.areas * pull)
    boss = np.argmin(np.linalg.norm(skin.positions - points["2.10"], axis=1))
    weights *= CHIN_WEIGHT / max(float(weights[boss]), 1e-6)
    beside = _floor_bulge(skin, warp) + _cheek_hollow(skin, warp)
    return Jaw(hinge=hinge, weights=np.clip(weights, 0.0, 1.0), bulge=beside)


def _floor_bulge(skin: OuterSkin, warp: TemplateWarp) -> Floats:
    """(n, 3) bulge of the floor of the mouth per squared sine of the opening angle."""
    if not skin.has(Mechanism.FLOOR):
        return np.zeros_like(skin.positions)
    away = (skin.positions - warp(FLOOR_CENTRE)) / FLOOR_EXTENT
    window = np.exp(-(away[:, 0] ** 4) - away[:, 1] ** 2 - away[:, 2] ** 2)
    below = smoothstep((skin.points["2.3"][1] - 12 * MM - skin.positions[:, 1]) / (15 * MM))
    return FLOOR_BULGE * (window * below)[:, None] * skin.normals


def _cheek_hollow(skin: OuterSkin, warp: TemplateWarp) -> Floats:
    """(n, 3) hollowing and slipping of the cheeks per squared sine of the opening angle."""
    if not skin.has(Mechanism.HOLLOW):
        return np.zeros_like(skin.positions)
    window = np.zeros(skin.vertex_count)
    for side in (1.0, -1.0):
        away = (skin.positions - warp(HOLLOW_CENTRE * np.array([side, 1.0, 1.0]))) / HOLLOW_EXTENT
        window += np.exp(-(away**2).sum(axis=1))
    return np.asarray(window[:, None] * (HOLLOW * skin.normals + np.array([0.0, SLIP, 0.0])))


def _rest_anchor(skin: OuterSkin) -> Floats:
    """(n,) ties to the skull, 1/m^2; weak under the chin, whose floor goes with the jaw."""
    under = smoothstep((skin.positions[:, 1] + 70 * MM) / (20 * MM))
    return (0.2 + 0.8 * under) / JAW_ANCHOR_LENGTH**2
