"""What counts of a motion: the outer skin, the feature points along their FAPs, and where the eyes look."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import sparse

from ...arrays import Floats, Ints
from ...physics.mesh import Sparse
from ..anatomy import Anatomy

#: An eyeball counts as much as this many FAPs: a wrong gaze is seen at once.
WAYS_OF_AN_EYE = 3.0


@dataclass(frozen=True, eq=False)
class Sight:
    """What is seen of displacements (V, 3) in head space.

    Attributes
    ----------
    skin : (n,) vertices of the outer skin, copies at seams once.
    reader : (m, 3V) matrix to displacements of feature points along their FAPs; metres. The first rows are those of
        `numbers`, then come the eyeballs' vertices.
    numbers : FAP number of each of the first rows. units : metres per FAP unit of those.
    """

    skin: Ints
    reader: Sparse
    numbers: Ints
    units: Floats

    def of_skin(self, moved: Floats) -> Floats:
        """(3n,) displacements of the outer skin."""
        return np.asarray(moved[self.skin].ravel())

    def of_points(self, moved: Floats) -> Floats:
        """(m,) displacements that FAPs and gaze are read from."""
        return np.asarray(self.reader @ moved.ravel())


def sight_of(anatomy: Anatomy) -> Sight:
    """What counts on one face."""
    rows, count = anatomy.rows, len(anatomy.mesh.positions)
    blocks = [rows.matrix(anatomy.points.matrix(rows.names))]
    for ball in anatomy.eyeballs:
        columns = (3 * ball.index[:, None] + np.arange(3)).ravel()
        weights = np.full(len(columns), np.sqrt(WAYS_OF_AN_EYE / len(ball.index)))
        entries = (weights, (np.arange(len(columns)), columns))
        blocks.append(sparse.csr_array(entries, shape=(len(columns), 3 * count)))
    skin = np.union1d(anatomy.given_skin.index, anatomy.still_skin)
    return Sight(skin, sparse.csr_array(sparse.vstack(blocks)), rows.numbers, rows.units)
