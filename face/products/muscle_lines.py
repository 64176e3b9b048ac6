"""Muscles as lines to look at: strands from attachment to insertion, rings for sphincters."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
from scipy.spatial import cKDTree

from ...arrays import Floats, Ints
from ..face import Face
from ..muscles.placement import PlacedMuscle

#: Strands of a muscle that springs from a line, points along a strand, and points of half a ring.
STRANDS, ALONG, AROUND = 4, 7, 13


@dataclass(frozen=True)
class MuscleLines:
    """One muscle as s strands of n points.

    Attributes
    ----------
    strands : (s, n, 3) at rest, in the face's coordinates.
    share : (n,) how far each point goes with the skin at the strand's end: 0 at the bone, 1 at the insertion.
    vertices : (s,) the vertex of the mesh at each strand's end.
    """

    strands: Floats
    share: Floats
    vertices: Ints

    def moved(self, displacements: Floats) -> Floats:
        """(s, n, 3) strands where the face's vertices have moved by displacements (V, 3)."""
        ends = displacements[self.vertices]
        moved: Floats = self.strands + self.share[None, :, None] * ends[:, None, :]
        return moved


def muscle_lines(face: Face) -> Mapping[str, MuscleLines]:
    """Lines of all muscles of a face by name."""
    mesh, skin = face.anatomy.mesh, face.anatomy.given_skin
    nearest = cKDTree(skin.positions)
    lines = {}
    for name, muscle in face.muscles.items():
        strands, share = _strands(muscle)
        if share.all():  # a ring lies on the skin
            strands = _smoothed(skin.positions[nearest.query(strands)[1]])
        vertices = np.asarray(skin.index[nearest.query(strands[:, -1])[1]])
        lines[name] = MuscleLines(mesh.frame.to_face(strands.reshape(-1, 3)).reshape(strands.shape), share, vertices)
    return MappingProxyType(lines)


def _strands(muscle: PlacedMuscle) -> tuple[Floats, Floats]:
    """(s, n, 3) strands in head space, and how far their points go with the end."""
    if muscle.attachment is None or muscle.insertion is None:
        return _ring(muscle), np.ones(AROUND)
    start, end = (np.atleast_2d(line) for line in (muscle.attachment, muscle.insertion))
    count = STRANDS if max(len(start), len(end)) > 1 else 1
    across = np.linspace(0.0, 1.0, count)
    first, last = (_spread(line, across) for line in (start, end))
    along = np.linspace(0.0, 1.0, ALONG)
    strands = first[:, None] + along[None, :, None] * (last - first)[:, None]
    return strands, along


def _spread(line: Floats, across: Floats) -> Floats:
    """(s, 3) places along a line (2, 3), or on a point (1, 3)."""
    spread: Floats = line[:1] + across[:, None] * (line[-1:] - line[:1])
    return spread


def _ring(muscle: PlacedMuscle) -> Floats:
    """(1, n, 3) the half of a ring on the muscle's own side, as wide and high as it reaches."""
    if muscle.centre is None or muscle.row.radii is None:
        place = next(p for p in (muscle.centre, muscle.insertion, muscle.attachment) if p is not None)
        return np.broadcast_to(np.atleast_2d(place)[:1], (1, AROUND, 3)).copy()
    wide, high = muscle.row.radii
    angle = np.linspace(-np.pi / 2.0, np.pi / 2.0, AROUND)
    out = np.stack([muscle.side * wide * np.cos(angle), high * np.sin(angle), np.zeros(AROUND)], axis=1)
    ring: Floats = (muscle.middle + out)[None]
    return ring


def _smoothed(strands: Floats) -> Floats:
    """Strands whose inner points have gone to the middle of their neighbours a few times."""
    smooth = strands.copy()
    for _ in range(3):
        smooth[:, 1:-1] = 0.5 * smooth[:, 1:-1] + 0.25 * (smooth[:, :-2] + smooth[:, 2:])
    return smooth
