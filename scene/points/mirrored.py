"""The other side of a face: the plane that mirrors a mesh, or its feature points, and places beyond it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from mathutils import Vector

from ...arrays import Floats
from ...mpeg4 import FEATURE_POINTS
from .bound import Surface

#: Vertices that symmetry is tried with.
TRIED = 800
#: A mesh is symmetric when this share of its mirrored vertices lies within that share of its diagonal of its surface.
ALIKE, WITHIN = 0.9, 6e-3


@dataclass(frozen=True, eq=False)
class MirrorPlane:
    """A plane: unit normal (3,) and distance from the origin along it, in the mesh's own coordinates."""

    normal: Floats
    offset: float

    def reflected(self, place: Floats) -> Floats:
        """(3,) the place on the other side."""
        other: Floats = place - 2.0 * (float(place @ self.normal) - self.offset) * self.normal
        return other


def plane_of_points(places: Mapping[str, Floats]) -> MirrorPlane | None:
    """The plane between left and right feature points; None without a pair of them."""
    pairs = [(places[name], places[other]) for name, other in _pairs() if name in places and other in places]
    if not pairs:
        return None
    left, right = (np.array(side) for side in zip(*pairs, strict=True))
    across = (left - right).sum(axis=0)
    length = float(np.linalg.norm(across))
    if not length > 0.0:
        return None
    normal = across / length
    return MirrorPlane(normal, float(np.median((left + right) / 2.0 @ normal)))


def plane_of_mesh(surface: Surface) -> MirrorPlane | None:
    """The plane across one of the mesh's own axes that it is symmetric about; None where there is none."""
    low, high = surface.vertices.min(axis=0), surface.vertices.max(axis=0)
    reach = WITHIN * float(np.linalg.norm(high - low))
    tried = surface.vertices[:: max(1, len(surface.vertices) // TRIED)]
    best, share = None, ALIKE
    for axis in range(3):
        plane = MirrorPlane(np.eye(3)[axis], float(low[axis] + high[axis]) / 2.0)
        near = [surface.tree.find_nearest(Vector(plane.reflected(place)), reach)[0] is not None for place in tried]
        if np.mean(near) > share:
            best, share = plane, float(np.mean(near))
    return best


def _pairs() -> list[tuple[str, str]]:
    """Left points, each with the right one."""
    return [(n, p.mirror) for n, p in FEATURE_POINTS.items() if p.mirror is not None and p.side.value == "left"]
