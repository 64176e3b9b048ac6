"""Where a face is, which way it looks and how large it is, read off its feature points.

Inside `face/` every computation runs in *head space*: x to the subject's left, y up, z forward, origin at the
subnasale (9.15), in metres and scaled so that the eyes are as far apart as on the template. A face in
centimetres, lying on its back or a hundred times too large is therefore the same face, and every length of the
anatomy tables means the same on it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ...arrays import Floats
from ...errors import ModelError
from .fap_units import TEMPLATE_FAPU
from .template import TEMPLATE_POINTS

#: A face is modelled along its mesh's axes, Z up in Blender and Y up elsewhere. Within this angle it is measured along
#: them: whoever made it decided what is upright, and no points tell it so well.
MODELLED_TOLERANCE = np.radians(10.0)

#: Points that hardly move with expression and hardly depend on the person: they carry the head frame.
FRAME_POINTS = (
    "3.7", "3.11", "3.8", "3.12", "9.15", "9.3", "9.12", "4.3", "4.4", "8.3", "8.4", "2.10", "10.9", "10.10",
    "2.13", "2.14",
)  # fmt: skip


@dataclass(frozen=True, eq=False)
class HeadFrame:
    """A similarity between a face's own coordinates and head space.

    Attributes
    ----------
    axes : (3, 3) rows are the unit vectors left, up and forward in the face's coordinates.
    origin : (3,) the subnasale in the face's coordinates.
    scale : the face's size over the template's, in the face's units per metre of head space.
    """

    axes: Floats
    origin: Floats
    scale: float

    def to_head(self, positions: Floats) -> Floats:
        """Positions (..., 3) of the face as positions in head space (metres)."""
        return (positions - self.origin) @ self.axes.T / self.scale

    def to_face(self, positions: Floats) -> Floats:
        """Positions (..., 3) of head space as positions of the face."""
        placed: Floats = positions @ (self.axes * self.scale)
        placed += self.origin
        return placed


def rotation_between(source: Floats, target: Floats) -> Floats:
    """Rotation R (3, 3) with R @ source ~ target for centred point sets (n, 3) (Kabsch)."""
    u, _, vt = np.linalg.svd(target.T @ source)
    flip = np.diag([1.0, 1.0, np.sign(np.linalg.det(u @ vt))])
    rotation: Floats = u @ flip @ vt
    return rotation


def head_frame_of(points: Mapping[str, Floats], axes: Floats | None = None) -> HeadFrame:
    """The head frame of a neutral face from its feature points.

    Parameters
    ----------
    points : name -> (3,) position in the face's coordinates; needs 9.15, 3.5, 3.6 and most of `FRAME_POINTS`.
    axes : (3, 3) rows left, up and forward in the face's coordinates; None: derived from the points.

    Raises
    ------
    ModelError : when fewer than six of these points are known, or they do not form a face.
    """
    axes = _axes(points) if axes is None else axes
    origin = np.asarray(points["9.15"], dtype=np.float64)
    eyes = (np.array([points["3.5"], points["3.6"]]) - origin) @ axes.T
    es0 = eyes[0, 0] - eyes[1, 0]
    ens0 = eyes[:, 1].mean()
    scale = (es0 / TEMPLATE_FAPU.es0 + ens0 / TEMPLATE_FAPU.ens0) / 2.0
    if not scale > 0.0:
        raise ModelError("the pupils 3.5 and 3.6 are below the nose or swapped: 3.5 is the subject's left eye")
    return HeadFrame(axes=axes, origin=origin, scale=float(scale))


def _axes(points: Mapping[str, Floats]) -> Floats:
    """(3, 3) left, up and forward of a face: the mesh's own axes, or as the template lies on its points."""
    names = [name for name in FRAME_POINTS if name in points]
    if len(names) < 6:
        raise ModelError(f"the head's direction needs at least six of the points {', '.join(FRAME_POINTS)}")
    source = np.array([TEMPLATE_POINTS[name] for name in names])
    target = np.array([points[name] for name in names])
    source = source - source.mean(axis=0)
    target = target - target.mean(axis=0)
    spread = np.linalg.svd(target, compute_uv=False)
    if not np.isfinite(spread).all() or spread[1] < 1e-3 * spread[0] or spread[0] == 0.0:
        raise ModelError("the feature points are on one line or in one place: they do not form a face")
    fitted: Floats = rotation_between(source, target).T
    modelled = np.rint(fitted)
    if not np.array_equal(modelled @ modelled.T, np.eye(3)):  # far from any axes: no rotation at all
        return fitted
    cosine = (np.trace(fitted @ modelled.T) - 1.0) / 2.0
    return modelled if np.arccos(np.clip(cosine, -1.0, 1.0)) < MODELLED_TOLERANCE else fitted
