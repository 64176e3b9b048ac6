"""The skin among the pieces of a mesh: eyeballs, teeth, lashes and what else is small do not belong to it."""

from __future__ import annotations

import numpy as np
from scipy import sparse
from scipy.sparse.csgraph import connected_components

from ....arrays import Bools, Ints
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
    keys = side_keys(surface.triangles)
    _, side, count = np.unique(keys, return_inverse=True, return_counts=True)
    users = count[side.reshape(keys.shape)]
    piece = joined_over(keys, users == 2)
    areas = np.bincount(piece, surface.twice_areas)
    free = np.bincount(piece, (users == 1).sum(axis=1))
    held = np.bincount(piece, (users > 2).sum(axis=1))
    kept = (areas >= LARGE * areas.max()) | (free < LOOSE * held)
    return surface.part(kept[piece])


def joined(triangles: Ints) -> Ints:
    """(T,) number of the piece that each triangle belongs to; pieces are joined over sides."""
    keys = side_keys(triangles)
    return joined_over(keys, np.ones(keys.shape, dtype=bool))


def joined_over(keys: Ints, joins: Bools) -> Ints:
    """(T,) number of the piece that each triangle belongs to, joined over those of its sides (T, 3) that join."""
    _, side = np.unique(keys, return_inverse=True)
    side = side.reshape(keys.shape)
    triangle = np.broadcast_to(np.arange(len(keys))[:, None], keys.shape)
    shape = (len(keys), int(side.max()) + 1)
    uses = sparse.csr_array((np.ones(int(joins.sum())), (triangle[joins], side[joins])), shape=shape)
    return np.asarray(connected_components(uses @ uses.T, directed=False)[1], dtype=np.int64)


def side_keys(triangles: Ints, base: int | None = None) -> Ints:
    """(T, 3) a number for each side of each triangle, the same for the same two vertices.

    Parameters
    ----------
    base : what the lower vertex is multiplied by, more than any vertex; None: one more than the highest.
    """
    ends = np.sort(np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=2), axis=2)
    return np.asarray(ends[..., 0] * (base or int(triangles.max()) + 1) + ends[..., 1], dtype=np.int64)
