"""The elastic response of one face's skin: forces in, displacements out, all linear and prefactored.

A displacement field v of the sheet solves K v = f with one scalar sparse matrix K for all three components
(`physics.elastic`). What the face shows is W v: skin slides over the skull rather than lifts off it, bulges where it is
squeezed, and goes with the brow where it hangs on it. Every muscle field and every correction goes through W.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property

import numpy as np

from ...arrays import Floats
from ...physics.elastic import Factor, elastic_matrix
from ...physics.mesh import Sparse
from ..mechanisms.bulge import Bulge
from ..mechanisms.hood import Hood
from ..mechanisms.sliding import sliding
from ..skin.outer import OuterSkin
from . import regions

#: Fields that are solved at once: three columns each, as many as the factor takes together.
AT_ONCE = 8


def blocks(count: int) -> Iterator[slice]:
    """So many fields, as many at a time as are solved at once."""
    return (slice(first, min(first + AT_ONCE, count)) for first in range(0, count, AT_ONCE))


class ElasticSheet:
    """K, W and the point corrections of one face; prefactored on first use."""

    def __init__(self, skin: OuterSkin) -> None:
        self.skin = skin

    @cached_property
    def stiffness(self) -> Sparse:
        """(n, n) K of the muscles: membrane, bending and anchors."""
        skin = self.skin
        return elastic_matrix(skin.laplacian, skin.areas, regions.bending(skin), regions.anchor(skin))

    @cached_property
    def factor(self) -> Factor:
        """Prefactored `stiffness`."""
        return Factor(self.stiffness)

    @cached_property
    def correction_factor(self) -> Factor:
        """Prefactored matrix of the point corrections."""
        skin = self.skin
        return Factor(
            elastic_matrix(skin.laplacian, skin.areas, regions.correction_bending(skin), regions.anchor(skin))
        )

    @cached_property
    def _slide(self) -> Floats:
        return sliding(self.skin)[:, None]

    @cached_property
    def bulge(self) -> Bulge:
        """How skin bulges where it is squeezed."""
        return Bulge(self.skin)

    @cached_property
    def hood(self) -> Hood:
        """How the skin between brow and lid goes with the brow."""
        return Hood(self.skin)

    def show(self, fields: Floats) -> Floats:
        """W v: sheet fields (n, 3) or (k, n, 3) as what the face shows, same shape, metres."""
        if not fields.size:
            return fields
        flat = fields.reshape(-1, self.skin.vertex_count, 3)
        normals = self.skin.normals
        slid = flat - (self._slide * normals) * (flat * normals).sum(axis=2, keepdims=True)
        return np.asarray(self.hood.carry(slid + self.bulge.lift(slid)).reshape(fields.shape))

    def show_transposed(self, loads: Floats) -> Floats:
        """W' f for loads (k, n, 3): the sheet forces that stand for forces on what the face shows."""
        normals = self.skin.normals
        loads = self.hood.carry_transposed(loads)
        back = loads + self.bulge.lift_transposed(loads)
        return np.asarray(back - (self._slide * normals) * (back * normals).sum(axis=2, keepdims=True))

    def relax(self, forces: Floats) -> Floats:
        """K^-1 f: sheet displacements (k, n, 3) under forces (k, n, 3)."""
        return _solve_fields(self.factor, forces)

    def point_responses(self, loads: Floats) -> Floats:
        """R (k, n, 3): what the face shows when unit loads (k, n, 3) act on it, by the correction kernel W K^-1 W'."""
        return self.show(_solve_fields(self.correction_factor, self.show_transposed(loads)))


def _solve_fields(factor: Factor, forces: Floats) -> Floats:
    """Solve for k vector fields (k, n, 3) at once."""
    k, n, _ = forces.shape
    if k == 0:
        return forces
    columns = forces.transpose(0, 2, 1).reshape(3 * k, n).T  # each in one piece, as the factor takes them
    return factor.solve(columns).T.reshape(k, 3, n).transpose(0, 2, 1)
