"""The outer skin split finely, so that what it does hardly depends on how few vertices a mesh has.

Elastic skin bends over a centimetre: on edges as long as that its matrix is another tissue, so a coarse skin is solved
on a split one whose first vertices are the mesh's own. A muscle's pull changes within millimetres where its fibres end:
read off vertices alone, its sum over the skin would depend on where they happen to lie, so forces are summed over a
skin that is split further still.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy import sparse

from ...arrays import Floats
from ...physics.elastic import diagonal_matrix
from ...physics.mesh import Sparse
from ...physics.split import Split, split
from ...polygons import PolygonTable
from ..mesh.openings import Opening
from ..mesh.template import MM
from .outer import OuterSkin

#: A skin is split until its vertices are no farther apart than this in the middle, metres: where it is solved, and
#: where forces are summed over it.
SOLVED, SUMMED = 6.0 * MM, 3.5 * MM

MOST_SPLITS = 3


def _halved(opening: Opening, once: Split) -> Opening:
    """An opening's margins on the finer mesh."""
    return Opening(once.halved(opening.upper), once.halved(opening.lower))


def _web_last(skin: OuterSkin, once: Split) -> tuple[PolygonTable, int]:
    """The quads of a split skin, those of webs last, and how many: each has a corner in the middle of its polygon."""
    if skin.web == 0:
        return PolygonTable.of(once.quads), 0
    of_web = once.quads[:, 2] >= once.matrix.shape[0] - skin.web
    return PolygonTable.of(np.concatenate([once.quads[~of_web], once.quads[of_web]])), int(of_web.sum())


def _curved(skin: OuterSkin, once: Split) -> Floats:
    """(N, 3) positions of a split skin: new vertices bulge out of flat polygons as far as the skin there is round.

    That is half-way from the middle of the vertices that they lie between to those vertices' tangent planes, as on a
    ball (Boubekeur and Alexa 2008, "Phong Tessellation", have the planes); vertices of the skin itself stay.
    """
    middles = np.asarray(once.matrix @ skin.positions)
    between = sparse.coo_array(once.matrix)
    normals = skin.raw_normals[between.col]
    above = (normals * (skin.positions[between.col] - middles[between.row])).sum(axis=1)
    heights = sparse.csr_array((between.data * above, (between.row, between.col)), shape=between.shape)
    return np.asarray(middles + 0.5 * (heights @ skin.raw_normals))


def fine_skin(skin: OuterSkin, spacing: float) -> tuple[OuterSkin, Sparse]:
    """The same skin with vertices no farther apart than a spacing (metres), and the matrix (N, n) that splits fields.

    The skin's own n vertices stay the first ones; where they are near enough already, it is the skin itself.
    """
    fine, matrix = skin, diagonal_matrix(np.ones(skin.vertex_count))
    for _ in range(MOST_SPLITS):
        if float(np.median(np.sqrt(fine.areas))) <= spacing:
            break
        once = split(fine.polygons, fine.vertex_count)
        matrix = once.matrix @ matrix
        quads, web = _web_last(fine, once)
        fine = replace(
            fine,
            positions=_curved(fine, once),
            polygons=quads,
            web=web,
            mouth=_halved(fine.mouth, once),
            eyes={side: _halved(opening, once) for side, opening in fine.eyes.items()},
            stands_for=None,
            _cache={},
        )
    return fine, matrix
