"""Where a head lies in a mesh: the placement that turns template coordinates into the mesh's."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ....arrays import Floats


@dataclass(frozen=True, eq=False)
class HeadPose:
    """A rotation, a place and a size along each of the head's axes.

    Template coordinates are the default head's: metres, x to the subject's left, y to the back, z up.

    Attributes
    ----------
    axes : (3, 3) rows are the unit vectors left, back and up in the mesh's coordinates.
    origin : (3,) where the template's origin lies, in the mesh's coordinates.
    scale : (3,) mesh units per metre of the template along each axis.
    """

    axes: Floats
    origin: Floats
    scale: Floats

    @property
    def size(self) -> float:
        """Mesh units per metre of the template, all axes together."""
        return float(np.cbrt(np.prod(self.scale)))

    def to_template(self, positions: Floats) -> Floats:
        """Positions (..., 3) of the mesh in template coordinates."""
        return (positions - self.origin) @ self.axes.T / self.scale

    def to_mesh(self, positions: Floats) -> Floats:
        """Positions (..., 3) of the template in the mesh's coordinates."""
        return (positions * self.scale) @ self.axes + self.origin

    def normals_to_template(self, normals: Floats) -> Floats:
        """Unit normals (N, 3) of the mesh in template coordinates."""
        turned = normals @ self.axes.T * self.scale
        return np.asarray(turned / np.maximum(np.linalg.norm(turned, axis=1), 1e-30)[:, None], dtype=np.float64)

    def within(self, other: HeadPose) -> HeadPose:
        """This pose, given in coordinates of `other` (which has one scale), as a pose in those of the mesh."""
        return HeadPose(self.axes @ other.axes, other.to_mesh(self.origin), self.scale * other.size)

    def with_one_scale(self) -> HeadPose:
        """The same place and directions with one scale for all axes."""
        return HeadPose(self.axes, self.origin, np.full(3, self.size))
