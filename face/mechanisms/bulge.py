"""Squeezed tissue bulges: the volume under the skin is kept.

Fat and muscle are all but incompressible, so that where the skin is drawn together - the cheek under the eye in a
smile, the chin under a pushed-up lip - it comes forward, and where it is stretched it sinks. The second paper's single
layer of springs has no volume. Here the compression of the moved surface, averaged over a window, lifts the skin along
its normal: u = v - h n <div v>.

Source: own calibration on scanned expressions (docs/muscles.md).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import sparse

from ...arrays import Floats
from ...physics.elastic import diagonal_matrix
from ...physics.mesh import Sparse
from ..figures import Length, read_figures
from ..mechanism import Mechanism
from ..skin.outer import OuterSkin
from . import lids, lips, nasolabial, nose


@dataclass(frozen=True)
class BulgeFigures:
    """Of squeezed tissue (presets/anatomy/skin.toml)."""

    height: Length
    over: Length


BULGE = read_figures("skin.bulge", BulgeFigures)


class Bulge:
    """The bulging of one face's skin as a linear map of displacements, and its transpose."""

    def __init__(self, skin: OuterSkin) -> None:
        """Prefactor the average for one skin."""
        self.skin = skin
        self.height = bulging(skin)
        self._divergence = surface_divergence(skin)
        self._average = skin.smoothing(BULGE.over)

    def lift(self, fields: Floats) -> Floats:
        """(k, n, 3) what displacements (k, n, 3) raise or lower the skin, metres."""
        squeeze = np.asarray(self._divergence @ fields.reshape(len(fields), -1).T)
        smooth = self._average.solve(self.skin.areas[:, None] * squeeze)
        return -(self.height[:, None] * smooth).T[:, :, None] * self.skin.normals

    def lift_transposed(self, loads: Floats) -> Floats:
        """(k, n, 3) the loads on displacements that stand for loads (k, n, 3) on what they raise."""
        pressed = -(self.height * (loads * self.skin.normals).sum(axis=2)).T
        spread = self.skin.areas[:, None] * self._average.solve(pressed)
        return np.asarray(self._divergence.T @ spread).T.reshape(loads.shape)


def bulging(skin: OuterSkin) -> Floats:
    """(n,) bulge height per unit of surface compression, metres; lips, nose tip and lids are free of it."""
    if not skin.has(Mechanism.BULGE):
        return np.zeros(skin.vertex_count)
    everywhere = BULGE.height * lips.off_lips(skin) * nose.off_tip(skin)
    return (everywhere + nasolabial.heaping(skin)) * (1.0 - lids.near_lids(skin))


def surface_divergence(skin: OuterSkin) -> Sparse:
    """(n, 3n) area-averaged surface divergence of a vector field given as n rows of x, y, z."""
    triangles, shares = skin.fans
    corners = skin.positions[triangles]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    double_area = np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-18)
    unit = normal / double_area
    rows, columns, values = [], [], []
    for corner in range(3):
        opposite = corners[:, (corner + 2) % 3] - corners[:, (corner + 1) % 3]
        gradient = np.cross(unit, opposite) / double_area
        for target in range(3):
            for axis in range(3):
                rows.append(triangles[:, target])
                columns.append(3 * triangles[:, corner] + axis)
                values.append(gradient[:, axis] * double_area[:, 0] * shares / 6.0)
    n = skin.vertex_count
    summed = sparse.coo_array(
        (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), shape=(n, 3 * n)
    )
    averaged: Sparse = diagonal_matrix(1.0 / np.maximum(skin.areas, 1e-18)) @ summed.tocsr()
    return averaged
