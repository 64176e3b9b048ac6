"""Topology and measure of a polygon mesh: triangles, areas, normals, edges, diagonals, neighbours, boundaries.

A mesh is `vertices` (V, 3) in metres and `polygons`: an (F, 3) or (F, 4) integer array, or any sequence of index
sequences with three or more corners each. Nothing here depends on which corner a polygon starts at, so a face and
its mirror image get mirrored results.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations
from typing import TypeAlias

import numpy as np
from scipy import sparse

from ..arrays import Bools, Floats, Ints
from ..errors import ParameterError
from ..polygons import PolygonTable

Polygons: TypeAlias = Sequence[Sequence[int]] | Sequence[Ints] | Ints
Sparse: TypeAlias = "sparse.csr_array[np.float64]"

_ALL_PAIRS_UP_TO = 8
"""Polygons with more corners get a fixed set of chords instead of every pair, whose number grows as n^2."""
_AT_ONCE = 1 << 15
"""So many polygons at a time fit a processor's cache."""


def corners(polygons: Polygons, vertex_count: int | None = None) -> tuple[Ints, Ints]:
    """All polygon corners one after another, and the number of corners of each polygon.

    Parameters
    ----------
    polygons : see the module.
    vertex_count : when given, every index must lie below it.

    Returns
    -------
    loops : (C,) int64, vertex index of each corner.
    sizes : (F,) int64, corners per polygon; `loops` is cut by them.

    Raises
    ------
    ParameterError : a polygon with fewer than three corners, or an index out of range.
    """
    table = PolygonTable.of(polygons)
    loops, sizes = table.loops, table.sizes
    if len(sizes) and sizes.min() < 3:
        raise ParameterError("polygons", "must have three corners or more", int(np.argmin(sizes)))
    if len(loops) and loops.min() < 0:
        raise ParameterError("polygons", "must contain vertex indices of 0 or more", int(loops.min()))
    if vertex_count is not None and len(loops) and loops.max() >= vertex_count:
        raise ParameterError("polygons", f"must contain vertex indices below {vertex_count}", int(loops.max()))
    return loops, sizes


def by_size(polygons: Polygons, vertex_count: int | None = None) -> Iterator[tuple[Ints, Ints]]:
    """Polygons gathered by their number of corners: (face numbers (F_n,), corner indices (F_n, n)) for each n."""
    table = PolygonTable.of(polygons)
    corners(table, vertex_count)
    yield from table.by_size


def within(polygons: Polygons, mask: Bools) -> Polygons:
    """The polygons whose corners all lie in `mask` (V,) bool, as a sequence in the same order."""
    table = PolygonTable.of(polygons)
    corners(table, len(mask))
    kept = table.within(mask)
    if isinstance(polygons, np.ndarray):
        return np.asarray(polygons[kept], dtype=np.int64)
    return table.kept(kept)


def triangulate(polygons: Polygons) -> Ints:
    """Fan triangles from each polygon's first corner, (T, 3) int64, polygon by polygon, winding kept."""
    loops, sizes = corners(polygons)
    if len(sizes) and sizes.min() == sizes.max():  # most meshes: several times faster
        return _fan(loops.reshape(len(sizes), -1))
    starts = np.cumsum(sizes) - sizes
    fan = sizes - 2
    first = np.repeat(starts, fan)
    step = np.arange(int(fan.sum())) - np.repeat(np.cumsum(fan) - fan, fan)
    return np.stack([loops[first], loops[first + step + 1], loops[first + step + 2]], axis=1)


def _fan(index: Ints) -> Ints:
    """(F * (n - 2), 3) fan triangles of polygons (F, n)."""
    triangles = np.empty((len(index), index.shape[1] - 2, 3), dtype=np.int64)
    triangles[:, :, 0], triangles[:, :, 1], triangles[:, :, 2] = index[:, :1], index[:, 1:-1], index[:, 2:]
    return triangles.reshape(-1, 3)


def fans(polygons: Polygons) -> tuple[Ints, Floats]:
    """Triangles of every way to fan each polygon out from a corner, so that no corner is preferred.

    Returns
    -------
    triangles : (T, 3) int64, winding kept; a quad's two splits give four.
    shares : (T,) how much of its polygon each one counts for: 1 for a triangle, half for a quad's.
    """
    triangles, shares = [np.empty((0, 3), dtype=np.int64)], [np.empty(0)]
    for _, index in by_size(polygons):
        size = index.shape[1]
        starts = size if size > 4 else size - 2  # a triangle has one fan, a quad two
        for start in range(starts):
            fan = np.roll(index, -start, axis=1)
            for k in range(1, size - 1):
                triangles.append(fan[:, [0, k, k + 1]])
                shares.append(np.full(len(fan), 1.0 / starts))
    return np.concatenate(triangles), np.concatenate(shares)


def polygon_areas(vertices: Floats, polygons: Polygons) -> Floats:
    """Area of each polygon, (F,) m^2: the triangles between its sides and the mean of its corners."""
    areas = np.zeros(len(polygons))
    for faces, index in by_size(polygons, len(vertices)):
        areas[faces] = _side_areas(vertices[index]).sum(axis=1)
    return areas


def vertex_areas(vertices: Floats, polygons: Polygons) -> Floats:
    """Barycentric lumped areas, (V,) m^2: they add up to the polygons' areas.

    Each triangle between a side and the polygon's middle gives a third to each of the side's ends and the middle's
    third to all corners alike; for a triangle that is a third of its area per corner. Vertices in no polygon get 0.
    """
    areas = np.zeros(len(vertices))
    for _, index in by_size(polygons, len(vertices)):
        sides = _side_areas(vertices[index])
        share = (sides + np.roll(sides, 1, axis=1)) / 3 + sides.sum(axis=1, keepdims=True) / (3 * index.shape[1])
        areas += np.bincount(index.ravel(), share.ravel(), minlength=len(vertices))
    return areas


def vertex_normals(vertices: Floats, polygons: Polygons) -> Floats:
    """Unit normals weighted by polygon area, (V, 3); zero where a vertex lies in no polygon of any area."""
    normals = np.zeros((len(vertices), 3))
    for _, index in by_size(polygons, len(vertices)):
        flat = index.ravel()
        for axis, component in enumerate(area_vectors(vertices, index)):
            normals[:, axis] += np.bincount(flat, np.repeat(component, index.shape[1]), minlength=len(vertices))
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    return np.asarray(normals / np.where(length > 0, length, 1.0))


def area_vectors(vertices: Floats, index: Ints) -> Floats:
    """(3, F) components of the normals of polygons (F, n), twice as long as their areas."""
    vectors = np.empty((3, len(index)))
    columns = [np.ascontiguousarray(vertices[:, axis]) for axis in range(3)]
    for start in range(0, len(index), _AT_ONCE):
        corners = index[start : start + _AT_ONCE].T
        x, y, z = (column[corners] for column in columns)
        for vector, (p, q) in zip(vectors, ((y, z), (z, x), (x, y)), strict=True):
            sides = p * np.roll(q, -1, axis=0) - q * np.roll(p, -1, axis=0)
            vector[start : start + _AT_ONCE] = sides.sum(axis=0)
    return vectors


def unique_edges(polygons: Polygons, *, below: int | None = None) -> Ints:
    """Sides of all polygons, each once, (E, 2) int64 with the smaller index first, sorted.

    Parameters
    ----------
    below : only sides between vertices of smaller indices than this; None: all.
    """
    gathered = [index for _, index in by_size(polygons)]
    if below is not None:
        gathered = [index[(index < below).any(axis=1)] for index in gathered]
    pairs = [np.stack([index, np.roll(index, -1, axis=1)], axis=2).reshape(-1, 2) for index in gathered]
    if below is not None:
        pairs = [sides[(sides < below).all(axis=1)] for sides in pairs]
    return _unique_pairs(pairs)


def face_diagonals(polygons: Polygons) -> Ints:
    """Pairs of corners of one polygon that no side of any polygon joins, each once, (D, 2) int64, sorted."""
    pairs, _, _ = face_pairs(polygons)
    chords = _unique_pairs([pairs])
    edges = unique_edges(polygons)
    return chords[~np.isin(pair_keys(chords), pair_keys(edges))]


def face_pairs(polygons: Polygons) -> tuple[Ints, Ints, Ints]:
    """Every side and diagonal of every polygon, polygon by polygon.

    Returns
    -------
    pairs : (N, 2) int64 vertex indices; a side shared by two polygons appears twice.
    faces : (N,) int64, the polygon each pair belongs to.
    counts : (N,) int64, how many pairs that polygon has: 3 for a triangle, 6 for a quad, n(n - 1)/2 up to eight
        corners; beyond, the sides and three rings of chords, so that a cap with many corners stays sparse.
    """
    pairs, owners, counts = [], [], []
    for faces, index in by_size(polygons):
        chords = _chords(index.shape[1])
        pairs.append(index[:, chords].reshape(-1, 2))
        owners.append(np.repeat(faces, len(chords)))
        counts.append(np.full(len(faces) * len(chords), len(chords), dtype=np.int64))
    if not pairs:
        return np.empty((0, 2), dtype=np.int64), np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64)
    return np.concatenate(pairs), np.concatenate(owners), np.concatenate(counts)


#: An edge counts as at least so long, metres: a graph has no edge of length 0.
SHORTEST = 1e-9

#: Samples of a surface that are made at once.
BLOCK = 200_000


def adjacency(vertices: Floats, polygons: Polygons, *, diagonals: bool = True) -> Sparse:
    """Symmetric (V, V) matrix of the lengths in metres of the edges, with face diagonals unless told otherwise.

    A graph for shortest paths along the surface (`scipy.sparse.csgraph`); vertices in one spot stay joined.
    """
    table = PolygonTable.of(polygons)
    corners(table, len(vertices))
    pairs = face_pairs(table)[0] if diagonals else np.stack([table.loops, table.after], axis=1)
    rows, columns = np.concatenate([pairs, pairs[:, ::-1]]).astype(np.int32).T  # half the memory to sort
    joined = np.ones(len(rows), dtype=bool)
    once = sparse.coo_array((joined, (rows, columns)), shape=(len(vertices), len(vertices))).tocsr()
    starts, ends = once.indptr.astype(np.int64), once.indices.astype(np.int64)
    from_here = np.repeat(np.arange(len(vertices)), np.diff(starts))
    length = np.maximum(np.linalg.norm(vertices[from_here] - vertices[ends], axis=1), SHORTEST)
    return sparse.csr_array((length, ends, starts), shape=once.shape)


def _side_areas(points: Floats) -> Floats:
    """Areas (F, n) of the triangles between each side of polygons (F, n, 3) and the mean of their corners."""
    spokes = points - points.mean(axis=1, keepdims=True)
    return np.asarray(np.linalg.norm(np.cross(spokes, np.roll(spokes, -1, axis=1)), axis=2) / 2)


def _chords(size: int) -> Ints:
    """Corner pairs that become springs in a polygon of `size` corners."""
    if size <= _ALL_PAIRS_UP_TO:
        return np.array(list(combinations(range(size), 2)), dtype=np.int64)
    corner = np.arange(size)
    rings = [np.stack([corner, (corner + step) % size], axis=1) for step in sorted({1, 2, size // 3, size // 2})]
    return np.asarray(np.unique(np.sort(np.concatenate(rings), axis=1), axis=0), dtype=np.int64)


def pair_keys(pairs: Ints) -> Ints:
    """One integer per pair (smaller index first), unique for up to 2^31 vertices."""
    return np.asarray((pairs[:, 0] << 32) | pairs[:, 1], dtype=np.int64)


def _unique_pairs(pairs: Sequence[Ints]) -> Ints:
    """Pairs with the smaller index first, each once, sorted."""
    if not pairs:
        return np.empty((0, 2), dtype=np.int64)
    keys = np.unique(pair_keys(np.sort(np.concatenate(pairs), axis=1)))
    return np.stack([keys >> 32, keys & 0xFFFFFFFF], axis=1)


def applied(matrix: Sparse, fields: Floats) -> Floats:
    """(k, m, 3) a matrix (m, n) applied to each of some fields (k, n, 3)."""
    count, n, _ = fields.shape
    if count == 1 and matrix.nnz > 2 * n:  # three plain vectors are faster than rows of three, where rows are long
        return np.stack([matrix @ column for column in np.ascontiguousarray(fields[0].T)], axis=1)[None]
    columns = np.asarray(matrix @ fields.transpose(1, 0, 2).reshape(n, 3 * count))
    return np.ascontiguousarray(columns.reshape(-1, count, 3).transpose(1, 0, 2))


def with_short_indices(matrix: Sparse) -> Sparse:
    """The same matrix with indices of 32 bits, which run through the processor's cache in half the time."""
    parts = (matrix.data, matrix.indices.astype(np.int32), matrix.indptr.astype(np.int32))
    return sparse.csr_array(parts, shape=matrix.shape)


def surface_samples(corners: Floats, spacing: float) -> Floats:
    """(s, 3) points all over triangles given by their corners (t, 3, 3), no farther apart than a spacing, metres."""
    return np.concatenate([np.empty((0, 3)), *sample_blocks(corners, spacing)])


def sample_blocks(corners: Floats, spacing: float) -> Iterator[Floats]:
    """The same block by block."""
    longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    parts = np.maximum(np.ceil(longest / spacing), 1).astype(np.int64)
    for count in np.unique(parts).tolist():
        i, j = (part.ravel() for part in np.meshgrid(np.arange(count + 1), np.arange(count + 1)))
        keep = i + j <= count
        shares = np.stack([i, j, count - i - j], axis=1)[keep] / count
        alike = corners[parts == count]
        step = max(BLOCK // len(shares), 1)
        for first in range(0, len(alike), step):
            yield (shares @ alike[first : first + step]).reshape(-1, 3)
