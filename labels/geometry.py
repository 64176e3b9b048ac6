"""What stands before the camera in one frame: all triangles of the scene, and which of them are the face."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import Bools, Floats, Ints


@dataclass(frozen=True, eq=False)
class Shown:
    """The triangles of a scene as one frame shows them; of the world, in metres.

    Attributes
    ----------
    vertices : (V, 3). triangles : (T, 3) of them.
    normals : (T, 3, 3) with which the corners of the triangles are shaded.
    owner : (T,) which object each triangle belongs to, its place in `objects`.
    objects : names.
    source : (V,) which vertex of the face each one shows; -1 where it is of something else.
    """

    vertices: Floats
    triangles: Ints
    normals: Floats
    owner: Ints
    objects: Sequence[str]
    source: Ints

    @property
    def is_face(self) -> Bools:
        """(T,) which triangles are of the face."""
        return np.asarray(self.source[self.triangles[:, 0]] >= 0)
