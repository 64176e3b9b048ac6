"""A skin made denser where a face folds, all quads, every new vertex on the limit surface.

Colour some vertices of a quad mesh: of the four edges round a quad, an even number joins unlike colours. Halve those
edges, and every quad falls into quads: none halved, it stays; two opposite ones, it is two; two that meet, it is three
about its middle; all four, it is four. So any colouring makes the mesh denser, wherever it begins and ends, without a
triangle and without a seam. Stripes of colour halve across the stripes; a chequerboard halves both ways.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy import sparse

from ...arrays import Bools, Ints
from .cage import RIGHT_SUFFIX
from .limit import QuadEdges, limit_matrix, quad_edges, subdivide
from .skin import HeadSkin


@dataclass(frozen=True)
class Stripe:
    """Two rows of cage nodes of the left half, between which the skin becomes twice as dense across."""

    one: frozenset[str]
    other: frozenset[str]


def coloured(skin: HeadSkin, stripes: Iterable[Stripe]) -> Bools:
    """(V,) which vertices of a skin that is not denser yet lie between rows, in both halves; crossings cancel out."""
    names = np.array([name.removesuffix(RIGHT_SUFFIX) for name in skin.cage.names])
    corners, ends = names[skin.cage.quads], names[skin.cage_edges.ends]
    colour = np.zeros(len(skin.vertices), dtype=bool)
    for stripe in stripes:
        one, other = (np.array(sorted(side)) for side in (stripe.one, stripe.other))
        edges = np.isin(ends, one).any(axis=1) & np.isin(ends, other).any(axis=1)
        faces = (np.isin(corners, one).sum(axis=1) == 2) & (np.isin(corners, other).sum(axis=1) == 2)
        colour[len(names) :] ^= np.concatenate([edges, faces])
    return colour


def denser(skin: HeadSkin, colour: Bools) -> HeadSkin:
    """The skin with every edge between unlike colours (V,) halved; its vertices come first and stay where they are."""
    edges = quad_edges(skin.quads)
    count, edge_count = len(skin.vertices), len(edges.ends)
    cut = colour[edges.ends[:, 0]] != colour[edges.ends[:, 1]]
    of_quad = cut[edges.of_quad]
    parted = _meeting(of_quad)
    kept = np.concatenate([np.arange(count), count + np.flatnonzero(cut), count + edge_count + np.flatnonzero(parted)])
    number = np.full(count + edge_count + len(skin.quads), -1, dtype=np.int64)
    number[kept] = np.arange(len(kept))

    step = subdivide(count, skin.quads)
    limit = sparse.csr_matrix(limit_matrix(step.matrix.shape[0], step.quads)[kept])
    matrix = sparse.csr_matrix(limit @ step.matrix @ subdivide(len(skin.cage.names), skin.cage.quads).matrix)
    vertices = np.concatenate([skin.vertices, matrix[count:] @ skin.cage_positions])
    quads, parents = _split(skin.quads, edges, of_quad, number)
    return replace(
        skin,
        vertices=vertices,
        quads=quads,
        regions=tuple(skin.regions[parent] for parent in parents),
        mirror=_mirror(skin, edges, kept, number),
        cage_matrix=matrix,
    )


def _meeting(of_quad: Bools) -> Bools:
    """(F,) quads that need a vertex in their middle: two halved edges meet, or all four are halved."""
    return np.asarray((of_quad & np.roll(of_quad, 1, axis=1)).any(axis=1))


def _split(quads: Ints, edges: QuadEdges, of_quad: Bools, number: Ints) -> tuple[Ints, Sequence[int]]:
    """The quads that all quads fall into, winding kept, and the quad that each comes from."""
    count, edge_count = len(number) - len(edges.ends) - len(quads), len(edges.ends)
    halves = number[count + edges.of_quad]
    centres = number[count + edge_count + np.arange(len(quads))]
    made: list[Ints] = []
    parents: list[int] = []
    for f, (quad, cut, half, centre) in enumerate(zip(quads, of_quad, halves, centres, strict=True)):
        pieces = _pieces(quad, cut, half, int(centre))
        made += pieces
        parents += [f] * len(pieces)
    return np.array(made, dtype=np.int64), parents


def _pieces(quad: Ints, cut: Bools, half: Ints, centre: int) -> list[Ints]:
    """What one quad falls into; edge k of `cut` and `half` runs from corner k to the next."""
    if not cut.any():
        return [quad]
    if cut.all():
        return [np.array([quad[k], half[k], centre, half[k - 1]]) for k in range(4)]
    first = next(k for k in range(4) if cut[k] and cut[(k + 1) % 4 if centre >= 0 else (k + 2) % 4])
    a, b, c, d = np.roll(quad, -first)
    ab, bc, cd, _ = np.roll(half, -first)
    if centre >= 0:
        return [np.array(piece) for piece in ((a, ab, centre, d), (ab, b, bc, centre), (centre, bc, c, d))]
    return [np.array([a, ab, cd, d]), np.array([ab, b, c, cd])]


def _mirror(skin: HeadSkin, edges: QuadEdges, kept: Ints, number: Ints) -> Ints:
    """Mirror vertex of every kept vertex."""
    count, edge_count = len(skin.vertices), len(edges.ends)
    across = np.sort(skin.mirror[edges.ends], axis=1)
    place = {(int(a), int(b)): i for i, (a, b) in enumerate(edges.ends)}
    edge_mirror = np.array([place[int(a), int(b)] for a, b in across])
    faces = {tuple(sorted(quad)): f for f, quad in enumerate(skin.quads.tolist())}
    face_mirror = np.array([faces[tuple(sorted(quad))] for quad in skin.mirror[skin.quads].tolist()])
    whole = np.concatenate([skin.mirror, count + edge_mirror, count + edge_count + face_mirror])
    mirror: Ints = number[whole[kept]]
    return mirror
