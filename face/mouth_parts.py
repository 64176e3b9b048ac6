"""Telling teeth, gums and tongue apart in a mesh's mouth: by size, by the arch of the teeth, by what they touch."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.sparse.csgraph import dijkstra
from scipy.spatial import cKDTree

from ..arrays import Bools, Floats, Ints
from ..physics import mesh
from .openings import edge_graph
from .parts import Part
from .template import MM

#: A tongue is between these wide and at least this long; a single tooth is smaller, rows of teeth and gums are wider.
TONGUE_NARROWEST, TONGUE_WIDEST, TONGUE_SHORTEST = 20 * MM, 56 * MM, 25 * MM

#: Gums of both jaws in one piece reach this far above and below the lips' line.
BOTH_JAWS = 8 * MM

#: A row of teeth leaves this middle share of its width empty over these shares of its depth.
ARCH_MIDDLE, ARCH_DEPTH = 0.15, (0.25, 0.7)

#: Gum within this distance of a tooth belongs to its jaw.
GUM_REACH = 2 * MM


def mouth_part(piece: Floats, lips: Floats) -> Part | None:
    """What a piece (k, 3) in the mouth is; None for gums of both jaws in one, which `split_gums` takes apart.

    Parameters
    ----------
    piece : (k, 3) head space, metres.
    lips : (3,) middle between the lips.
    """
    low, high = piece[:, 1].min() - lips[1], piece[:, 1].max() - lips[1]
    width, _, depth = np.ptp(piece, axis=0)
    teeth = Part.TEETH_UPPER if low + high > 0.0 else Part.TEETH_LOWER
    if width < TONGUE_NARROWEST or depth < TONGUE_SHORTEST or _is_arch(piece):
        return teeth
    if width > TONGUE_WIDEST:
        return None if low < -BOTH_JAWS and high > BOTH_JAWS else teeth
    return Part.TONGUE if low < 0.0 else Part.TEETH_UPPER


def _is_arch(piece: Floats) -> bool:
    """Whether a piece is a horseshoe, open towards the throat."""
    across = piece[:, 0] - (piece[:, 0].min() + piece[:, 0].max()) / 2.0
    along = (piece[:, 2] - piece[:, 2].min()) / max(float(np.ptp(piece[:, 2])), 1e-9)
    middle = np.abs(across) < ARCH_MIDDLE * np.ptp(piece[:, 0])
    return not (middle & (along > ARCH_DEPTH[0]) & (along < ARCH_DEPTH[1])).any()


def split_gums(parts: Ints, gums: Bools, positions: Floats, polygons: Sequence[Ints]) -> None:
    """Give each vertex of `gums` (V,) to the jaw whose teeth are nearer along the surface, in place.

    A tongue that is one surface with the gums is not told apart: it goes with the mandible. Without teeth of both jaws
    nothing is known and `parts` stays as it is.

    Parameters
    ----------
    parts : (V,) numbers of `Part` with the teeth filled in.
    positions : (V, 3) head space, metres.
    """
    index = np.flatnonzero(gums)
    teeth = [np.flatnonzero(parts == part) for part in (Part.TEETH_UPPER, Part.TEETH_LOWER)]
    if any(len(row) == 0 for row in teeth):
        return
    upper, lower = (cKDTree(positions[row]).query(positions[index])[0] for row in teeth)
    seeds = [index[(upper < GUM_REACH) & (upper < lower)], index[(lower < GUM_REACH) & (lower < upper)]]
    if any(len(seed) == 0 for seed in seeds):
        return
    own = [polygon for polygon in polygons if gums[polygon].all()]
    graph = edge_graph(mesh.unique_edges(own), positions)
    far = [dijkstra(graph, directed=False, indices=seed, min_only=True)[index] for seed in seeds]
    parts[index] = np.where(far[0] <= far[1], int(Part.TEETH_UPPER), int(Part.TEETH_LOWER))
