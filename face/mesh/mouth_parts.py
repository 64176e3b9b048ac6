"""Telling teeth, gums and tongue apart in a mesh's mouth: by size, by the arch of the teeth, by what they touch."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from scipy.sparse.csgraph import dijkstra
from scipy.spatial import cKDTree

from ...arrays import Bools, Floats, Ints
from ...physics import mesh
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

#: A tongue's tip lies within this of the point 6.1; the tongue reaches this far above its body's point 6.2, is as wide
#: as its borders 6.3 and 6.4 lie apart times this, and as long behind its body's point as before it.
TIP_REACH, TONGUE_ABOVE, TONGUE_BESIDE = 4 * MM, 4 * MM, 1.05


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

    Without teeth of both jaws nothing is known and `parts` stays as it is.

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


def split_tongue(
    parts: Ints, labels: Ints, positions: Floats, polygons: Sequence[Ints], points: Mapping[str, Floats]
) -> None:
    """Tell a tongue from the lower gums that it is one surface with, by its feature points 6.1 to 6.4, in place.

    It is what lies between the borders, from the tip to as far behind the body, below the borders off the teeth, and
    hangs together with the tip. A mesh that has a tongue of its own, or a face without these points, stays as it is.

    Parameters
    ----------
    parts : (V,) numbers of `Part` with teeth and gums filled in.
    labels : (V,) number of each vertex's connected piece.
    positions : (V, 3) head space, metres.
    points : feature point -> (3,) in head space.
    """
    if (parts == Part.TONGUE).any() or any(name not in points for name in ("6.1", "6.2", "6.3", "6.4")):
        return
    tip, body, left, right = (points[name] for name in ("6.1", "6.2", "6.3", "6.4"))
    lower = np.flatnonzero(parts == Part.TEETH_LOWER)
    if len(lower) == 0:
        return
    distance, nearest = cKDTree(positions[lower]).query(tip)
    foremost = int(lower[nearest])
    teeth = positions[np.isin(parts, (Part.TEETH_LOWER, Part.TEETH_UPPER)) & (labels != labels[foremost])]
    if distance > TIP_REACH or len(teeth) == 0:
        return
    across, along = positions[:, 0] - (left[0] + right[0]) / 2.0, positions[:, 2] - body[2]
    length = tip[2] - body[2]
    inside = (labels == labels[foremost]) & (parts == Part.TEETH_LOWER)
    inside &= np.abs(across) <= TONGUE_BESIDE * abs(left[0] - right[0]) / 2.0
    inside &= (along <= length + GUM_REACH) & (along >= -length - GUM_REACH)
    inside &= positions[:, 1] <= body[1] + TONGUE_ABOVE
    index = np.flatnonzero(inside)
    above_borders = positions[index, 1] >= min(left[1], right[1]) - GUM_REACH
    off_teeth = cKDTree(teeth).query(positions[index])[0] >= GUM_REACH
    inside[index] = off_teeth | above_borders
    inside[foremost] = True
    own = [polygon for polygon in polygons if inside[polygon].all()]
    if own:
        graph = edge_graph(mesh.unique_edges(own), positions)
        far = dijkstra(graph, directed=False, indices=np.array([foremost]), min_only=True)
        parts[np.isfinite(far)] = int(Part.TONGUE)
