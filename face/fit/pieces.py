"""The skin among the pieces of a mesh: eyeballs, teeth, lashes and what else is small do not belong to it."""

from __future__ import annotations

import numpy as np
from scipy import sparse
from scipy.sparse.csgraph import connected_components

from ...arrays import Ints
from .cloud import Surface

#: Pieces smaller than this share of the largest are no skin.
LARGE = 0.1
#: Except those of whose sides fewer than this share are free: they close the skin.
LOOSE = 0.25


def skin_pieces(surface: Surface) -> Surface:
    """The surface without its small pieces.

    Lashes, and all else that is stitched onto skin, hang on sides that more than two triangles share. A small piece
    that is enclosed by such sides is skin nevertheless: coarse meshes have them.
    """
    sides = _side_numbers(surface.triangles)
    users = np.bincount(sides.ravel())[sides]
    piece = _joined_over(sides, users == 2)
    areas = np.bincount(piece, np.linalg.norm(surface.cross(), axis=1))
    free = np.bincount(piece, (users == 1).sum(axis=1))
    held = np.bincount(piece, (users > 2).sum(axis=1))
    kept = (areas >= LARGE * areas.max()) | (free < LOOSE * held)
    return surface.part(kept[piece])


def joined(triangles: Ints) -> Ints:
    """(T,) number of the piece that each triangle belongs to; pieces are joined over sides."""
    sides = _side_numbers(triangles)
    return _joined_over(sides, np.ones(sides.shape, dtype=bool))


def _side_numbers(triangles: Ints) -> Ints:
    """(T, 3) a number for each triangle's sides; the same for the same two vertices."""
    ends = np.sort(np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=2), axis=2)
    keys = ends[..., 0] * (int(triangles.max()) + 1) + ends[..., 1]
    return np.unique(keys.ravel(), return_inverse=True)[1].reshape(keys.shape)


def _joined_over(sides: Ints, joins: np.ndarray) -> Ints:
    """(T,) number of the piece that each triangle belongs to, joined over those of its sides (T, 3) that join."""
    triangle = np.broadcast_to(np.arange(len(sides))[:, None], sides.shape)
    shape = (len(sides), int(sides.max()) + 1)
    uses = sparse.csr_array((np.ones(int(joins.sum())), (triangle[joins], sides[joins])), shape=shape)
    return np.asarray(connected_components(uses @ uses.T, directed=False)[1], dtype=np.int64)
