"""Telling skin, eyeballs, teeth and tongue apart when nobody has: by connected pieces, their place and their shape."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from scipy import sparse
from scipy.sparse.csgraph import connected_components

from ...arrays import Floats, Ints
from ...physics.mesh import Polygons
from ...polygons import PolygonTable
from .eye_parts import add_eyes
from .mouth_parts import add_mouth_parts, split_gums, split_tongue
from .parts import Part


def pieces(polygons: Polygons, vertex_count: int) -> Ints:
    """(V,) number of the connected piece of each vertex."""
    table = PolygonTable.of(polygons)
    ends = (table.loops, table.after)
    graph = sparse.coo_array((np.ones(len(table.loops)), ends), shape=(vertex_count, vertex_count))
    return np.asarray(connected_components(graph, directed=False)[1], dtype=np.int64)


def derive_parts(
    positions: Floats, polygons: PolygonTable, points: Mapping[str, Floats], skin_vertex: int | None
) -> Ints:
    """Part of every vertex of a mesh.

    Parameters
    ----------
    positions : (V, 3) neutral mesh in head space, metres.
    polygons : its polygons.
    points : feature point -> (3,) in head space.
    skin_vertex : a vertex that is certainly skin (the nose tip); None in a mesh without the skin.

    Returns
    -------
    (V,) numbers of `Part`.
    """
    labels = pieces(polygons, len(positions))
    parts = np.full(len(positions), int(Part.OTHER), dtype=np.int64)
    if skin_vertex is not None:
        parts[labels == labels[skin_vertex]] = int(Part.SKIN)
    add_eyes(parts, labels, positions, polygons, points)
    gums = add_mouth_parts(parts, labels, positions, (points["2.2"] + points["2.3"]) / 2.0)
    split_gums(parts, gums, positions, polygons)
    split_tongue(parts, labels, positions, polygons, points)
    return parts
