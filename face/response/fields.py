"""Where each placed muscle pulls on the skin of one face, and how hard: force densities before the skin answers.

The second paper's three classes, and windows with a fixed line of pull, stand here; what belongs to one mechanism alone
stands in its file.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from ...arrays import Floats
from ...physics.muscles import LinearMuscle, Muscle, SheetMuscle
from ..mechanism import Mechanism
from ..mechanisms import brow, buccinator, cheek, nose, orbicularis_oris
from ..mechanisms.separation import upper_lip_side
from ..mesh.template import MM
from ..muscles.placement import PlacedMuscle
from ..muscles.table import Kind, Region, Sides
from ..skin.outer import OuterSkin, smoothstep

#: No muscle of expression inserts in skin behind the ears: depth from which it may, metres of head space.
FACE_BEHIND = -105 * MM


def force_density(skin: OuterSkin, muscle: PlacedMuscle) -> Floats:
    """(n, 3) pull per area of skin at full contraction, up to a factor; 0 outside the muscle's zone and region."""
    row = muscle.row
    force: Floats = _FIELDS[row.kind](skin, muscle) * region_mask(skin, row.region)[:, None]
    force *= smoothstep((skin.positions[:, 2] - FACE_BEHIND) / (30 * MM))[:, None]
    if row.sides is Sides.HALVES:
        force *= orbicularis_oris.half(skin, muscle.side)[:, None]
    return force


def region_mask(skin: OuterSkin, region: Region) -> Floats:
    """(n,) 1 where a muscle of the region may pull, falling smoothly to 0."""
    return _REGIONS[region](skin) if region in _REGIONS else np.ones(skin.vertex_count)


def _linear(skin: OuterSkin, muscle: PlacedMuscle) -> Floats:
    """Equations (6)-(13); superficial muscles pull along the skin that they lie in, not along a chord through it."""
    attachment, insertion = muscle.line
    length = float(np.linalg.norm(insertion - attachment))
    row = muscle.row
    paper: Muscle = LinearMuscle(
        attachment, insertion, radius=row.reach * length, angle=row.angle, exponent=row.exponent
    )
    force = paper.force(skin.positions)
    if row.along_skin == 0.0 or not skin.has(Mechanism.SUPERFICIAL):
        return force
    return np.asarray(force + row.along_skin * (_tangential(skin, force) - force))


def _sheet(skin: OuterSkin, muscle: PlacedMuscle) -> Floats:
    """Equations (18)-(22), drawn along the skin, fading to its lateral edges, and pulling its own origin back."""
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
    back = brow.scalp_reaction(skin, away @ axis / length, row.reaction, row.reaction_at)
    deep = np.exp(-((np.abs(away @ np.cross(axis, across / width)) / (40 * MM)) ** 4))
    force = paper.force(skin.positions) + back[:, None] * axis
    return _tangential(skin, force * (window * deep)[:, None])


def _sphincter_skin(skin: OuterSkin, muscle: PlacedMuscle) -> Floats:
    """A sphincter drawn along the skin, heaping it up a little."""
    along = _tangential(skin, orbicularis_oris.ring(skin, muscle))
    _, depth = muscle.elliptic_radius(skin.positions)
    near = np.exp(-(depth**4))[:, None]
    strength = np.linalg.norm(along, axis=1, keepdims=True)
    return np.asarray(near * (along + muscle.row.bulge * strength * skin.normals))


def _window(skin: OuterSkin, muscle: PlacedMuscle) -> Floats:
    """A short sheet with a fixed line of pull inside an elliptic window."""
    radius, depth = muscle.elliptic_radius(skin.positions)
    reach = np.minimum(np.hypot(radius, depth), 1.0)
    weight = np.cos(reach**muscle.row.power * np.pi / 2.0)
    return np.asarray(weight[:, None] * muscle.pull)


def _tangential(skin: OuterSkin, vectors: Floats) -> Floats:
    """The part of vectors (n, 3) along the skin."""
    return np.asarray(vectors - skin.normals * (vectors * skin.normals).sum(axis=1, keepdims=True))


_FIELDS: Mapping[Kind, Callable[[OuterSkin, PlacedMuscle], Floats]] = {
    Kind.LINEAR: _linear,
    Kind.SHEET: _sheet,
    Kind.SPHINCTER: orbicularis_oris.ring,
    Kind.SPHINCTER_SKIN: _sphincter_skin,
    Kind.WINDOW: _window,
    Kind.BAND: orbicularis_oris.band,
    Kind.ARCH: buccinator.arch,
    Kind.PRESSURE: cheek.pressure,
}

#: Regions that are not the whole face.
_REGIONS: Mapping[Region, Callable[[OuterSkin], Floats]] = {
    Region.BROW: brow.region,
    Region.CHEEK: cheek.region,
    Region.NOSE: nose.region,
    Region.UPPER: upper_lip_side,
    Region.LOWER: lambda skin: 1.0 - upper_lip_side(skin),
}
