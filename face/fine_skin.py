"""The outer skin split finely: forces are summed over its surface, not over however few vertices a mesh has.

A muscle's pull changes within millimetres where its fibres end. Read off vertices alone, its sum over the skin would
depend on where they happen to lie.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..physics.elastic import diagonal_matrix
from ..physics.mesh import Sparse
from ..physics.split import Split, split
from .openings import Opening
from .outer_skin import OuterSkin
from .template import MM

#: A skin is split until its vertices are no farther apart than this in the middle, metres.
FINE = 3.5 * MM

MOST_SPLITS = 3


def _halved(opening: Opening, once: Split) -> Opening:
    """An opening's margins on the finer mesh."""
    return Opening(once.halved(opening.upper), once.halved(opening.lower))


def fine_skin(skin: OuterSkin) -> tuple[OuterSkin, Sparse]:
    """The same skin with vertices no farther apart than `FINE`, and the matrix (N, n) that takes fields to it."""
    fine, matrix = skin, diagonal_matrix(np.ones(skin.vertex_count))
    for _ in range(MOST_SPLITS):
        if float(np.median(np.sqrt(fine.areas))) <= FINE:
            break
        once = split(fine.polygons, fine.vertex_count)
        matrix = once.matrix @ matrix
        fine = replace(
            fine,
            index=np.arange(once.matrix.shape[0], dtype=np.int64),
            positions=np.asarray(once.matrix @ fine.positions),
            polygons=list(once.quads),
            mouth=_halved(fine.mouth, once),
            eyes={side: _halved(opening, once) for side, opening in fine.eyes.items()},
            _cache={},
        )
    return fine, matrix
