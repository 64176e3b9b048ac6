"""The skin among the pieces of a mesh: eyeballs, teeth, lashes and what else is small do not belong to it."""

from __future__ import annotations

import numpy as np
from scipy import sparse
from scipy.sparse.csgraph import connected_components

from ....arrays import Bools, Ints
from ....progress import Progress, Work, run
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
    return run(skin_pieces_steps(surface))


def skin_pieces_steps(surface: Surface) -> Work[Surface]:
    """As `skin_pieces`, bit by bit."""
    keys = side_keys(surface.triangles)
    yield Progress(0.3, "Fitting the face")
    _, side, count = np.unique(keys, return_inverse=True, return_counts=True)
    side = side.reshape(keys.shape)
    users = count[side]
    yield Progress(0.6, "Fitting the face")
    piece = joined_over(side, users == 2)
    yield Progress(1.0, "Fitting the face")
    areas = np.bincount(piece, surface.twice_areas)
    free = np.bincount(piece, (users == 1).sum(axis=1))
    held = np.bincount(piece, (users > 2).sum(axis=1))
    kept = (areas >= LARGE * areas.max()) | (free < LOOSE * held)
    return surface.part(kept[piece])


def joined(triangles: Ints) -> Ints:
    """(T,) number of the piece that each triangle belongs to; pieces are joined over sides."""
    _, side = np.unique(side_keys(triangles), return_inverse=True)
    return joined_over(side.reshape(triangles.shape), np.ones(triangles.shape, dtype=bool))


def joined_over(sides: Ints, joins: Bools) -> Ints:
    """(T,) number of the piece that each triangle belongs to, joined over those of its sides that join.

    Parameters
    ----------
    sides : (T, 3) their numbers from 0 on, the same for the same side. joins : (T, 3) which of them join.
    """
    triangle, _ = np.nonzero(joins)
    shape = (int(sides.max()) + 1, len(sides))
    users = sparse.coo_array((np.ones(len(triangle)), (sides[joins], triangle)), shape=shape).tocsr()
    used = np.repeat(np.arange(shape[0]), np.diff(users.indptr))
    same = used[1:] == used[:-1]
    pairs = users.indices[:-1][same], users.indices[1:][same]
    graph = sparse.coo_array((np.ones(len(pairs[0])), pairs), shape=(len(sides), len(sides)))
    return np.asarray(connected_components(graph, directed=False)[1], dtype=np.int64)


def side_keys(triangles: Ints, base: int | None = None) -> Ints:
    """(T, 3) a number for each side of each triangle, the same for the same two vertices.

    Parameters
    ----------
    base : what the lower vertex is multiplied by, more than any vertex; None: one more than the highest.
    """
    ends = np.sort(np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=2), axis=2)
    return np.asarray(ends[..., 0] * (base or int(triangles.max()) + 1) + ends[..., 1], dtype=np.int64)
