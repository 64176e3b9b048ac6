"""Muscles as lines to look at: strands from attachment to insertion, rings for sphincters."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
from scipy.spatial import cKDTree

from ...arrays import Floats, Ints
from ..face import Face


@dataclass(frozen=True, eq=False)
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
        strands, share = muscle.row.strands()
        if share.all():  # a ring lies on the skin
            strands = _smoothed(skin.positions[nearest.query(strands)[1]])
        vertices = np.asarray(skin.index[nearest.query(strands[:, -1])[1]])
        places = mesh.head_frame.to_face(strands.reshape(-1, 3)).reshape(strands.shape)
        lines[name] = MuscleLines(places, share, vertices)
    return MappingProxyType(lines)


def _smoothed(strands: Floats) -> Floats:
    """Strands whose inner points have gone to the middle of their neighbours a few times."""
    smooth = strands.copy()
    for _ in range(3):
        smooth[:, 1:-1] = 0.5 * smooth[:, 1:-1] + 0.25 * (smooth[:, :-2] + smooth[:, 2:])
    return smooth
