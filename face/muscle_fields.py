"""Where each placed muscle pulls on the skin of one face, and how hard: force densities before the skin answers."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Floats
from ..errors import ModelError
from ..physics.muscles import LinearMuscle, Muscle, SheetMuscle, SphincterMuscle
from .mechanisms import Mechanism
from .muscle_table import Kind, MuscleRow, Region, Sides
from .outer_skin import OuterSkin, smoothstep
from .regions import off_lips, sliding
from .template import MM, TemplateWarp

#: No muscle of expression inserts in skin behind the ears: depth from which it may, metres of head space.
FACE_BEHIND = -105 * MM

MIRROR = np.array([-1.0, 1.0, 1.0])


@dataclass(frozen=True)
class PlacedMuscle:
    """One muscle, or half of a midline one, on one face.

    Attributes
    ----------
    name : row name with "_l" or "_r" for the subject's left and right.
    row : its row in the table.
    side : +1 left, -1 right.
    attachment, insertion : (3,) or (2, 3) in head space, or None; `centre` (3,) for the kinds that have one.
    amplitude : largest skin displacement at contraction 1, metres of head space.
    """

    name: str
    row: MuscleRow
    side: int
    attachment: Floats | None
    insertion: Floats | None
    centre: Floats | None
    amplitude: float

    @property
    def line(self) -> tuple[Floats, Floats]:
        """Attachment and insertion of a linear or a sheet muscle."""
        return self._given(self.attachment, "attachment"), self._given(self.insertion, "insertion")

    @property
    def middle(self) -> Floats:
        """(3,) centre of a kind that has one."""
        return self._given(self.centre, "centre")

    @property
    def pull(self) -> Floats:
        """(3,) fixed line of pull on the muscle's own side."""
        direction = self._given(self.row.direction, "direction")
        return direction if self.side > 0 else direction * MIRROR

    def _given(self, value: Floats | None, what: str) -> Floats:
        """A figure that the muscle's kind needs."""
        if value is None:
            raise ModelError(f"muscle {self.name} is of the kind {self.row.kind} and has no {what}: add it to its row")
        return value


def place_muscles(rows: dict[str, MuscleRow], warp: TemplateWarp) -> list[PlacedMuscle]:
    """Every muscle of the table on both sides of one face."""
    placed = []
    for row in rows.values():
        for side, suffix in ((1, "l"), (-1, "r")):
            turn = MIRROR if side < 0 else np.ones(3)

            def carry(place: Floats | None, turn: Floats = turn) -> Floats | None:
                return None if place is None else warp(place * turn)

            placed.append(
                PlacedMuscle(
                    name=f"{row.name}_{suffix}",
                    row=row,
                    side=side,
                    attachment=carry(row.attachment),
                    insertion=carry(row.insertion),
                    centre=carry(row.centre),
                    amplitude=row.amplitude,
                )
            )
    return placed


def region_mask(skin: OuterSkin, region: Region) -> Floats:
    """(n,) 1 where a muscle of the region may pull, falling smoothly to 0."""
    x, y = skin.positions[:, 0], skin.positions[:, 1]
    points = skin.points
    upper_lid = (points["3.1"][1] + points["3.2"][1]) / 2.0
    lower_lid = (points["3.3"][1] + points["3.4"][1]) / 2.0
    if region is Region.BROW:
        return smoothstep((y - upper_lid - 1 * MM) / (8 * MM))
    if region is Region.UPPER:
        return skin.upper_lip_side
    if region is Region.LOWER:
        return 1.0 - skin.upper_lip_side
    if region is Region.CHEEK:
        on_lower_lid = np.min([skin.lid_distances(s)[0] - skin.lid_distances(s)[1] for s in "lr"], axis=0)
        below = smoothstep((lower_lid + 14 * MM - y) / (10 * MM))
        return np.asarray(below * np.where(y > lower_lid - 4 * MM, smoothstep((on_lower_lid + 2 * MM) / (4 * MM)), 1.0))
    if region is Region.NOSE:
        return np.asarray(skin.upper_lip_side * smoothstep((34 * MM - np.abs(x)) / (10 * MM)))
    return np.ones(skin.vertex_count)


def force_density(skin: OuterSkin, muscle: PlacedMuscle) -> Floats:
    """(n, 3) pull per area of skin at full contraction, up to a factor; 0 outside the muscle's zone and region."""
    row = muscle.row
    force: Floats = _FIELDS[row.kind](skin, muscle) * region_mask(skin, row.region)[:, None]
    force *= smoothstep((skin.positions[:, 2] - FACE_BEHIND) / (30 * MM))[:, None]
    if row.sides is Sides.HALVES:
        force *= smoothstep((muscle.side * skin.positions[:, 0] / (14 * MM) + 1.0) / 2.0)[:, None]
    return force


def _tangential(skin: OuterSkin, vectors: Floats) -> Floats:
    """The part of vectors (n, 3) along the skin."""
    return np.asarray(vectors - skin.normals * (vectors * skin.normals).sum(axis=1, keepdims=True))


def _linear(skin: OuterSkin, muscle: PlacedMuscle) -> Floats:
    """Equations (6)-(13)."""
    attachment, insertion = muscle.line
    length = float(np.linalg.norm(insertion - attachment))
    row = muscle.row
    paper: Muscle = LinearMuscle(
        attachment, insertion, radius=row.reach * length, angle=row.angle, exponent=row.exponent
    )
    return paper.force(skin.positions)


def _sheet(skin: OuterSkin, muscle: PlacedMuscle) -> Floats:
    """Equations (18)-(22), drawn along the skin, fading to its lateral edges, and pulling its own origin back.

    A sheet without bony origin, such as the frontalis, draws the scalp down while it raises the brow.
    """
    attachment, insertion = muscle.line
    row = muscle.row
    origin, end = attachment.mean(axis=0), insertion.mean(axis=0)
    axis = end - origin
    length = float(np.linalg.norm(axis))
    axis = axis / length
    across = (attachment[1] - attachment[0] + insertion[1] - insertion[0]) / 2.0
    across = across - axis * (across @ axis)
    width = float(np.linalg.norm(across))
    paper: Muscle = SheetMuscle(attachment, insertion, length=row.reach * length, exponent=row.exponent)
    if not skin.has(Mechanism.FADING):
        return paper.force(skin.positions)
    away = skin.positions - origin
    latitude = np.abs(away @ (across / width)) / (width / 2.0)
    window = np.cos(np.minimum(latitude, 1.0) ** 4 * np.pi / 2.0)
    along = away @ axis / length
    reaction = row.reaction if skin.has(Mechanism.SCALP) else 0.0
    back = reaction * np.exp(-(((along - row.reaction_at) / 0.3) ** 2))
    deep = np.exp(-((np.abs(away @ np.cross(axis, across / width)) / (40 * MM)) ** 4))
    force = paper.force(skin.positions) + back[:, None] * axis
    return _tangential(skin, force * (window * deep)[:, None])


def _elliptic_radius(skin: OuterSkin, muscle: PlacedMuscle) -> tuple[Floats, Floats]:
    """Elliptic radius (n,) in the face's frontal plane, and depth behind the centre in units of the larger axis."""
    away = skin.positions - muscle.middle
    wide, high = muscle.row.radii
    radius = np.hypot(away[:, 0] / wide, away[:, 1] / high)
    depth = away[:, 2] / (1.2 * max(wide, high))
    return radius, depth


def _sphincter(skin: OuterSkin, muscle: PlacedMuscle) -> Floats:
    """Equations (14)-(17) inside the rim; beyond it the pull fades instead of ending at its maximum.

    An epicentre in front of the lips makes drawing together a protrusion.
    """
    wide, high = muscle.row.radii
    paper: Muscle = SphincterMuscle(
        muscle.middle, np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0]), semi_major=wide, semi_minor=high
    )
    if not skin.has(Mechanism.FADING):
        return paper.force(skin.positions)
    radius, _ = _elliptic_radius(skin, muscle)
    toward = muscle.middle - skin.positions
    toward = toward / np.maximum(np.linalg.norm(toward, axis=1, keepdims=True), 1e-9)
    outside = np.where(radius > 1.0, np.exp(-(((radius - 1.0) / muscle.row.fall) ** 2)), 0.0)
    return np.asarray(paper.force(skin.positions) * (radius <= 1.0)[:, None] + outside[:, None] * toward)


def _sphincter_skin(skin: OuterSkin, muscle: PlacedMuscle) -> Floats:
    """A sphincter drawn along the skin, heaping it up a little."""
    along = _tangential(skin, _sphincter(skin, muscle))
    _, depth = _elliptic_radius(skin, muscle)
    near = np.exp(-(depth**4))[:, None]
    strength = np.linalg.norm(along, axis=1, keepdims=True)
    return np.asarray(near * (along + muscle.row.bulge * strength * skin.normals))


def _window(skin: OuterSkin, muscle: PlacedMuscle) -> Floats:
    """A short sheet with a fixed line of pull inside an elliptic window."""
    radius, depth = _elliptic_radius(skin, muscle)
    reach = np.minimum(np.hypot(radius, depth), 1.0)
    weight = np.cos(reach**muscle.row.power * np.pi / 2.0)
    return np.asarray(weight[:, None] * muscle.pull)


def _band(skin: OuterSkin, muscle: PlacedMuscle) -> Floats:
    """A band of the lip's margin with a fixed line of pull."""
    radius, depth = _elliptic_radius(skin, muscle)
    return np.asarray(np.exp(-(radius**2) - depth**4)[:, None] * muscle.pull)


def _arch(skin: OuterSkin, muscle: PlacedMuscle) -> Floats:
    """A band drawn to the muscle's own side along the dental arch, a circle about a vertical axis behind the lips.

    The side that leads goes back round the teeth, the side that follows comes forward.
    """
    radius, depth = _elliptic_radius(skin, muscle)
    turn = (skin.positions[:, 0] - skin.points["8.1"][0]) / muscle.row.arch
    along = np.stack([np.ones_like(turn), np.zeros_like(turn), -turn], axis=1)
    along *= muscle.side / np.linalg.norm(along, axis=1, keepdims=True)
    return np.asarray(np.exp(-(radius**2) - depth**4)[:, None] * along)


def _pressure(skin: OuterSkin, muscle: PlacedMuscle) -> Floats:
    """Air pressure in the cheek pouch along the skin's normal: outwards for bulge 1, inwards for bulge -1.

    No bone lies under the pouch, so the pressure makes up for what the skull takes from motion along the normal
    elsewhere, and closed lips hold the mouth's corner; otherwise the corner would swell more than the cheek.
    """
    radius, depth = _elliptic_radius(skin, muscle)
    strength = muscle.row.bulge * np.exp(-(radius**2) - depth**4) * off_lips(skin) / (1.0 - sliding(skin))
    return np.asarray(strength[:, None] * skin.normals)


_FIELDS = {
    Kind.LINEAR: _linear,
    Kind.SHEET: _sheet,
    Kind.SPHINCTER: _sphincter,
    Kind.SPHINCTER_SKIN: _sphincter_skin,
    Kind.WINDOW: _window,
    Kind.BAND: _band,
    Kind.ARCH: _arch,
    Kind.PRESSURE: _pressure,
}
