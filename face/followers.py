"""What is not outer skin follows: mouth bag and eye sockets, lashes and brows, loose pieces."""

from __future__ import annotations

import numpy as np
from scipy import sparse
from scipy.spatial import cKDTree

from ..arrays import Bools, Floats, Ints
from ..physics.elastic import Factor, Sparse

#: Loose vertices follow the average of this many nearest carriers.
NEIGHBOURS = 4

#: Inner skin is tied to rest as weakly as this, relative to its neighbours, so that loose pieces stay put.
REST_TIE = 1e-4


class InnerSkin:
    """Skin behind the lips and lids: takes the smoothest displacement that fits the margins it hangs on."""

    def __init__(self, laplacian: Sparse, inner: Bools) -> None:
        """Prepare for a mesh's Laplacian (V, V) and the mask (V,) of vertices that follow."""
        self.index: Ints = np.flatnonzero(inner)
        if len(self.index) == 0:
            return
        rows = sparse.csr_array(laplacian)[self.index]
        own = sparse.csr_array(rows[:, self.index])
        diagonal = own.diagonal()
        tie = REST_TIE * np.where(diagonal > 0, diagonal, 1.0)
        self._factor = Factor(sparse.csr_array(own + sparse.diags_array(tie)))
        keep = np.ones(laplacian.shape[0])
        keep[self.index] = 0.0
        self._coupling = sparse.csr_array(rows @ sparse.diags_array(keep))

    def follow(self, displacement: Floats) -> None:
        """Fill in the inner rows of a displacement field (V, 3), in place."""
        if len(self.index):
            displacement[self.index] = self._factor.solve(-(self._coupling @ displacement))


class LooseParts:
    """Lashes, brows and other pieces: each vertex goes with the nearest carriers."""

    def __init__(self, positions: Floats, loose: Ints, carriers: Ints) -> None:
        """Bind vertices `loose` to the nearest of `carriers` (indices into positions (V, 3))."""
        self.index = loose
        self._weights = sparse.csr_array((len(loose), len(positions)))
        if len(loose) == 0 or len(carriers) == 0:
            return
        count = min(NEIGHBOURS, len(carriers))
        distance, nearest = cKDTree(positions[carriers]).query(positions[loose], k=count)
        distance, nearest = distance.reshape(len(loose), count), nearest.reshape(len(loose), count)
        weight = 1.0 / np.maximum(distance, 1e-6) ** 2
        weight /= weight.sum(axis=1, keepdims=True)
        rows = np.repeat(np.arange(len(loose)), count)
        self._weights = sparse.csr_array(
            (weight.ravel(), (rows, carriers[nearest.ravel()])), shape=(len(loose), len(positions))
        )

    def follow(self, displacement: Floats) -> None:
        """Fill in the loose rows of a displacement field (V, 3), in place."""
        if len(self.index):
            displacement[self.index] = self._weights @ displacement
